/// Validity of an animation, and its size.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/animation.h"

#include <algorithm>
#include <cmath>

#include "meshreel/base/id.h"
#include "meshreel/base/text.h"

namespace meshreel {

namespace {

Status validate_triangles(const Animation& animation)
{
    if (animation.triangles.size() > CornerId::none / 3)
        return bad_input(concat(animation.triangles.size(), " triangles have more corners than 32 bits count"),
                         "triangles");
    for (std::size_t t = 0; t < animation.triangles.size(); ++t)
        for (std::uint32_t v : animation.triangles[t])
            if (v >= animation.vertex_count)
                return bad_input(concat("triangle ", t, " names vertex ", v, ", but there are ", animation.vertex_count,
                                        " vertices"),
                                 "triangles");
    return Ok{};
}

Status validate_times(const Animation& animation)
{
    const auto& times = animation.times_s;
    for (std::size_t f = 0; f < times.size(); ++f) {
        if (!std::isfinite(times[f])) return bad_input(concat("the time of frame ", f, " is not finite"), "times");
        if (f > 0 && !(times[f] > times[f - 1]))
            return bad_input(concat("frame ", f, " is not later than the frame before it"), "times");
    }
    return Ok{};
}

std::size_t element_count(const Animation& animation, Domain domain)
{
    if (domain == Domain::vertex) return animation.vertex_count;
    return animation.triangles.size() * (domain == Domain::corner ? 3 : 1);
}

/// The number that value i of a u32 attribute stands for.
std::uint32_t number_at(const Attribute& attribute, std::size_t i)
{
    std::uint32_t number = 0;
    for (std::size_t byte = 0; byte < 4; ++byte) number |= std::uint32_t{attribute.values[4 * i + byte]} << (8 * byte);
    return number;
}

/// "material" and "group": one u32 a triangle, the number of a name or none.
Status validate_numbers(const Attribute& attribute, std::size_t name_count)
{
    if (attribute.domain != Domain::triangle || attribute.type != Scalar::u32 || attribute.components != 1)
        return bad_input("must be one 32-bit number a triangle", attribute.name);
    for (std::size_t i = 0; i < attribute.value_count(); ++i) {
        const std::uint32_t number = number_at(attribute, i);
        if (number >= name_count && number != TriangleId::none)
            return bad_input(concat("number ", number, " is beyond the ", name_count, " names"), attribute.name);
    }
    return Ok{};
}

Status validate_attribute(const Animation& animation, const Attribute& attribute)
{
    const std::size_t value_size = scalar_size(attribute.type) * attribute.components;
    if (attribute.components < 1 || attribute.components > 16)
        return bad_input(concat(int{attribute.components}, " numbers a value, but 1 to 16 are possible"),
                         attribute.name);
    if (attribute.values.size() % value_size != 0)
        return bad_input("its values are not a whole number of components", attribute.name);
    const std::size_t elements = element_count(animation, attribute.domain);
    const std::size_t entries = attribute.indices.empty() ? attribute.value_count() : attribute.indices.size();
    if (entries != elements) return bad_input(concat(entries, " entries for ", elements, " elements"), attribute.name);
    for (std::uint32_t index : attribute.indices)
        if (index != VertexId::none && index >= attribute.value_count())
            return bad_input(concat("index ", index, " is beyond its ", attribute.value_count(), " values"),
                             attribute.name);
    if (attribute.name == "material") return validate_numbers(attribute, animation.appearance.materials.size());
    if (attribute.name == "group") return validate_numbers(attribute, animation.appearance.groups.size());
    return Ok{};
}

Status validate_metadata(const Metadata& meta)
{
    if (!(meta.fps >= 0.0) || !std::isfinite(meta.fps)) return bad_input("is neither unknown (0) nor above 0", "fps");
    if (!(meta.metres_per_unit >= 0.0) || !std::isfinite(meta.metres_per_unit))
        return bad_input("is neither unknown (0) nor above 0", "metres_per_unit");
    return Ok{};
}

} // namespace

const Attribute* Appearance::find(const std::string& name) const
{
    const auto found = std::find_if(attributes.begin(), attributes.end(),
                                    [&](const Attribute& attribute) { return attribute.name == name; });
    return found == attributes.end() ? nullptr : &*found;
}

std::vector<double> uniform_times(std::size_t frame_count, double fps, double start_s)
{
    std::vector<double> times(frame_count);
    for (std::size_t f = 0; f < frame_count; ++f) times[f] = start_s + static_cast<double>(f) / fps;
    return times;
}

Status validate_frames(std::size_t first, MatrixView<const float> frames)
{
    const std::span<const float> values = frames.values();
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]))
            return bad_input(concat("frame ", first + i / frames.cols, ", vertex ", i % frames.cols / 3, ", ",
                                    std::string(1, "xyz"[i % 3]), " is ",
                                    std::isnan(values[i]) ? "not a number" : "infinite"),
                             "positions");
    return Ok{};
}

Status validate(const Animation& animation)
{
    if (animation.vertex_count == 0 || animation.times_s.empty()) return validate_still(animation);
    if (animation.positions.size() != animation.frame_count() * animation.vertex_count * 3)
        return bad_input(concat(animation.positions.size(), " numbers for ", animation.frame_count(), " frames of ",
                                animation.vertex_count, " vertices"),
                         "positions");
    MESHREEL_CHECK(validate_still(animation));
    return validate_frames(0, {animation.positions.data(), animation.frame_count(), animation.vertex_count * 3ul});
}

Status validate_still(const Animation& animation)
{
    if (animation.vertex_count == 0) return bad_input("there is no vertex", "vertex_count");
    if (animation.times_s.empty()) return bad_input("there is no frame", "frame_count");
    MESHREEL_CHECK(validate_triangles(animation));
    MESHREEL_CHECK(validate_times(animation));
    MESHREEL_CHECK(validate_metadata(animation.meta));
    for (const Attribute& attribute : animation.appearance.attributes)
        MESHREEL_CHECK(validate_attribute(animation, attribute));
    return Ok{};
}

double body_diagonal(const Animation& animation)
{
    return body_diagonal(animation.frame(0));
}

double body_diagonal(std::span<const float> first)
{
    double square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double low = first[axis], high = first[axis];
        for (std::size_t i = axis; i < first.size(); i += 3) {
            low = std::min<double>(low, first[i]);
            high = std::max<double>(high, first[i]);
        }
        square += (high - low) * (high - low);
    }
    return std::sqrt(square);
}

} // namespace meshreel
