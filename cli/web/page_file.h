/// The page that plays animations (js/play), as `make page` builds it, and what is put into it.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "cli/report.h"
#include "meshreel/base/result.h"
#include "meshreel/base/views.h"

namespace meshreel::cli {

/// The page: of `path`; where that is empty, installed beside this program or built in the tree that it was built in.
/// @fails io; unsupported: it was not built.
Result<std::string> load_page(const std::string& path);

/// The page with a manifest in it and data as base 64, under the ids item-0, item-1, ...: it needs no server.
/// @fails bad_input: it is no such page.
Result<std::string> filled_page(const std::string& page, const Json& manifest, const std::vector<ByteView>& items);

} // namespace meshreel::cli
