/// The sequences of the benchmarks: real ones where they are at hand, and every generated shape.
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "meshreel/base/result.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::bench {

/// A sequence that can be had again in every child process.
struct Source {
    std::string name;
    std::function<Animation()> load;
};

inline const std::string usual_data = MESHREEL_SOURCE_DIR "/../shared/data";

/// Those whose name contains `only`. data: the folder of the real ones.
std::vector<Source> sources(const std::string& data, const std::string& only);

/// What an option's value is given to, by the option's name.
using Options = std::map<std::string, std::function<void(const std::string&)>>;

/// What a bench's main() does: reads "--name value" pairs, then works. An option that is not in the table or has no value,
/// and whatever the work throws, is told on standard error. Returns the exit code.
int program(int count, char** words, const Options& options, const std::function<int()>& work);

template <class T>
T must(Result<T> result)
{
    if (!result.ok()) throw std::runtime_error(result.error().sentence());
    return *std::move(result);
}

} // namespace meshreel::bench
