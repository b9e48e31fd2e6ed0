/// Any bytes as an OFF file: an error, or a mesh that is written and read back to the same bits.
// SPDX-License-Identifier: MIT
#include "fuzz/io_round_trip.h"
#include "meshreel/io/off.h"

using namespace meshreel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const io::LoadOptions options = io::fuzz::small_options();
    const auto read = io::parse_off({data, size}, options);
    if (!io::fuzz::is_sound(read)) return 0;
    const auto written = io::write_off(*read, 0, {});
    io::fuzz::demand(written.ok());
    io::fuzz::demand_same(*read, io::parse_off(*written, options));
    return 0;
}
