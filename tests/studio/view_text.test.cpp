// Settings of view files in their texts: every place is found, and an edit leaves what else is written.
#include "studio/document/view_text.h"

#include "espalier/base/error.h"

#include "catch.h"
#include "replaced.h"

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace espalier;
using namespace espalier::studio;

namespace {

const std::string text =
    "/* scale factor: 9 */\n#define S scale factor: 8\nscale factor: 2 z buffer: on\nlight: V 1,2,3 A 0.5\n"
    "light: O 0 1 0\nbackground color: 1\n2 3\n";

std::vector<ViewEntry> entries_of(const std::string& name, const std::string& of = text) {
    std::vector<ViewEntry> entries = read_view_entries("plant.v", of);
    std::erase_if(entries, [&](const ViewEntry& entry) { return entry.name != name; });
    return entries;
}

std::string edited(const std::string& name, int number, const Nullable<std::string>& values) {
    return with_view_edit(text, {name, number, {}, values});
}

std::string with_letter(int number, const std::string& letter, const Nullable<std::string>& values) {
    return with_view_edit(text, {"light:", number, letter, values});
}

}  // namespace

TEST_CASE("settings of view files are found where they are written, not in comments", "[studio]") {
    const auto scale = entries_of("scale factor:");
    REQUIRE(scale.size() == 1);
    CHECK(scale[0].path == "plant.v");
    CHECK(scale[0].values == std::vector<std::string>{"2"});
    CHECK(entries_of("background color:")[0].values == std::vector<std::string>{"1", "2", "3"});
    CHECK(entries_of("scale factor:", "xscale factor: 2\n").empty());
    CHECK(entries_of("scale factor:", "z buffer: on scale factor: 2").size() == 1);
    CHECK(entries_of("scale factor:", "line style: pixel scale factor: 2").empty());
}

TEST_CASE("the values of a line of letters are known by letter", "[studio]") {
    const auto lights = entries_of("light:");
    REQUIRE(lights.size() == 2);
    CHECK(lights[0].letters == std::map<std::string, std::vector<std::string>>{{"A", {"0.5"}}, {"V", {"1", "2", "3"}}});
    CHECK(lights[1].letters.at("O") == std::vector<std::string>{"0", "1", "0"});
}

TEST_CASE("a value is written in its place, or at the end if the text has none", "[studio]") {
    CHECK(edited("scale factor:", 0, "3.5") == replaced(text, "factor: 2 z", "factor: 3.5 z"));
    CHECK(edited("scale factor:", 1, "4") == text + "scale factor: 4\n");
    CHECK(with_view_edit("line style: pixel", {"scale factor:", 0, {}, "4"}) == "line style: pixel\nscale factor: 4\n");
}

TEST_CASE("a setting that is taken out takes its line with it if nothing else stands there", "[studio]") {
    CHECK(edited("light:", 1, std::nullopt) == replaced(text, "light: O 0 1 0\n", ""));
    CHECK(edited("scale factor:", 0, std::nullopt) == replaced(text, "scale factor: 2 z", "z"));
}

TEST_CASE("an edit of a letter leaves the other letters of its line", "[studio]") {
    CHECK(with_letter(0, "A", "0.25") == replaced(text, "V 1,2,3 A 0.5", "V 1 2 3 A 0.25"));
    CHECK(with_letter(0, "D", "1") == replaced(text, "V 1,2,3 A 0.5", "V 1 2 3 A 0.5 D 1"));
    CHECK(with_letter(0, "A", std::nullopt) == replaced(text, "V 1,2,3 A 0.5", "V 1 2 3"));
    // A light stands at a place or comes from a direction.
    CHECK(with_letter(0, "O", "4 5 6") == replaced(text, "V 1,2,3 A 0.5", "A 0.5 O 4 5 6"));
}

TEST_CASE("what is no setting, no place or more than a line is no edit of a view file", "[studio]") {
    CHECK_THROWS_AS(edited("scales factor:", 0, "1"), UserError);
    CHECK_THROWS_AS(edited("scale factor:", 2, "1"), UserError);
    CHECK_THROWS_AS(edited("scale factor:", 0, "1\nlight: V 1 2 3"), UserError);
}

TEST_CASE("the values of all view files of the library, written back, leave what is read", "[studio]") {
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(ESPALIER_SOURCE_DIR "/models")) {
        if (entry.path().extension() != ".v") continue;
        INFO(entry.path());
        std::stringstream content;
        content << std::ifstream(entry.path()).rdbuf();
        const std::vector<ViewEntry> before = read_view_entries(entry.path(), content.str());
        CHECK_FALSE(before.empty());
        std::string now = content.str();
        std::map<std::string, int> number;
        for (const ViewEntry& one : before) {
            std::string values;
            for (const std::string& word : one.values) values += (values.empty() ? "" : " ") + word;
            now = with_view_edit(now, {one.name, number[one.name]++, {}, values});
        }
        const std::vector<ViewEntry> after = read_view_entries(entry.path(), now);
        REQUIRE(after.size() == before.size());
        for (std::size_t i = 0; i < before.size(); ++i) CHECK(after[i].values == before[i].values);
        ++files;
    }
    CHECK(files > 5);
}
