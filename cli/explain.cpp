/// explain: every field of a .reel file with its byte offset.
// SPDX-License-Identifier: MIT
#include <string>
#include <string_view>

#include "cli/source.h"
#include "cli/verb.h"
#include "meshreel/base/file.h"
#include "meshreel/meshreel.h"

namespace meshreel::cli {

namespace {

Json lines_of(std::string_view text)
{
    Json lines = Json::array();
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        lines.push_back(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return lines;
}

class Explain : public Verb {
public:
    void declare(CLI::App& app) override
    {
        app.add_option("FILE", source_.path, "a .reel file, or -")->required();
        source_.declare_limits(app);
        app.footer("Examples:\n"
                   "  meshreel explain walk.reel\n"
                   "  meshreel explain - < walk.reel\n");
    }

    Result<Report> run(Console&) override
    {
        MESHREEL_TRY(const Bytes bytes, read_file(source_.path, source_.limits));
        MESHREEL_TRY(const std::string text, in_file(explain(bytes, source_.limits), source_.path));
        Json figures{{"schema", "meshreel.explain/1"}, {"file", source_.path}, {"file_bytes", bytes.size()}};
        figures["lines"] = lines_of(text);
        return Report{figures, text, true};
    }

private:
    Source source_;
};

} // namespace

std::unique_ptr<Verb> make_explain()
{
    return std::make_unique<Explain>();
}

} // namespace meshreel::cli
