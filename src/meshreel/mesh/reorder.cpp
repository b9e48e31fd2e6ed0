/// Tables follow their elements.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/reorder.h"

#include <algorithm>

namespace meshreel {

namespace {

/// The old element of each new one.
std::vector<std::uint32_t> old_elements(Domain domain, const NewOrder& order)
{
    if (domain == Domain::vertex) return {order.vertex_of.begin(), order.vertex_of.end()};
    if (domain == Domain::corner) return {order.corner_of.begin(), order.corner_of.end()};
    std::vector<std::uint32_t> triangle_of;
    for (std::size_t c = 0; c < order.corner_of.size(); c += 3) triangle_of.push_back(order.corner_of[c] / 3);
    return triangle_of;
}

Attribute reordered(const Attribute& attribute, const std::vector<std::uint32_t>& old)
{
    Attribute result = attribute;
    if (!attribute.indices.empty()) {
        for (std::size_t i = 0; i < old.size(); ++i) result.indices[i] = attribute.indices[old[i]];
        return result;
    }
    const std::size_t size = scalar_size(attribute.type) * attribute.components;
    for (std::size_t i = 0; i < old.size(); ++i)
        std::copy_n(attribute.values.data() + old[i] * size, size, result.values.data() + i * size);
    return result;
}

} // namespace

Appearance reordered(const Appearance& appearance, const NewOrder& order)
{
    Appearance result = appearance;
    for (Attribute& attribute : result.attributes)
        attribute = reordered(attribute, old_elements(attribute.domain, order));
    return result;
}

void reorder_frame(std::span<const float> frame, std::span<const std::uint32_t> vertex_of, std::span<float> result)
{
    for (std::size_t i = 0; i < vertex_of.size(); ++i)
        std::copy_n(frame.data() + 3ul * vertex_of[i], 3, result.data() + 3 * i);
}

} // namespace meshreel
