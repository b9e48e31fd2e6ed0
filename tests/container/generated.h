/// Parts of documents, and golden files, that the code itself must be able to write.
// SPDX-License-Identifier: MIT
//
// MESHREEL_UPDATE=1 in the environment of a test program rewrites them instead of comparing: look at the difference, and
// think of the files that people have, before it is committed.
#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace meshreel {

inline bool updating()
{
    return std::getenv("MESHREEL_UPDATE") != nullptr;
}

/// A file of the source tree, whole.
inline std::string text_of(const std::string& path)
{
    std::ostringstream text;
    text << std::ifstream(std::string(MESHREEL_SOURCE_DIR) + "/" + path, std::ios::binary).rdbuf();
    return text.str();
}

inline void write_text(const std::string& path, const std::string& text)
{
    std::ofstream(std::string(MESHREEL_SOURCE_DIR) + "/" + path, std::ios::binary) << text;
}

/// Between the lines `<!-- made: name -->` and `<!-- end: name -->` of a document stands exactly `expected`.
inline void expect_section(const std::string& document, const std::string& name, const std::string& expected)
{
    std::string text = text_of(document);
    const std::string open = "<!-- made: " + name + " -->\n", close = "<!-- end: " + name + " -->";
    const std::size_t begin = text.find(open), end = text.find(close);
    ASSERT_TRUE(begin != std::string::npos && end != std::string::npos) << document << " has no section " << name;
    const std::size_t from = begin + open.size();
    if (updating())
        write_text(document, text.replace(from, end - from, expected));
    else
        EXPECT_EQ(text.substr(from, end - from), expected)
            << document << " is not what the code says (MESHREEL_UPDATE=1)";
}

/// A file of the source tree holds exactly `expected`.
inline void expect_file(const std::string& path, const std::string& expected)
{
    if (updating())
        write_text(path, expected);
    else
        EXPECT_EQ(text_of(path), expected) << path << " changed (MESHREEL_UPDATE=1)";
}

} // namespace meshreel
