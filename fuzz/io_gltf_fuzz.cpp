/// Feeds bytes to the glTF reader; what it accepts must be valid and come back from our own GLB.
// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>

#include "meshreel/base/file.h"
#include "meshreel/io/gltf.h"

namespace {

/// A file in memory where there is such a thing; else in the temporary folder.
std::string scratch(const char* name)
{
    const std::filesystem::path shared = "/dev/shm";
    const auto folder = std::filesystem::exists(shared) ? shared : std::filesystem::temp_directory_path();
    return (folder / ("meshreel_fuzz_" + std::to_string(::getpid()) + name)).string();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace meshreel;
    static const std::string in = scratch("_in.glb"), out = scratch("_out.glb");
    if (!write_file(in, {data, size}, true).ok()) std::abort();
    io::LoadOptions options;
    options.limits.max_memory = 64 << 20;
    options.limits.max_frames = 1000;
    const Result<Animation> read = io::load_gltf(in, options);
    if (!read.ok() || !validate(*read).ok() || read->positions.size() > 1 << 16) return 0;
    io::SaveOptions save;
    save.overwrite = true;
    save.morphs = size % 2 == 0 ? io::Morphs::frames : io::Morphs::pca;
    if (!io::save_gltf(*read, out, save).ok()) return 0;
    const Result<Animation> again = io::load_gltf(out, options);
    if (!again.ok() && again.error().code == ErrorCode::unsupported) std::abort();
    return 0;
}
