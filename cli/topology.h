/// The topology of an animation's surface, as JSON and as lines.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cli/report.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::cli {

Json topology_json(const Animation& animation);
std::string topology_text(const Animation& animation);

} // namespace meshreel::cli
