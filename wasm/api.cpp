/// The boundary between JavaScript and the decoder: a handle, steps, and numbers and arrays by their place in a list.
// SPDX-License-Identifier: MIT
#include <cstdlib>

#include "incoming.h"

#define MESHREEL_EXPORT(name) extern "C" __attribute__((export_name(#name), used))

#ifndef MESHREEL_HOST_RAISES // of the fuzz target, whose host is no browser
/// Throws a ReelError; js/decoder.js gives the instance up.
extern "C" __attribute__((import_module("host"), import_name("raise"), noreturn)) void
host_raise(int code, double byte, const std::string_view* message, const std::string_view* field);

namespace meshreel {

void raise(ErrorCode code, std::string_view message, std::string_view field, std::int64_t byte)
{
    host_raise(static_cast<int>(code), static_cast<double>(byte), &message, &field);
}

} // namespace meshreel
#endif

namespace {

using namespace meshreel;
using meshreel::wasm::Incoming;

/// One file, as JavaScript sees it.
struct Handle {
    Incoming file;
    std::vector<float> frames;

    explicit Handle(const wasm::IncomingOptions& options) : file(options) {}

    bool coarse() const { return file.piece().level.has_value(); }
    const Appearance& appearance() const
    {
        return file.piece().appearance ? *file.piece().appearance : file.still().appearance;
    }
    const codecs::Trajectories* trajectories() const { return std::get_if<codecs::Trajectories>(&file.piece().opened); }
};

/// Where an array is. Valid until the next step.
struct Array {
    const void* data = nullptr;
    std::size_t bytes = 0;
};

template <class Values>
Array array_of(const Values& values)
{
    return {values.data(), values.size() * sizeof(typename Values::value_type)};
}

/// The arrays of an animation that does not move. The numbers are those of js/decoder.js.
Array still_array(const Handle& handle, int what, std::size_t i)
{
    const Animation& still = handle.file.still();
    const Appearance& appearance = handle.appearance();
    switch (what) {
    case 0:
        return array_of(handle.file.header().codec);
    case 1:
        return array_of(handle.file.header().encoder);
    case 2:
        return array_of(still.meta.name);
    case 3:
        return array_of(still.times_s);
    case 4:
        return array_of(handle.coarse() ? handle.file.piece().level->triangles : still.triangles);
    case 5:
        return array_of(handle.file.topology().surface_of);
    case 6:
        return array_of(appearance.attributes[i].name);
    case 7:
        return array_of(appearance.attributes[i].values);
    case 8:
        return array_of(appearance.attributes[i].indices);
    case 9:
        return array_of(appearance.materials[i]);
    case 10:
        return array_of(appearance.groups[i]);
    case 11:
        return array_of(appearance.assets[i].name);
    case 12:
        return array_of(appearance.assets[i].mime_type);
    case 13:
        return array_of(appearance.assets[i].bytes);
    default:
        return {};
    }
}

/// The arrays of the piece decoded last.
Array piece_array(const Handle& handle, int what)
{
    const codecs::Trajectories* trajectories = handle.trajectories();
    switch (what) {
    case 23:
        return array_of(handle.frames);
    default:
        break;
    }
    if (trajectories == nullptr) return {};
    switch (what) {
    case 20:
        return array_of(trajectories->basis.mean);
    case 21:
        return array_of(trajectories->basis.rows.values);
    case 22:
        return array_of(trajectories->C.values);
    default:
        return {};
    }
}

Array array_at(const Handle& handle, int what, std::size_t i)
{
    return what < 20 ? still_array(handle, what, i) : piece_array(handle, what);
}

double still_number(const Handle& handle, int what, std::size_t i)
{
    const container::Header& header = handle.file.header();
    const Metadata& meta = handle.file.still().meta;
    const Appearance& appearance = handle.appearance();
    switch (what) {
    case 0:
        return header.vertex_count;
    case 1:
        return header.coded_vertex_count;
    case 2:
        return header.triangle_count;
    case 3:
        return header.frame_count;
    case 4:
        return static_cast<double>(header.order);
    case 5:
        return meta.loop;
    case 6:
        return static_cast<double>(meta.up);
    case 7:
        return meta.metres_per_unit;
    case 8:
        return meta.fps;
    case 9:
        return static_cast<double>(appearance.attributes.size());
    case 10:
        return static_cast<double>(appearance.attributes[i].domain);
    case 11:
        return static_cast<double>(appearance.attributes[i].type);
    case 12:
        return appearance.attributes[i].components;
    case 13:
        return appearance.attributes[i].normalized;
    case 14:
        return static_cast<double>(appearance.materials.size());
    case 15:
        return static_cast<double>(appearance.groups.size());
    case 16:
        return static_cast<double>(appearance.assets.size());
    default:
        return 0;
    }
}

double piece_number(const Handle& handle, int what)
{
    const wasm::Piece& piece = handle.file.piece();
    switch (what) {
    case 20:
        return piece.first_frame;
    case 21:
        return piece.frame_count;
    case 22:
        return handle.trajectories() != nullptr ? static_cast<double>(handle.trajectories()->C.cols) : -1;
    default:
        return 0;
    }
}

} // namespace

MESHREEL_EXPORT(allocate) void* reel_allocate(std::size_t size)
{
    return std::malloc(size);
}

MESHREEL_EXPORT(open) Handle* reel_open(std::uint32_t coarse_level, int level_alone, double max_memory)
{
    wasm::IncomingOptions options{coarse_level, level_alone != 0, {}};
    options.limits.max_memory = static_cast<std::uint64_t>(max_memory);
    return new Handle(options);
}

MESHREEL_EXPORT(close) void reel_close(Handle* handle)
{
    delete handle;
}

/// Where the base mesh's triangles go, three u32 each.
MESHREEL_EXPORT(base) Triangle* reel_base(Handle* handle, std::uint32_t vertex_count, std::size_t triangle_count)
{
    return handle->file.base(vertex_count, triangle_count).data();
}

/// XXH3-64, for tests.
MESHREEL_EXPORT(hash) std::uint64_t reel_hash(const std::uint8_t* bytes, std::size_t size)
{
    return container::hash_of({bytes, size});
}

/// Where the next bytes go.
MESHREEL_EXPORT(room) std::uint8_t* reel_room(Handle* handle, std::size_t count)
{
    return *handle->file.room(count);
}

MESHREEL_EXPORT(receive) void reel_receive(Handle* handle, std::size_t count)
{
    handle->file.receive(count);
}

/// An Incoming::Event.
MESHREEL_EXPORT(step) int reel_step(Handle* handle, int complete)
{
    handle->frames = {};
    return static_cast<int>(*handle->file.step(complete != 0));
}

/// Fills array 23 with the exact frames of the piece.
MESHREEL_EXPORT(frames) void reel_frames(Handle* handle)
{
    handle->frames = *handle->file.frames();
}

MESHREEL_EXPORT(at) const void* reel_at(const Handle* handle, int what, std::size_t i)
{
    return array_at(*handle, what, i).data;
}

MESHREEL_EXPORT(size) std::size_t reel_size(const Handle* handle, int what, std::size_t i)
{
    return array_at(*handle, what, i).bytes;
}

MESHREEL_EXPORT(number) double reel_number(const Handle* handle, int what, std::size_t i)
{
    return what < 20 ? still_number(*handle, what, i) : piece_number(*handle, what);
}
