/// The command meshreel: finds the verb, reads its options, runs it, and turns the outcome into an exit code.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/hint.h"
#include "cli/interrupt.h"
#include "cli/verb.h"
#include "meshreel/base/check.h"
#include "meshreel/version.h"

namespace meshreel::cli {

namespace {

constexpr const char* exit_codes = "Exit codes: 0 done, 1 usage, 2 file cannot be read or written, 3 bad input,\n"
                                   "4 runtime, 5 unsupported, 7 a quality or threshold is missed.\n";

std::string overview()
{
    std::string text = fmt::format("meshreel {}: makes triangle-mesh animations small.\n\n", version);
    text += "Usage: meshreel VERB [OPTIONS] ...\n\nVerbs:\n";
    for (const VerbRow& row : verbs()) text += fmt::format("  {:<10} {}\n", row.name, row.summary);
    text += "\n  meshreel VERB --help    options and examples of a verb\n"
            "  meshreel --version      the version\n\n"
            "Examples:\n  meshreel encode walk.glb walk.reel\n  meshreel decode walk.reel walk.####.obj\n"
            "  meshreel compare walk.glb walk.reel\n\n";
    return text + exit_codes;
}

Error usage(std::string message)
{
    return {ErrorCode::usage, std::move(message)};
}

/// Standard output is part of the result: what cannot be written there is an error like any other.
Status print(const std::string& text)
{
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (written) return Ok{};
    return Error{ErrorCode::io, "cannot write", {}, "standard output"};
}

int fail(const Error& error, Console& console)
{
    console.error(error.sentence());
    if (console.json) {
        const Json json{{"schema", "meshreel.error/1"}, {"error", error_json(error)}};
        (void)print(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"); // the exit code tells already
    }
    return static_cast<int>(error.code);
}

/// Writes the report where it belongs and gives the exit code.
int tell(const Report& report, Console& console)
{
    console.clear_bar();
    Status written = Ok{};
    if (console.json)
        written = print(report.figures.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    else if (report.text_is_result)
        written = print(report.text);
    else
        console.say(report.text);
    if (!written.ok()) return fail(written.error(), console);
    if (!report.complaint.empty()) console.error(report.complaint);
    return report.exit_code;
}

Error unknown_verb(const std::string& name)
{
    std::vector<std::string> names;
    for (const VerbRow& row : verbs()) names.emplace_back(row.name);
    const std::string near = nearest(name, names);
    const std::string hint = near.empty() ? "" : fmt::format("did you mean '{}'? ", near);
    return usage(fmt::format("there is no verb '{}'; {}see meshreel --help", name, hint));
}

/// What is left over after parsing: an unknown option, or one argument too many.
Status check_extras(const CLI::App& app)
{
    const std::vector<std::string> extras = app.remaining();
    if (extras.empty()) return Ok{};
    const auto dashed = [](const std::string& text) { return text.size() > 1 && text.front() == '-'; };
    const auto option = std::find_if(extras.begin(), extras.end(), dashed);
    if (option == extras.end())
        return usage(fmt::format("'{}' is one argument too many; see {} --help", extras.front(), app.get_name()));
    std::vector<std::string> known;
    for (const CLI::Option* declared : app.get_options())
        for (const std::string& name : declared->get_lnames()) known.push_back("--" + name);
    const std::string name = option->substr(0, option->find('='));
    const std::string near = nearest(name, known);
    const std::string hint = near.empty() ? "" : fmt::format("did you mean {}? ", near);
    return usage(fmt::format("there is no option {}; {}see {} --help", name, hint, app.get_name()));
}

/// Reads the options of a verb. Its help is a result too: `help` is set and nothing else happens.
Status parse(CLI::App& app, std::vector<std::string> arguments, std::string& help)
{
    std::reverse(arguments.begin(), arguments.end()); // as CLI11 wants them
    app.allow_extras();
    try {
        app.parse(arguments);
    } catch (const CLI::CallForHelp&) {
        help = app.help();
        return Ok{};
    } catch (const CLI::ParseError& error) {
        MESHREEL_CHECK(check_extras(app));
        std::string sentence = error.what();
        std::replace(sentence.begin(), sentence.end(), '\n', ' ');
        return usage(fmt::format("{}; see {} --help", sentence, app.get_name()));
    }
    return check_extras(app);
}

int run_verb(const VerbRow& row, const std::vector<std::string>& arguments, Console& console)
{
    const std::unique_ptr<Verb> verb = row.make();
    CLI::App app{std::string(row.summary), fmt::format("meshreel {}", row.name)};
    app.get_formatter()->column_width(34);
    app.set_help_flag("-h,--help", "this text");
    verb->declare(app);
    app.add_flag("-q,--quiet", console.quiet, "say nothing but errors")->group("Talk");
    app.add_flag("-v,--verbose", console.verbose, "say more")->group("Talk");
    app.add_flag("--json", console.json, "print figures as JSON on standard output; see docs/cli.md")->group("Talk");
    std::string help;
    const Status parsed = parse(app, arguments, help);
    if (!parsed.ok()) return fail(parsed.error(), console);
    if (!help.empty()) return tell({{}, help, true}, console);
    Result<Report> report = verb->run(console);
    return report.ok() ? tell(*report, console) : fail(report.error(), console);
}

int dispatch(std::vector<std::string> arguments, Console& console)
{
    if (arguments.empty()) {
        console.error("a verb is missing; see meshreel --help");
        return static_cast<int>(ErrorCode::usage);
    }
    std::string first = arguments.front();
    arguments.erase(arguments.begin());
    if (first == "help" && !arguments.empty()) {
        first = arguments.front();
        arguments = {"--help"};
    }
    if (first == "--help" || first == "-h" || first == "help") return tell({{}, overview(), true}, console);
    if (first == "--version") return tell({{}, fmt::format("meshreel {}\n", version), true}, console);
    for (const VerbRow& row : verbs())
        if (row.name == first) return run_verb(row, arguments, console);
    return fail(unknown_verb(first), console);
}

/// Runs the command; whatever is thrown ends as a sentence too.
int guarded(const std::vector<std::string>& arguments, Console& console)
{
    try {
        return dispatch(arguments, console);
    } catch (const std::bad_alloc&) {
        return fail({ErrorCode::runtime, "out of memory"}, console);
    } catch (const Misuse& misuse) {
        return fail(usage(misuse.what()), console);
    } catch (const std::exception& error) {
        return fail({ErrorCode::runtime, error.what()}, console);
    }
}

} // namespace

} // namespace meshreel::cli

int main(int count, char** texts)
{
    using namespace meshreel::cli;
    const std::vector<std::string> arguments(texts + std::min(count, 1), texts + count);
    Console console;
    // Known before the options are, so that an error in them is JSON too.
    const bool json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
    const bool help = std::find(arguments.begin(), arguments.end(), "--help") != arguments.end();
    console.json = json && !help;
    watch_for_interrupts();
    return guarded(arguments, console);
}
