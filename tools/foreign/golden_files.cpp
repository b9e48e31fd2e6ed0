/// golden_files FOLDER: decodes every golden file of a folder and compares what it means with what is written beside it.
/// golden_files FILE...: a line for each, what it means or "refused: " and why.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "tests/determinism/meaning.h"

using namespace meshreel;

namespace {

Bytes bytes_of(const std::filesystem::path& path)
{
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    const std::string all = text.str();
    return {all.begin(), all.end()};
}

/// Whether a file means what is written; says what it does instead where it does not.
bool holds(const std::filesystem::path& file)
{
    golden::Json expected = golden::Json::parse(std::ifstream(std::filesystem::path(file).replace_extension(".json")));
    std::optional<Animation> base;
    if (expected.contains("base")) {
        const Bytes reel = bytes_of(file.parent_path() / (expected["base"].get<std::string>() + ".reel"));
        base = *decode(reel);
        expected.erase("base");
    }
    const Result<golden::Json> found = golden::meaning_of(bytes_of(file), base ? &*base : nullptr);
    if (found.ok() && *found == expected) return true;
    std::printf("%s: %s\n", file.filename().c_str(),
                found.ok() ? found->dump().c_str() : found.error().message.c_str());
    return false;
}

void tell(const std::filesystem::path& file)
{
    const Result<golden::Json> found = golden::meaning_of(bytes_of(file), nullptr);
    std::printf("%s\n", found.ok() ? found->dump(-1, ' ', false, golden::Json::error_handler_t::replace).c_str()
                                   : ("refused: " + found.error().sentence()).c_str());
}

} // namespace

int main(int count, char** words)
{
    if (count < 2) return 2;
    if (!std::filesystem::is_directory(words[1])) {
        std::for_each(words + 1, words + count, tell);
        return 0;
    }
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(words[1]))
        if (entry.path().extension() == ".reel") files.push_back(entry.path());
    const auto wrong = std::ranges::count_if(files, [](const auto& file) { return !holds(file); });
    std::printf("%zu files, %zu wrong\n", files.size(), static_cast<std::size_t>(wrong));
    return files.empty() || wrong > 0 ? 1 : 0;
}
