/// A glTF scene as numbers: node hierarchy, skins, and clips with their samplers.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>

#include "meshreel/io/gltf_document.h"

namespace meshreel::io {

constexpr std::uint32_t gltf_none = 0xffffffff;

/// x -> A x + b, rows of [A | b].
struct Affine {
    std::array<double, 12> m = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

    std::array<double, 3> operator()(const std::array<double, 3>& p) const;
    friend Affine operator*(const Affine& first, const Affine& second); ///< second is applied first
    double determinant() const;                                         ///< of A
};

struct Trs {
    std::array<double, 3> translation = {0, 0, 0};
    std::array<double, 4> rotation = {0, 0, 0, 1}; ///< quaternion x y z w; need not be of unit length
    std::array<double, 3> scale = {1, 1, 1};

    Affine matrix() const;
};

struct GltfNode {
    std::string name;
    std::uint32_t parent = gltf_none;
    std::uint32_t mesh = gltf_none;
    std::uint32_t skin = gltf_none;
    bool has_matrix = false;
    Affine matrix; ///< where has_matrix
    Trs trs;
    std::vector<double> weights; ///< of the morph targets; the node's, else the mesh's, else empty (all 0)
    bool visible = false;        ///< in the scene that is shown
};

struct GltfSkin {
    std::vector<std::uint32_t> joints; ///< nodes
    std::vector<Affine> inverse_bind;  ///< one a joint
};

struct GltfScene {
    std::vector<GltfNode> nodes;
    std::vector<std::uint32_t> order; ///< all nodes, parents first
    std::vector<GltfSkin> skins;
};

/// Reads nodes and skins. @fails bad_input: a reference out of range, a node with two parents, a cycle, a broken matrix.
Result<GltfScene> read_gltf_scene(const GltfDocument& document);

enum class Interpolation : std::uint8_t { step, linear, cubic };
enum class AnimatedPath : std::uint8_t { translation, rotation, scale, weights };

struct GltfChannel {
    std::uint32_t node = 0;
    AnimatedPath path = AnimatedPath::translation;
    std::uint32_t sampler = 0;
};

/// Keyframes; cubic ones hold in-tangent, value, out-tangent a key.
struct GltfSampler {
    std::vector<double> times; ///< seconds, strictly increasing, at least one
    Numbers output;
    Interpolation interpolation = Interpolation::linear;
    bool used = false;     ///< by a channel that we follow
    std::size_t width = 0; ///< numbers a key; 0 until a channel says so

    double key(std::size_t k, std::size_t part, std::size_t i) const; ///< part: 0 in-tangent, 1 value, 2 out-tangent
};

struct GltfClip {
    std::string name;
    std::vector<GltfChannel> channels;
    std::vector<GltfSampler> samplers;
};

/// animations[number]. Channels that we cannot follow (pointers, missing nodes) are left out and told to `warn`.
Result<GltfClip> read_gltf_clip(const GltfDocument& document, const GltfScene& scene, std::size_t number,
                                const std::function<void(std::string)>& warn);

/// The value of a sampler at a time; before the first key its value, after the last key its value. Rotations along the
/// shorter arc. out: width numbers.  @source glTF 2.0, appendix C
void sample(const GltfSampler& sampler, AnimatedPath path, double time_s, std::span<double> out);

/// The frame times of a clip: see LoadOptions::fps.
struct ClipTimes {
    std::vector<double> times_s;
    double fps = 0.0;
};

/// fps > 0: from the first key on, 1 / fps apart, up to the last key. fps 0: the keys, if they stand on a uniform grid
/// (of at most 240 a second, at least half of it keys); else 30 a second, told to `warn`. @fails bad_input: more frames than allowed.
Result<ClipTimes> clip_times(const GltfClip& clip, double fps, const DecodeLimits& limits,
                             const std::function<void(std::string)>& warn);

} // namespace meshreel::io
