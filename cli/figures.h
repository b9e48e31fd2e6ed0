/// The figures of an animation, under the same names in every verb's JSON.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cli/report.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::cli {

/// Bytes of the bare animation: F x V x 3 float32 and T x 3 uint32.
unsigned long long raw_bytes(const Animation& animation);

/// Adds "vertices", "triangles", "frames", "start_s", "end_s".
void add_counts(Json& figures, const Animation& animation);

/// Adds "attributes", "materials", "groups", "assets", "meta".
void add_contents(Json& figures, const Animation& animation);

/// "name", "loop", "up", "metres_per_unit", "fps"; null where unknown.
Json meta_json(const Metadata& meta);

/// "2 500 vertices, 4 800 triangles, 100 frames".
std::string counts_text(const Animation& animation);

/// Lines for people: times, attributes, materials, groups, assets, units.
std::string contents_text(const Animation& animation);

} // namespace meshreel::cli
