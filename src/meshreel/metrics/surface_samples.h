/// The distance between two surfaces by sampling, as METRO does it.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/base/parallel.h"
#include "meshreel/metrics/surface_distance.h"

namespace meshreel::metrics {

/// What the samples of one surface found: how far each is from the other surface.
struct SampledDistance {
    double largest = 0.0; ///< squared model units: never more than the one-sided distance (5.16), squared
    double sum = 0.0;     ///< of the squared distances
    std::size_t count = 0;

    double rms() const;
    void add(const SampledDistance& other);
};

struct SampleOptions {
    std::size_t count = 20000; ///< samples, > 0
    std::uint64_t seed = 1;
    Threads threads = {};
};

/// Samples of the triangles of `from`, uniform by area: how many a triangle gets follows from the areas of those before it
/// (systematic sampling), where they lie in it from its number. So the samples turn with the model. A surface without any
/// area is sampled as if its triangles were of equal area. The same for any number of threads.
/// @pre neither is empty  @cost O(T + count log T) mostly
SampledDistance sample_faces(const SurfaceDistance& from, const SurfaceDistance& to, const SampleOptions& options);

/// The vertices and edges of triangles, each once.
struct Outline {
    std::vector<std::uint32_t> vertices;
    std::vector<std::array<std::uint32_t, 2>> edges;

    explicit Outline(std::span<const Triangle> triangles);
};

/// Samples of edges, uniform by length, likewise. positions: [V x 3]. @pre some edges
SampledDistance sample_edges(const Outline& from, std::span<const float> positions, const SurfaceDistance& to,
                             const SampleOptions& options);

/// All vertices of the outline; options.count and seed are not used.
SampledDistance sample_vertices(const Outline& from, std::span<const float> positions, const SurfaceDistance& to,
                                const SampleOptions& options);

} // namespace meshreel::metrics
