/// The heat map of one frame as PLY.
// SPDX-License-Identifier: MIT
#include <cstring>

#include <fmt/format.h>

#include "cli/pictures/colour_map.h"
#include "cli/pictures/heat_map.h"
#include "meshreel/io/ply.h"

namespace meshreel::cli {

namespace {

/// The errors as the property that MeshLab and CloudCompare take for a scalar field.
Attribute quality_attribute(std::span<const double> errors)
{
    Attribute attribute{"quality", Domain::vertex, Scalar::f32, 1, false, Bytes(errors.size() * sizeof(float)), {}};
    for (std::size_t v = 0; v < errors.size(); ++v) {
        const auto value = static_cast<float>(errors[v]);
        std::memcpy(attribute.values.data() + v * sizeof value, &value, sizeof value);
    }
    return attribute;
}

Attribute colour_attribute(std::span<const double> errors, const Scale& scale)
{
    Attribute attribute{"color0", Domain::vertex, Scalar::u8, 3, true, {}, {}};
    for (double error : errors)
        for (std::uint8_t channel : viridis_bytes(scale.place(error))) attribute.values.push_back(channel);
    return attribute;
}

} // namespace

Result<Bytes> heat_ply(const Surfaces& surfaces, const HeatMapOptions& options)
{
    FrameSource& source = surfaces.coloured();
    const std::size_t f = options.of.kind == HeatOf::Kind::frame ? options.of.frame : 0;
    const std::vector<double> errors = surfaces.heat->values(options.of);
    const Scale scale = surfaces.scale_for(errors);
    Animation still;
    still.vertex_count = source.still().vertex_count;
    still.triangles = source.still().triangles;
    still.times_s = {source.still().times_s[f]};
    Matrix<float> room;
    MESHREEL_TRY(const MatrixView<const float> frame, source.frames(f, 1, room));
    still.positions.assign(frame.values().begin(), frame.values().end());
    still.appearance.attributes = {colour_attribute(errors, scale), quality_attribute(errors)};
    io::SaveOptions save;
    save.binary = !options.ascii;
    MESHREEL_TRY(Bytes file, io::write_ply(still, 0, save));
    const HeatLabel& label = surfaces.heat->label();
    const std::string remark = fmt::format("comment {}, {}; colours: viridis from 0 to {:.9g} {}\n", label.title,
                                           options.of.text(), scale.top, label.unit);
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    const auto second_line = static_cast<std::ptrdiff_t>(text.find('\n', text.find("format")) + 1);
    file.insert(file.begin() + second_line, remark.begin(), remark.end());
    return file;
}

} // namespace meshreel::cli
