/// The JSON of every verb has the keys that docs/cli.md promises, and no other.
// SPDX-License-Identifier: MIT
#include <fstream>
#include <set>
#include <sstream>

#include "meshreel/metrics/metric.h"
#include "tests/cli/command.h"

using meshreel::cli_test::CommandTest;
using Keys = std::set<std::string>;

namespace {

/// The names in backquotes in the first column of a table's line.
void add_first_column(const std::string& line, Keys& keys)
{
    const std::string cell = line.substr(1, line.find('|', 1) - 1);
    for (std::size_t begin = cell.find('`'); begin != std::string::npos;) {
        const std::size_t end = cell.find('`', begin + 1);
        keys.insert(cell.substr(begin + 1, end - begin - 1));
        begin = cell.find('`', end + 1);
    }
}

/// The keys that docs/cli.md lists for a verb, in the tables under its heading whose first column is `column`.
Keys documented(const std::string& verb, const std::string& column = "key")
{
    std::ifstream file(MESHREEL_SOURCE_DIR "/docs/cli.md");
    Keys keys;
    bool in_section = false, in_table = false;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("#")) in_section = line == "### JSON of " + verb;
        if (line.starts_with("| key")) in_table = line.starts_with("| " + column + " |");
        if (in_section && in_table && line.starts_with("| `")) add_first_column(line, keys);
    }
    return keys;
}

Keys keys_of(const nlohmann::json& object)
{
    Keys keys;
    for (const auto& item : object.items()) keys.insert(item.key());
    return keys;
}

} // namespace

class JsonKeys : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        good("generate wave a.pc2 --mesh a.obj --vertices 60 --frames 8");
    }
};

TEST_F(JsonKeys, OfGenerateAreDocumented)
{
    EXPECT_EQ(keys_of(good("generate wave b.pc2 --vertices 60 --frames 8 --json").json()), documented("generate"));
}

TEST_F(JsonKeys, OfConvertAreDocumented)
{
    EXPECT_EQ(keys_of(good("convert a.pc2 --mesh a.obj a.mdd --json").json()), documented("convert"));
}

TEST_F(JsonKeys, OfCompareAreDocumented)
{
    EXPECT_EQ(keys_of(good("compare a.pc2 a.pc2 --mesh a.obj --json").json()), documented("compare"));
}

TEST_F(JsonKeys, OfTheMetricsAreTheNamesOfTheRegistry)
{
    Keys names, found;
    for (const meshreel::metrics::Metric& metric : meshreel::metrics::all())
        for (const meshreel::metrics::Value& value : metric.values) names.emplace(value.name);
    const auto json = good("compare a.pc2 a.pc2 --mesh a.obj --metric all --json").json();
    for (const auto& value : json["values"]) found.insert(value["name"]);
    EXPECT_EQ(keys_of(json["metrics"]), names);
    EXPECT_EQ(found, names);
}

TEST_F(JsonKeys, OfValidateAreDocumented)
{
    EXPECT_EQ(keys_of(good("validate a.pc2 --mesh a.obj --json").json()), documented("validate"));
}

TEST_F(JsonKeys, OfDistortAreDocumented)
{
    EXPECT_EQ(keys_of(good("distort a.pc2 --mesh a.obj d.pc2 smooth --amount 2 --json").json()), documented("distort"));
}

TEST_F(JsonKeys, OfExportAreDocumented)
{
    write("page.html", R"(<script type="application/json" id="manifest">null</script>)");
    const auto json = good("export --html out.html a.pc2 --mesh a.obj --page page.html --json").json();
    EXPECT_EQ(keys_of(json), documented("export"));
}

TEST_F(JsonKeys, OfStudyAreDocumented)
{
    write("scores.csv", "MOS,kg\n1,2\n2,4\n3,3\n");
    EXPECT_EQ(keys_of(good("study correlate scores.csv --json").json()), documented("study"));
}

TEST_F(JsonKeys, OfAnErrorAreDocumented)
{
    EXPECT_EQ(keys_of(run("convert a.pc2 --json").json()), documented("an error"));
}

TEST_F(JsonKeys, OfInfoOnAnyFileAreDocumented)
{
    EXPECT_EQ(keys_of(good("info a.pc2 --mesh a.obj --json").json()), documented("info"));
}

class ReelJsonKeys : public JsonKeys {
protected:
    void SetUp() override
    {
        JsonKeys::SetUp();
        encoded_ = good("encode a.pc2 --mesh a.obj a.reel --json").json();
    }
    nlohmann::json encoded_;
};

TEST_F(ReelJsonKeys, OfEncodeAreDocumented)
{
    EXPECT_EQ(keys_of(encoded_), documented("encode"));
}

TEST_F(ReelJsonKeys, OfDecodeAreDocumented)
{
    EXPECT_EQ(keys_of(good("decode a.reel b.pc2 --json").json()), documented("decode"));
}

TEST_F(ReelJsonKeys, OfInfoOnAReelAreDocumented)
{
    Keys keys = documented("info");
    keys.merge(documented("info", "key of a .reel file"));
    EXPECT_EQ(keys_of(good("info a.reel --json").json()), keys);
}

TEST_F(ReelJsonKeys, OfExplainAreDocumented)
{
    EXPECT_EQ(keys_of(good("explain a.reel --json").json()), documented("explain"));
}

TEST_F(ReelJsonKeys, OfPictureAreDocumented)
{
    EXPECT_EQ(keys_of(good("picture a.pc2 a.reel a.svg --mesh a.obj --json").json()), documented("picture"));
}

TEST_F(ReelJsonKeys, OfValidateAndCompareAreTheSameForAReel)
{
    EXPECT_EQ(keys_of(good("validate a.reel --json").json()), documented("validate"));
    EXPECT_EQ(keys_of(good("compare a.pc2 a.reel --mesh a.obj --json").json()), documented("compare"));
}
