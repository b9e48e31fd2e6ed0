/// Made animations and files for the tests of this room.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "meshreel/base/file.h"
#include "meshreel/base/random.h"
#include "meshreel/io/io.h"

namespace meshreel::io::test {

/// A folder that goes away with the test.
struct Folder {
    std::filesystem::path path;
    Folder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "meshreel_io_XXXXXX").string();
        path = ::mkdtemp(name.data());
    }
    ~Folder() { std::filesystem::remove_all(path); }
    std::string operator/(const std::string& name) const { return (path / name).string(); }
    std::size_t file_count() const
    {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path), {}));
    }
};

inline Bytes bytes_of(std::string_view text)
{
    return Bytes(text.begin(), text.end());
}
inline std::string text_of(const Bytes& bytes)
{
    return std::string(bytes.begin(), bytes.end());
}

inline void write(const std::string& path, std::string_view text)
{
    std::ofstream(path, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
}
inline std::string read(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// A tetrahedron that moves through awkward float32 numbers, `frames` frames at 24 a second.
inline Animation tetrahedron(std::size_t frames)
{
    Animation made;
    made.vertex_count = 4;
    made.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    made.positions.resize(frames * 12);
    std::uint32_t state = 1;
    for (float& value : made.positions) {
        state = state * 1664525u + 1013904223u;
        const std::uint32_t bits = (state & 0x807fffffu) | ((100u + (state >> 8) % 40u) << 23);
        std::memcpy(&value, &bits, sizeof value);
    }
    made.times_s = uniform_times(frames, 24.0);
    return made;
}

/// Options that collect the warnings.
struct Listener {
    std::vector<std::string> heard;
    LoadOptions options;
    Listener()
    {
        options.warn = [this](std::string sentence) { heard.push_back(std::move(sentence)); };
    }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;
    bool has(const std::string& part) const
    {
        for (const std::string& sentence : heard)
            if (sentence.find(part) != std::string::npos) return true;
        return false;
    }
};

template <class T>
std::string why(const Result<T>& result)
{
    return result.ok() ? "it worked" : result.error().sentence();
}

/// Bit-equality of the positions: -0 differs from 0.
inline bool same_bits(const std::vector<float>& a, const std::vector<float>& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

} // namespace meshreel::io::test
