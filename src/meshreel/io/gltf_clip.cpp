/// Clips: their channels, their samplers' values at any time, and the times at which to take frames.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "meshreel/base/text.h"
#include "meshreel/io/gltf_scene.h"

namespace meshreel::io {

namespace {

using Warn = std::function<void(std::string)>;

void tell(const Warn& warn, std::string sentence)
{
    if (warn) warn(std::move(sentence));
}

Result<Interpolation> interpolation_of(const Json& field)
{
    MESHREEL_TRY(const std::string name, field.text_or("LINEAR"));
    if (name == "STEP") return Interpolation::step;
    if (name == "LINEAR") return Interpolation::linear;
    if (name == "CUBICSPLINE") return Interpolation::cubic;
    return field.wrong("is no interpolation");
}

Result<GltfSampler> read_sampler(const GltfDocument& document, const Json& json)
{
    GltfSampler sampler;
    MESHREEL_TRY(sampler.interpolation, interpolation_of(json.member("interpolation")));
    MESHREEL_TRY(const Accessor input, accessor(document, json.member("input")));
    MESHREEL_TRY(const Numbers times, numbers(input, 1));
    if (times.values.empty()) return json.member("input").wrong("has no key");
    for (std::size_t k = 0; k < times.values.size(); ++k) {
        sampler.times.push_back(times(k, 0));
        if (k > 0 && !(sampler.times[k] > sampler.times[k - 1]))
            return input.where.wrong(concat("key ", k, " is not later than the key before it"));
    }
    MESHREEL_TRY(const Accessor output, accessor(document, json.member("output")));
    MESHREEL_TRY(sampler.output, numbers(output, 0));
    return sampler;
}

/// The path's name, or nothing where we do not follow it.
std::optional<AnimatedPath> path_of(const std::string& name)
{
    if (name == "translation") return AnimatedPath::translation;
    if (name == "rotation") return AnimatedPath::rotation;
    if (name == "scale") return AnimatedPath::scale;
    if (name == "weights") return AnimatedPath::weights;
    return std::nullopt;
}

std::size_t target_count(const GltfDocument& document, std::uint32_t mesh)
{
    if (mesh == gltf_none) return 0;
    return document.item("meshes", mesh).member("primitives").element(0).member("targets").size();
}

/// Fixes how many numbers a key has, and that the output has them all.
Status fit_output(GltfSampler& sampler, std::size_t width, AnimatedPath path, const Json& channel)
{
    const std::size_t components = path == AnimatedPath::weights ? 1 : width;
    if (sampler.output.components != components)
        return channel.wrong(concat("its sampler has ", static_cast<unsigned>(sampler.output.components),
                                    " components a value, but ", components, " are needed"));
    if (sampler.used && sampler.width != width)
        return channel.wrong("shares its sampler with a channel of another width");
    const std::size_t parts = sampler.interpolation == Interpolation::cubic ? 3 : 1;
    if (sampler.output.values.size() != sampler.times.size() * parts * width)
        return channel.wrong(concat("its sampler has ", sampler.output.values.size(), " numbers, but ",
                                    sampler.times.size(), " keys of ", parts * width, " need ",
                                    sampler.times.size() * parts * width));
    sampler.used = true;
    sampler.width = width;
    return Ok{};
}

/// What channels are read from.
struct Source {
    const GltfDocument& document;
    const GltfScene& scene;
    const Warn& warn;
};

Status read_channel(const Source& source, const Json& json, GltfClip& clip)
{
    const auto& [document, scene, warn] = source;
    const Json target = json.member("target");
    MESHREEL_TRY(const std::string name, target.member("path").text_or(""));
    const std::optional<AnimatedPath> path = path_of(name);
    if (!path || !target.member("node")) {
        tell(warn, concat(json.path, ": animates ", name.empty() ? "nothing" : name, ", which is left out"));
        return Ok{};
    }
    MESHREEL_TRY(const std::uint64_t node, target.member("node").integer(scene.nodes.size()));
    MESHREEL_TRY(const std::uint64_t sampler, json.member("sampler").integer(clip.samplers.size()));
    const bool weights = *path == AnimatedPath::weights;
    if (scene.nodes[node].has_matrix && !weights)
        return target.wrong(concat("animates node ", node, ", which has a matrix"));
    const std::size_t width = weights                           ? target_count(document, scene.nodes[node].mesh)
                              : *path == AnimatedPath::rotation ? 4
                                                                : 3;
    if (width == 0) {
        tell(warn, concat(json.path, ": animates the weights of a node without morph targets, which is left out"));
        return Ok{};
    }
    MESHREEL_CHECK(document.budget->take(width * sizeof(double), json)); // of the pose
    MESHREEL_CHECK(fit_output(clip.samplers[sampler], width, *path, json));
    clip.channels.push_back({static_cast<std::uint32_t>(node), *path, static_cast<std::uint32_t>(sampler)});
    return Ok{};
}

/// Hermite spline between two keys.
void sample_cubic(const GltfSampler& sampler, std::size_t k, double fraction, std::span<double> out)
{
    const double step = sampler.times[k + 1] - sampler.times[k];
    const double t = fraction, t2 = t * t, t3 = t2 * t;
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = (2 * t3 - 3 * t2 + 1) * sampler.key(k, 1, i) + step * (t3 - 2 * t2 + t) * sampler.key(k, 2, i) +
                 (-2 * t3 + 3 * t2) * sampler.key(k + 1, 1, i) + step * (t3 - t2) * sampler.key(k + 1, 0, i);
}

/// Spherical interpolation along the shorter arc; straight where the arc is too short to divide by.
void sample_slerp(const GltfSampler& sampler, std::size_t k, double fraction, std::span<double> out)
{
    double dot = 0, first_square = 0, second_square = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const double a = sampler.key(k, 1, i), b = sampler.key(k + 1, 1, i);
        dot += a * b;
        first_square += a * a;
        second_square += b * b;
    }
    const double lengths = std::sqrt(first_square * second_square);
    const double cosine = lengths > 0 ? std::min(1.0, std::abs(dot) / lengths) : 1.0;
    double first = 1 - fraction, second = fraction;
    if (cosine < 1 - 1e-12) {
        const double angle = std::acos(cosine);
        first = std::sin(angle * (1 - fraction)) / std::sin(angle);
        second = std::sin(angle * fraction) / std::sin(angle);
    }
    if (dot < 0) second = -second;
    const double a = first_square > 0 ? first / std::sqrt(first_square) : 0,
                 b = second_square > 0 ? second / std::sqrt(second_square) : 0;
    for (std::size_t i = 0; i < 4; ++i) out[i] = a * sampler.key(k, 1, i) + b * sampler.key(k + 1, 1, i);
}

/// The keys of all samplers in use, each once; keys closer than a float can tell apart are one.
std::vector<double> all_keys(const GltfClip& clip)
{
    std::vector<double> keys;
    for (const GltfSampler& sampler : clip.samplers)
        if (sampler.used) keys.insert(keys.end(), sampler.times.begin(), sampler.times.end());
    std::sort(keys.begin(), keys.end());
    std::vector<double> distinct;
    for (double key : keys)
        if (distinct.empty() || key - distinct.back() > std::max(1e-6, 4e-7 * std::abs(key))) distinct.push_back(key);
    return distinct;
}

/// Whole numbers of steps from the first key to each key, if there is a step that they all are multiples of and
/// half of those multiples are keys.
std::vector<std::uint64_t> grid_places(const std::vector<double>& keys)
{
    double step = keys.back() - keys.front();
    for (std::size_t k = 1; k < keys.size(); ++k) step = std::min(step, keys[k] - keys[k - 1]);
    if (step < 1.0 / 241) return {};
    step = (keys.back() - keys.front()) / std::round((keys.back() - keys.front()) / step);
    std::vector<std::uint64_t> places;
    for (double key : keys) {
        const double place = (key - keys.front()) / step;
        if (std::abs(place - std::round(place)) > 0.03) return {};
        places.push_back(static_cast<std::uint64_t>(std::llround(place)));
        if (places.size() > 1 && places.back() == places[places.size() - 2]) return {};
    }
    if (places.back() >= 2 * places.size()) return {}; // two rates mixed: a frame for each would be mostly padding
    return places;
}

/// 23.99998 is 24.
double nominal(double fps)
{
    return std::abs(fps - std::round(fps)) < 2e-4 * fps ? std::round(fps) : fps;
}

/// Every grid time, those of keys exactly.
ClipTimes grid_times(const std::vector<double>& keys, const std::vector<std::uint64_t>& places)
{
    const double steps = static_cast<double>(places.back());
    ClipTimes result;
    result.fps = nominal(steps / (keys.back() - keys.front()));
    result.times_s.resize(places.back() + 1);
    for (std::size_t f = 0; f < result.times_s.size(); ++f)
        result.times_s[f] = keys.front() + (keys.back() - keys.front()) * (static_cast<double>(f) / steps);
    for (std::size_t k = 0; k < keys.size(); ++k) result.times_s[places[k]] = keys[k];
    return result;
}

} // namespace

double GltfSampler::key(std::size_t k, std::size_t part, std::size_t i) const
{
    const std::size_t place = interpolation == Interpolation::cubic ? k * 3 + part : k;
    return static_cast<double>(output.values[place * width + i]) * output.unit;
}

Result<GltfClip> read_gltf_clip(const GltfDocument& document, const GltfScene& scene, std::size_t number,
                                const Warn& warn)
{
    const Json json = document.item("animations", number);
    GltfClip clip;
    MESHREEL_TRY(clip.name, json.member("name").text_or(""));
    const Json samplers = json.member("samplers"), channels = json.member("channels");
    for (std::size_t s = 0; s < samplers.size(); ++s) {
        MESHREEL_TRY(GltfSampler sampler, read_sampler(document, samplers.element(s)));
        clip.samplers.push_back(std::move(sampler));
    }
    for (std::size_t c = 0; c < channels.size(); ++c)
        MESHREEL_CHECK(read_channel({document, scene, warn}, channels.element(c), clip));
    return clip;
}

void sample(const GltfSampler& sampler, AnimatedPath path, double time_s, std::span<double> out)
{
    const auto after = std::upper_bound(sampler.times.begin(), sampler.times.end(), time_s);
    const std::size_t next = static_cast<std::size_t>(after - sampler.times.begin());
    const std::size_t k = next == 0 ? 0 : next - 1;
    const bool held = next == 0 || next == sampler.times.size() || sampler.interpolation == Interpolation::step;
    const double fraction = held ? 0 : (time_s - sampler.times[k]) / (sampler.times[k + 1] - sampler.times[k]);
    if (fraction == 0) {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = sampler.key(k, 1, i);
    } else if (sampler.interpolation == Interpolation::cubic) {
        sample_cubic(sampler, k, fraction, out);
    } else if (path == AnimatedPath::rotation) {
        sample_slerp(sampler, k, fraction, out);
    } else {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = (1 - fraction) * sampler.key(k, 1, i) + fraction * sampler.key(k + 1, 1, i);
    }
}

Result<ClipTimes> clip_times(const GltfClip& clip, double fps, const DecodeLimits& limits, const Warn& warn)
{
    const std::vector<double> keys = all_keys(clip);
    if (keys.empty()) return ClipTimes{{0.0}, fps};
    const double length = keys.back() - keys.front();
    if (keys.size() == 1) return ClipTimes{{keys.front()}, fps};
    if (fps <= 0) {
        const std::vector<std::uint64_t> places = grid_places(keys);
        if (!places.empty()) {
            MESHREEL_CHECK(within(places.back() + 1, limits.max_frames, "frame_count"));
            return grid_times(keys, places);
        }
        fps = 30;
        tell(warn, concat("the keys of clip \"", clip.name,
                          "\" stand on no uniform grid; it is sampled at 30 frames a second"));
    }
    const double steps = std::floor(length * fps + 1e-3);
    if (!(steps < static_cast<double>(limits.max_frames)))
        return bad_input(concat("the clip lasts ", length, " s: more than ", limits.max_frames, " frames"),
                         "animations");
    if (length * fps - steps > 2e-3)
        tell(warn, concat("clip \"", clip.name, "\" ends at ", keys.back(), " s, ", (length - steps / fps) * 1000,
                          " ms after its last frame"));
    return ClipTimes{uniform_times(static_cast<std::size_t>(steps) + 1, fps, keys.front()), fps};
}

} // namespace meshreel::io
