/// Small awkward animations: every kind of connectivity that must come through unharmed. For property tests.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "meshreel/mesh/animation.h"

namespace meshreel::test_shapes {

struct Named {
    std::string name;
    Animation animation;
};

/// All of them, valid, the same every time: closed, with handles, holes, boundaries, several components, isolated
/// vertices, non-manifold edges and vertices, duplicated, degenerate and inconsistently oriented triangles, random
/// triangles, no triangle, one frame, no motion, doubled vertices. V <= 1000, F <= 12.
std::vector<Named> all();

Animation tetrahedron();
Animation torus();                ///< one handle
Animation double_torus();         ///< two handles
Animation cube_with_hole();       ///< a cube without one of its sides: one boundary
Animation moebius_strip();        ///< not orientable
Animation two_components();       ///< and three isolated vertices
Animation bow_tie();              ///< two triangles that share one vertex
Animation three_on_an_edge();     ///< a non-manifold edge
Animation duplicated_triangles(); ///< the same triangle twice, rotated and reversed
Animation degenerate_triangles(); ///< repeated vertices among good triangles
Animation inconsistent_grid();    ///< every third triangle reversed
Animation one_triangle();
Animation one_frame();
Animation no_motion();
Animation random_soup(); ///< triangles of random vertices
Animation split_seam();  ///< a tube whose seam vertices are doubled, as UV seams make them
Animation points_only(); ///< no triangle at all

} // namespace meshreel::test_shapes
