/// A verb of the command, and the table of all verbs.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include <CLI/CLI.hpp>

#include "cli/console.h"
#include "cli/report.h"
#include "meshreel/base/result.h"

namespace meshreel::cli {

/// One verb: its members are its options. To add a verb, write one file and one row of the table in verbs.cpp.
class Verb {
public:
    virtual ~Verb() = default;
    /// Declares arguments, options and, as the footer, examples. -q, -v and --json are declared for every verb.
    virtual void declare(CLI::App& app) = 0;
    /// Does the work. An error becomes its exit code, a sentence, and JSON where that was asked for.
    virtual Result<Report> run(Console& console) = 0;
};

/// One row of the table.
struct VerbRow {
    std::string_view name;
    std::string_view summary;
    std::unique_ptr<Verb> (*make)();
};

/// Every verb, in the order of the help.
std::span<const VerbRow> verbs();

} // namespace meshreel::cli
