/// Any bytes as an MDD file over a mesh that agrees with it: an error, or an animation that reads back to the same bits.
// SPDX-License-Identifier: MIT
#include "fuzz/io_round_trip.h"
#include "meshreel/io/point_cache.h"

using namespace meshreel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Animation mesh;
    mesh.vertex_count = size > 7 ? data[7] : 1u; // the low byte of the header's count
    mesh.positions.resize(mesh.vertex_count * 3ul);
    const io::LoadOptions options = io::fuzz::small_options();
    const auto read = io::parse_mdd({data, size}, mesh, options);
    if (!io::fuzz::is_sound(read)) return 0;
    const auto written = io::write_mdd(*read);
    if (written.ok()) io::fuzz::demand_same(*read, io::parse_mdd(*written, mesh, options));
    return 0;
}
