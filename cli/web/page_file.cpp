/// Finds the page beside the program; puts data where the page has left room for it.
// SPDX-License-Identifier: MIT
#include "cli/web/page_file.h"

#include <filesystem>

#include <fmt/format.h>

#include "cli/pictures/svg.h"
#include "meshreel/base/file.h"

namespace meshreel::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view room_for_manifest = R"(<script type="application/json" id="manifest">null</script>)";

/// Installed, or in the source tree beside build/.
std::string found_page()
{
    std::error_code none;
    const fs::path folder = fs::read_symlink("/proc/self/exe", none).parent_path();
    for (const char* place : {"../share/meshreel/play.html", "../js/dist/play.html"})
        if (is_regular_file((folder / place).string())) return (folder / place).lexically_normal().string();
    return {};
}

/// JSON within a page must not end its element.
std::string within_page(const Json& json)
{
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    for (std::size_t at = text.find('<'); at != text.npos; at = text.find('<', at)) text.replace(at, 1, "\\u003c");
    return text;
}

} // namespace

Result<std::string> load_page(const std::string& path)
{
    const std::string place = path.empty() ? found_page() : path;
    if (place.empty())
        return Error{ErrorCode::unsupported,
                     "it was not built: run tools/install.sh --with-wasm, then make page",
                     {},
                     "the page"};
    MESHREEL_TRY(const Bytes bytes, read_file(place));
    return std::string(bytes.begin(), bytes.end());
}

Result<std::string> filled_page(const std::string& page, const Json& manifest, const std::vector<ByteView>& items)
{
    const std::size_t at = page.find(room_for_manifest);
    if (at == page.npos) return bad_input("has no room for a manifest: it is not of this version", "page");
    std::string text = page.substr(0, at);
    text += fmt::format(R"(<script type="application/json" id="manifest">{}</script>)", within_page(manifest));
    for (std::size_t i = 0; i < items.size(); ++i)
        text += fmt::format("\n<script type=\"text/plain\" id=\"item-{}\">{}</script>", i, base64(items[i]));
    return text + page.substr(at + room_for_manifest.size());
}

} // namespace meshreel::cli
