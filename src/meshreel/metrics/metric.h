/// What a measure of the difference between two animations is, and the registry of all of them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "meshreel/base/parallel.h"
#include "meshreel/base/progress.h"
#include "meshreel/base/result.h"
#include "meshreel/base/views.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::metrics {

/// What two animations must have in common to be measured.
enum class Common : std::uint8_t {
    nothing,   ///< any two surfaces
    frames,    ///< F
    triangles, ///< V, F and the triangles: each vertex has its counterpart
};

/// Which value is the better one.
enum class Better : std::uint8_t { less, more };

/// What a value does not change under when both animations undergo it; duration: when both play twice.
struct Invariance {
    bool translation, rotation, scale, duration;
};

/// One number that a measure finds.
struct Value {
    std::string_view name;   ///< "sted_spatial", as in JSON; no other value of any measure has it
    std::string_view title;  ///< "STED in space"
    std::string_view unit;   ///< "%", "units", "dB", ""
    std::string_view source; ///< "thesis (7.8)"
    double equal = 0.0;      ///< the value of equal animations
    Better better = Better::less;
    Invariance invariance{};
};

/// A constant of a measure that its user may set.
struct Parameter {
    std::string_view name;  ///< "window", set by --set sted.window=3
    std::string_view title; ///< "frames on either side that a speed is averaged over"
    std::string_view unit;  ///< "frames", ""
    double usual = 0.0, least = 0.0, most = 0.0;
    bool whole = false; ///< a whole number
};

/// Told an error for each vertex, [V], of frame after frame, in order.
using VertexErrors = std::function<void(std::size_t frame, std::span<const double> errors)>;

struct Metric;

/// What a measurement starts with. The stills, all but the positions, outlive it.
struct Context {
    const Metric& metric;
    const Animation &original, &distorted;
    std::span<const double> parameters; ///< one for each of the metric's
    Threads threads;
    VertexErrors vertex_errors; ///< may be empty

    /// The parameter of that name. @pre the metric has it
    double parameter(std::string_view name) const;
};

/// The next frames of both. Their numbers differ only where the measure needs nothing in common.
struct Frames {
    MatrixView<const float> original;  ///< [N x 3V], x y z of each vertex
    MatrixView<const float> distorted; ///< [N' x 3V']
};

/// A measure at work: takes in frames, run after run, then says its values. They do not depend on how the runs are cut,
/// nor on the number of threads.
class Measurement {
public:
    virtual ~Measurement() = default;
    virtual void add(const Frames& frames) = 0;
    /// One number for each value of the metric, never NaN. Called once, after the last frame.
    virtual std::vector<double> finish(const Progress& progress) = 0;
    /// The first value frame by frame, [F], for curves; empty where there is no such thing. Called after finish.
    virtual std::vector<double> per_frame() const { return {}; }
};

/// One row of the registry: one measure.
struct Metric {
    std::string_view name;  ///< "sted", as in --metric
    std::string_view title; ///< "spatio-temporal edge difference"
    Common common = Common::triangles;
    std::span<const Value> values;
    std::span<const Parameter> parameters = {};
    bool slow = false; ///< only where it is asked for
    /// What it says of single vertices: "distance", and its unit. Empty: nothing.
    std::string_view vertex_title = {}, vertex_unit = {};
    std::unique_ptr<Measurement> (*start)(const Context& context) = nullptr;
};

/// Every measure, in the order of the documentation.
std::span<const Metric> all();

/// The measure of that name, or null.
const Metric* find(std::string_view name);

/// A value and the measure that it is of; null where there is none of that name.
struct FoundValue {
    const Metric* metric = nullptr;
    std::size_t index = 0;
};
FoundValue find_value(std::string_view name);

/// The parameters of a measure as nobody set them.
std::vector<double> usual_parameters(const Metric& metric);
/// Sets one of them. @fails usage: there is no such parameter, or it cannot have this value.
Status set_parameter(const Metric& metric, std::string_view name, double value, std::span<double> parameters);

/// Says why two animations, or stills, have not so much in common.
Status comparable(const Animation& original, const Animation& distorted, Common common = Common::triangles);

} // namespace meshreel::metrics
