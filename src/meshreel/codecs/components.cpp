/// What a reader of principal components refuses, and where it says so.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/components.h"

#include "meshreel/base/text.h"

namespace meshreel::codecs {

Status check_bases(const Coded& coded, std::uint64_t K)
{
    const std::uint64_t n = 3 * std::uint64_t{coded.frame_count}, W = coded.surface.vertex_count;
    const std::string field = coded.payload.name + ".bases";
    if (K > n)
        return bad_input("more components than a trajectory has coordinates", field, at_byte(coded.payload.offset));
    if (2 * n + 2 * W > coded.limits.max_memory / 8 / (K + 1))
        return bad_input("the basis and its coefficients do not fit in the memory limit", field,
                         at_byte(coded.payload.offset));
    return at_part(within_work(coded.limits, n * W, K, coded.payload.bytes.size()), coded.payload, coded.payload.bytes,
                   "bases");
}

Status at_part(Status status, const container::Source& source, ByteView part, std::string_view field)
{
    if (status.ok()) return status;
    Error error = std::move(status).error();
    error.field = joined(source.name, ".", field);
    error.place = at_byte(source.offset + static_cast<std::uint64_t>(part.data() - source.bytes.data()));
    return error;
}

} // namespace meshreel::codecs
