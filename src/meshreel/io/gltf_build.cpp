/// Grows a glTF document, view by view.
// SPDX-License-Identifier: MIT
#include "meshreel/io/gltf_build.h"

#include <algorithm>
#include <string_view>

#include "meshreel/io/attributes.h"

namespace meshreel::io {

namespace {

std::size_t components_of(std::string_view type)
{
    return type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
}

} // namespace

std::size_t GltfBuilder::add(const char* list, nlohmann::json item)
{
    nlohmann::json& items = root[list];
    items.push_back(std::move(item));
    return items.size() - 1;
}

std::size_t GltfBuilder::open_view(std::size_t stride, bool indices)
{
    binary.resize((binary.size() + 3) / 4 * 4);
    opened_ = binary.size();
    nlohmann::json view = {{"buffer", 0}, {"byteOffset", opened_}};
    if (stride > 0) view["byteStride"] = stride;
    if (stride > 0 || indices) view["target"] = indices ? 34963 : 34962;
    return add("bufferViews", std::move(view));
}

void GltfBuilder::close_view()
{
    root["bufferViews"].back()["byteLength"] = binary.size() - opened_;
}

std::size_t GltfBuilder::add_floats(std::span<const float> values, const char* type, bool bounds)
{
    const std::size_t components = components_of(type);
    nlohmann::json accessor = {{"bufferView", view()},
                               {"byteOffset", binary.size() - opened_},
                               {"componentType", 5126},
                               {"count", values.size() / components},
                               {"type", type}};
    if (bounds) {
        std::vector<float> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(components)), high = low;
        for (std::size_t i = 0; i < values.size(); ++i) {
            low[i % components] = std::min(low[i % components], values[i]);
            high[i % components] = std::max(high[i % components], values[i]);
        }
        accessor["min"] = low;
        accessor["max"] = high;
    }
    for (float value : values) append_little(binary, value);
    return add("accessors", std::move(accessor));
}

} // namespace meshreel::io
