#include "base/toml_words.h"

#include "espalier/base/error.h"
#include "espalier/base/settings.h"

#include "catch.h"

using namespace espalier;
using Catch::Contains;

TEST_CASE("a number with its unit is told what to write", "[base]") {
    for (const std::string value : {"0.1 m", "0.1m", "0.1 %", "0.1\tcm/h", "0.1 \u00b5m", "0.1 m "}) {
        INFO(value);
        CHECK_THROWS_WITH(Settings::parse_toml("a = 1\nvoxel = " + value + "\n", "scene.toml"),
                          Contains("scene.toml:2:") && Contains("a number stands without its unit: voxel = 0.1;"));
    }
}

TEST_CASE("what else is no TOML is told without the parser's words", "[base]") {
    for (const std::string text : {"voxel = = 2", "voxel", "= 3", "voxel = \"a", "[a", "voxel = 0.1 \"m\"", ""}) {
        INFO(text);
        if (text.empty()) {
            CHECK_NOTHROW(Settings::parse_toml(text, "scene.toml"));
            continue;
        }
        CHECK_THROWS_WITH(Settings::parse_toml(text, "scene.toml"),
                          Contains("scene.toml:1:") && Contains("this is no TOML: ") && !Contains("Error while"));
    }
}

TEST_CASE("numbers of --set may be padded with zeros", "[base]") {
    const auto steps = [](const char* value) {
        Settings settings = Settings::parse_toml("steps = 1\n", "scene.toml");
        settings.set("steps", value);
        return settings.integer("steps");
    };
    CHECK(steps("007") == 7);
    CHECK(steps("010") == 10);
    CHECK(steps("000") == 0);
    CHECK(steps("0x10") == 16);  // TOML
    CHECK_THROWS_AS(steps("00a"), UserError);
}
