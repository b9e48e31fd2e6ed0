/// Loads an animation from glTF: the clip, the times, the frames.
// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "meshreel/base/text.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/gltf.h"
#include "meshreel/io/gltf_appearance.h"

namespace meshreel::io {

namespace {

std::string clip_list(const GltfDocument& document)
{
    std::string list;
    for (std::size_t a = 0; a < document.count("animations"); ++a) {
        const Result<std::string> name = document.item("animations", a).member("name").text_or("");
        list += concat(a > 0 ? ", " : "", name.ok() && !name->empty() ? concat("\"", *name, "\"") : std::to_string(a));
    }
    return list;
}

/// The number of the clip that is asked for; nothing: the file has none.
Result<std::optional<std::size_t>> choose_clip(const GltfDocument& document, const LoadOptions& options)
{
    const std::size_t count = document.count("animations");
    if (options.clip.empty()) {
        if (count > 1 && options.warn)
            options.warn(concat("has ", count, " clips: ", clip_list(document), "; the first is taken"));
        return count == 0 ? std::nullopt : std::optional<std::size_t>(0);
    }
    for (std::size_t a = 0; a < count; ++a) {
        MESHREEL_TRY(const std::string name, document.item("animations", a).member("name").text_or(""));
        if (name == options.clip) return std::optional(a);
    }
    for (std::size_t a = 0; a < count; ++a)
        if (std::to_string(a) == options.clip) return std::optional(a);
    return Error{ErrorCode::usage,
                 concat("has no clip \"", options.clip, "\"",
                        count == 0 ? "; it has none at all" : "; there are: ", clip_list(document)),
                 "animations",
                 {},
                 {}};
}

void tell_left_out(const GltfDocument& document, const GltfBody& body, const LoadOptions& options)
{
    if (!options.warn) return;
    if (document.count("scenes") > 1)
        options.warn(concat("has ", document.count("scenes"), " scenes; the default one is taken"));
    if (document.json().member("cameras")) options.warn("has cameras, which are left out");
    if (document.json().member("extensions").member("KHR_lights_punctual"))
        options.warn("has lights, which are left out");
    for (const GltfVertices& vertices : body.sets) {
        const Json target = vertices.primitive.member("targets").element(0);
        if (!target.member("NORMAL") && !target.member("TANGENT")) continue;
        return options.warn("has morph targets for normals or tangents, which are left out");
    }
}

std::uint64_t bytes_of(const GltfDocument& document)
{
    std::uint64_t bytes = document.file.size();
    for (const Bytes& buffer : document.loaded) bytes += buffer.size();
    return bytes;
}

Result<Animation> load(const GltfDocument& document, const LoadOptions& options)
{
    MESHREEL_CHECK(check_fps(options));
    MESHREEL_TRY(const GltfScene scene, read_gltf_scene(document));
    MESHREEL_TRY(const std::optional<std::size_t> number, choose_clip(document, options));
    GltfClip clip;
    if (number) {
        MESHREEL_TRY(clip, read_gltf_clip(document, scene, *number, options.warn));
    }
    MESHREEL_TRY(const ClipTimes times, clip_times(clip, options.fps, document.limits, options.warn));
    MESHREEL_TRY(const GltfBody body, read_gltf_body(document, scene, number ? &clip : nullptr, options.warn));
    tell_left_out(document, body, options);

    Animation animation;
    MESHREEL_TRY(const Selection chosen, select_frames(options.frames, times.times_s.size()));
    MESHREEL_CHECK(within_work(document.limits, chosen.count, work_of(scene, body), bytes_of(document)));
    for (std::uint64_t f = 0; f < chosen.count; ++f) animation.times_s.push_back(times.times_s[chosen[f]]);
    animation.vertex_count = body.vertex_count;
    animation.meta.name = clip.name;
    animation.meta.up = Axis::y;
    animation.meta.metres_per_unit = 1;
    animation.meta.fps = times.fps / static_cast<double>(chosen.step);
    MESHREEL_CHECK(read_gltf_appearance({document, scene, body, options.warn}, animation));
    MESHREEL_CHECK(
        within(document.limits, animation.vertex_count, animation.triangles.size(), animation.frame_count()));
    MESHREEL_CHECK(document.budget->take(animation.frame_count() * animation.vertex_count * 12,
                                         document.json().member("animations")));
    animation.positions.resize(animation.frame_count() * animation.vertex_count * 3);
    turn_normals(scene, body, pose_at(scene, &clip, animation.times_s[0]), animation);
    for (std::size_t f = 0; f < animation.frame_count(); ++f) {
        report(options.progress, "baking", static_cast<double>(f) / static_cast<double>(animation.frame_count()));
        bake(scene, body, pose_at(scene, &clip, animation.times_s[f]), animation.frame(f));
    }
    return animation;
}

} // namespace

Result<Animation> load_gltf(const std::string& path, const LoadOptions& options)
{
    LoadOptions named = options;
    if (options.warn) named.warn = [&](std::string sentence) { options.warn(concat(path, ": ", sentence)); };
    MESHREEL_TRY(const GltfDocument document, in_file(read_gltf_document(path, options.limits), path));
    return in_file(load(document, named), path);
}

} // namespace meshreel::io
