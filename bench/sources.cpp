/// Where the sequences come from.
// SPDX-License-Identifier: MIT
#include "bench/sources.h"

#include <cstdio>
#include <filesystem>

#include "meshreel/io/io.h"
#include "meshreel/mesh/shapes.h"

namespace fs = std::filesystem;

namespace meshreel::bench {

std::vector<Source> sources(const std::string& data, const std::string& only)
{
    std::vector<Source> all;
    for (const char* name :
         {"dance", "chicken", "cow", "crane", "horse_gallop", "walker", "cloth", "flag", "snake", "dolphin", "bone"}) {
        const fs::path folder = fs::path(data) / name;
        if (!fs::exists(folder / "motion.pc2")) {
            std::fprintf(stderr, "%s: skipped, its data are not here\n", name);
            continue;
        }
        all.push_back({name, [folder] {
                           io::LoadOptions options;
                           options.mesh = (folder / "mesh.obj").string();
                           return must(io::load((folder / "motion.pc2").string(), options));
                       }});
    }
    for (const shapes::Shape& shape : shapes::all())
        all.push_back({"made:" + std::string(shape.name), [&shape] { return must(shapes::generate(shape)); }});
    std::erase_if(all, [&](const Source& s) { return s.name.find(only) == std::string::npos; });
    return all;
}

int program(int count, char** words, const Options& options, const std::function<int()>& work)
{
    try {
        for (int i = 1; i < count; i += 2) {
            const auto found = options.find(words[i]);
            if (found == options.end()) throw std::runtime_error(std::string("there is no option ") + words[i]);
            if (i + 1 == count) throw std::runtime_error(std::string("no value for ") + words[i]);
            found->second(words[i + 1]);
        }
        return work();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", words[0], error.what());
        return 1;
    }
}

} // namespace meshreel::bench
