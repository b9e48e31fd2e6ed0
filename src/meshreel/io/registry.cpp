/// The one table of formats, and the two functions that use it.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "meshreel/base/memory.h"
#include "meshreel/base/text.h"
#include "meshreel/io/gltf.h"
#include "meshreel/io/io.h"
#include "meshreel/io/md2.h"
#include "meshreel/io/md3.h"
#include "meshreel/io/obj.h"
#include "meshreel/io/off.h"
#include "meshreel/io/ply.h"
#include "meshreel/io/point_cache.h"
#include "meshreel/io/streamed_frames.h"

namespace meshreel::io {

namespace {

constexpr std::string_view obj_extensions[] = {"obj"};
constexpr std::string_view ply_extensions[] = {"ply"};
constexpr std::string_view off_extensions[] = {"off", "coff", "noff", "stoff"};
constexpr std::string_view pc2_extensions[] = {"pc2"};
constexpr std::string_view mdd_extensions[] = {"mdd"};

constexpr std::string_view gltf_extensions[] = {"glb", "gltf"};
constexpr std::string_view md2_extensions[] = {"md2"};
constexpr std::string_view md3_extensions[] = {"md3"};

constexpr Format table[] = {
    {"obj", obj_extensions, "Wavefront OBJ, one file a frame", load_obj, save_obj, open_obj},
    {"ply", ply_extensions, "Stanford PLY, one file a frame", load_ply, save_ply, open_ply},
    {"off", off_extensions, "Object File Format, one file a frame", load_off, save_off, open_off},
    {"pc2", pc2_extensions, "PointCache2, positions of a mesh, evenly spaced", load_pc2, save_pc2, open_pc2,
     save_pc2_frames},
    {"mdd", mdd_extensions, "MDD, positions of a mesh, with times", load_mdd, save_mdd, open_mdd, save_mdd_frames},
    {"md2", md2_extensions, "Quake II model", load_md2, nullptr},
    {"md3", md3_extensions, "Quake III model", load_md3, nullptr},
    {"gltf", gltf_extensions, "glTF 2.0 and GLB, skins and morph targets baked", load_gltf, save_gltf},
};

char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string extension_of(const std::string& path)
{
    const std::size_t dot = path.rfind('.'), slash = path.rfind('/');
    if (dot == std::string::npos || (slash != std::string::npos && slash > dot)) return {};
    std::string extension = path.substr(dot + 1);
    std::ranges::transform(extension, extension.begin(), lower);
    return extension;
}

} // namespace

std::span<const Format> formats()
{
    return table;
}

Result<const Format*> format_of(const std::string& path)
{
    const std::string extension = extension_of(path);
    std::string known;
    for (const Format& format : table)
        for (std::string_view one : format.extensions) {
            if (one == extension) return &format;
            known += concat(known.empty() ? "." : " .", one);
        }
    return Error{ErrorCode::unsupported, "no format has this extension; known are " + known, {}, path, {}};
}

Result<Animation> load(const std::string& path, const LoadOptions& options)
{
    return within_memory([&]() -> Result<Animation> {
        MESHREEL_TRY(const Format* format, format_of(path));
        if (!format->load)
            return Error{ErrorCode::unsupported, concat(format->name, " files are only written"), {}, path, {}};
        MESHREEL_TRY(Animation animation, in_file(format->load(path, options), path));
        MESHREEL_CHECK(in_file(validate(animation), path));
        return animation;
    });
}

Result<std::unique_ptr<FrameSource>> open(const std::string& path, const LoadOptions& options)
{
    MESHREEL_TRY(const Format* format, format_of(path));
    return open(*format, path, options);
}

Result<std::unique_ptr<FrameSource>> open(const Format& format, const std::string& path, const LoadOptions& options)
{
    return within_memory([&]() -> Result<std::unique_ptr<FrameSource>> {
        if (format.open != nullptr && path != "-") {
            MESHREEL_TRY(std::unique_ptr<FrameSource> frames, in_file(format.open(path, options), path));
            MESHREEL_CHECK(in_file(validate_still(frames->still()), path));
            return frames;
        }
        if (format.load == nullptr)
            return Error{ErrorCode::unsupported, concat(format.name, " files are only written"), {}, path, {}};
        MESHREEL_TRY(Animation animation, in_file(format.load(path, options), path));
        MESHREEL_CHECK(in_file(validate(animation), path));
        return std::unique_ptr<FrameSource>(std::make_unique<OwnedFrames>(std::move(animation)));
    });
}

Status save(const Animation& animation, const std::string& path, const SaveOptions& options)
{
    return within_memory([&]() -> Status {
        MESHREEL_TRY(const Format* format, format_of(path));
        if (!format->save)
            return Error{ErrorCode::unsupported, concat(format->name, " files are only read"), {}, path, {}};
        MESHREEL_CHECK(in_file(validate(animation), path));
        return in_file(format->save(animation, path, options), path);
    });
}

} // namespace meshreel::io
