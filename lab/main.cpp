/// meshreel-lab: one measurement of a plan, a JSON object in and one out.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <exception>
#include <map>
#include <string>

#include "lab/experiments.h"
#include "meshreel/codecs/codec.h"

using namespace meshreel;

namespace {

constexpr const char* usage_text = "usage: meshreel-lab about | MEASUREMENT ROW\n"
                                   "ROW is a JSON object; lab/experiments.h says what each measurement takes.\n";

/// What made these figures, and what can be measured.
lab::Json about()
{
    lab::Json names = lab::Json::array();
    for (const codecs::Codec& codec : codecs::all()) names.push_back(codec.name);
    return {{"compiler", MESHREEL_COMPILER}, {"flags", MESHREEL_FLAGS}, {"codecs", names}};
}

int run(const std::string& name, const char* row)
{
    const std::map<std::string, Result<lab::Json> (*)(const lab::Json&)> measurements = {
        {"eigenvalues", lab::eigenvalues},
        {"predictors", lab::predictors},
        {"tripled", lab::tripled},
        {"sweep", lab::sweep},
    };
    const auto found = measurements.find(name);
    if (found == measurements.end()) {
        std::fprintf(stderr, "meshreel-lab: there is no measurement \"%s\"\n%s", name.c_str(), usage_text);
        return 1;
    }
    const Result<lab::Json> figures = found->second(lab::Json::parse(row));
    if (!figures.ok()) {
        std::fprintf(stderr, "meshreel-lab: %s\n", figures.error().sentence().c_str());
        return static_cast<int>(figures.error().code);
    }
    std::printf("%s\n", figures->dump().c_str());
    return 0;
}

} // namespace

int main(int count, char** words)
{
    try {
        if (count == 2 && std::string(words[1]) == "about") {
            std::printf("%s\n", about().dump().c_str());
            return 0;
        }
        if (count == 3) return run(words[1], words[2]);
        std::fputs(usage_text, stderr);
        return 1;
    } catch (const std::exception& error) { // of the JSON library: the row is not what the measurement takes
        std::fprintf(stderr, "meshreel-lab: %s\n", error.what());
        return 1;
    }
}
