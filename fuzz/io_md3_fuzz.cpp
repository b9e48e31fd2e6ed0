/// Any bytes as an MD3 file: an error, or a valid animation.
// SPDX-License-Identifier: MIT
#include "fuzz/io_round_trip.h"
#include "meshreel/io/md3.h"

using namespace meshreel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto read = io::parse_md3({data, size}, io::fuzz::small_options());
    io::fuzz::demand(!read.ok() || validate(*read).ok());
    return 0;
}
