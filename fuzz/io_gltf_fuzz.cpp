/// Feeds bytes to the glTF reader; what it accepts is valid, and is written as GLB and read back with its frames and triangles.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <filesystem>
#include <string>
#include <unistd.h>

#include "fuzz/gltf_mutator.h"
#include "fuzz/io_round_trip.h"
#include "meshreel/base/file.h"
#include "meshreel/io/gltf.h"

using namespace meshreel;

namespace {

/// A file in memory where there is such a thing; else in the temporary folder.
std::string scratch(const char* name)
{
    const std::filesystem::path shared = "/dev/shm";
    const auto folder = std::filesystem::exists(shared) ? shared : std::filesystem::temp_directory_path();
    return (folder / ("meshreel_fuzz_" + std::to_string(::getpid()) + name)).string();
}

/// Small enough to be written many times a second, and differences of poses are still numbers of float32.
bool is_moderate(const Animation& animation)
{
    for (const float x : animation.positions)
        if (std::abs(x) > 1e30f) return false;
    return animation.positions.size() <= 1 << 14;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const std::string in = scratch("_in.glb"), out = scratch("_out.glb");
    io::fuzz::demand(write_file(in, {data, size}, true).ok());
    io::LoadOptions options = io::fuzz::small_options();
    options.limits.max_frames = 1000;
    const Result<Animation> read = io::load_gltf(in, options);
    if (!io::fuzz::is_sound(read) || !is_moderate(*read)) return 0;
    io::SaveOptions save;
    save.overwrite = true;
    save.morphs = size % 2 == 0 ? io::Morphs::frames : io::Morphs::pca;
    if (!io::save_gltf(*read, out, save).ok()) return 0;
    const Result<Animation> again = io::load_gltf(out, options);
    io::fuzz::demand(again.ok() && again->frame_count() == read->frame_count());
    io::fuzz::demand(again->triangles.size() == read->triangles.size());
    return 0;
}
