#include "base/toml_depth.h"

#include "espalier/base/settings.h"

#include "catch.h"

using namespace espalier;
using Catch::Contains;

namespace {

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

/// a.a ... a, of so many parts.
std::string key_of(int parts) {
    return repeated("a.", parts - 1) + "a";
}

bool is_too_deep(const std::string& text) {
    return deeper_than_toml_may_be(text).has_value();
}

}  // namespace

TEST_CASE("keys, arrays and tables of TOML may lie 64 deep and no deeper", "[base]") {
    CHECK_FALSE(is_too_deep(key_of(64) + " = 1"));
    CHECK(is_too_deep(key_of(65) + " = 1"));
    CHECK_FALSE(is_too_deep("[" + key_of(60) + "]\n" + key_of(4) + " = 1"));
    CHECK(is_too_deep("[" + key_of(60) + "]\n" + key_of(5) + " = 1"));
    CHECK(is_too_deep("[[ " + key_of(64) + " ]]"));
    CHECK_FALSE(is_too_deep("x = " + repeated("[", 63) + repeated("]", 63)));
    CHECK(is_too_deep("x = " + repeated("[", 64)));
    CHECK_FALSE(is_too_deep("x = " + repeated("{y = ", 63) + "1" + repeated("}", 63)));
    CHECK(is_too_deep("x = " + repeated("{y = ", 64)));
    CHECK(is_too_deep("x = {y = 1, " + key_of(64) + " = 2}"));
    CHECK(is_too_deep("x = [1, {y = [{\"z\" . 'z' = [" + repeated("[ # [\n", 60)));
    CHECK(is_too_deep(repeated("\"a.b\" . ", 64) + "'c' = 1"));
    CHECK(is_too_deep("\xEF\xBB\xBF" + key_of(65) + " = 1"));
}

TEST_CASE("dots and brackets in texts and comments are no depth, and behind them keys still count", "[base]") {
    const std::string much = repeated(".a[{", 100);
    const std::string texts[] = {"s = \"" + much + "\\\" " + much + "\"",
                                 "s = '" + much + "\\'",
                                 "s = \"\"\"" + much + "\n\"\" " + much + "\\\"\"\"\"\"",
                                 "s = '''" + much + "\n''" + much + "'''''",
                                 "s = \"\"",
                                 "s = \"\"\"\"\"\"",
                                 "# " + much,
                                 "s = 1 # " + much,
                                 "s = [\"" + much + "\", # " + much + "\n1]"};
    for (const std::string& text : texts) {
        INFO(text);
        CHECK_NOTHROW(Settings::parse_toml(text, "scene.toml"));
        CHECK_FALSE(is_too_deep(text + "\n" + key_of(64) + " = 1"));
        CHECK(is_too_deep(text + "\n" + key_of(65) + " = 1"));
    }
}

TEST_CASE("siblings are as deep as the first of them, however many there are", "[base]") {
    std::string wide = "[[plant]]\n";
    for (int i = 0; i < 500; ++i) {
        wide += "a" + std::to_string(i) + ".b = [[1, 2], {c = {d = 3}, e.f = [4]}]\n[x.y]\n";
    }
    CHECK_FALSE(is_too_deep(wide));
}

TEST_CASE("a file, a text and a value of the command line that nest too deep are named with their place", "[base]") {
    const std::string deep = "[a]\nb = 1\n" + key_of(64) + " = 1\n";
    CHECK_THROWS_WITH(Settings::parse_toml(deep, "scene.toml"),
                      Contains("scene.toml:3:127: keys, tables and arrays are nested more than 64 deep"));
    Settings settings = Settings::parse_toml("x = 1", "scene.toml");
    CHECK_THROWS_WITH(settings.set("x", repeated("[", 65)), Contains("--set x") && Contains("more than 64 deep"));
    CHECK_THROWS_WITH(settings.set("x", "1\n" + key_of(65) + " = 1"), Contains("more than 64 deep"));
    CHECK_THROWS_WITH(settings.set(key_of(65), "1"), Contains("the key has 65 parts, and may have 64"));
    CHECK_NOTHROW(settings.set("b." + key_of(63), "1"));
}
