#include "espalier/base/settings.h"

#include "catch.h"

#include <functional>
#include <map>

using namespace espalier;
using Catch::Contains;

namespace {

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const UserError& error) {
        return error.what();
    }
    return "";
}

const char* const scene = R"(
[simulation]
steps = 40
label = "lamp"

[environment.water]
voxel = 0.5
[environment.light]
voxel = 0.25
at = [1, 2, 3]
)";

}  // namespace

TEST_CASE("values come with the type asked for, and defaults where the file is silent", "[base]") {
    const Settings root = Settings::parse_toml(scene, "scene.toml");
    CHECK(root.table("simulation").integer("steps") == 40);
    CHECK(root.table("simulation").integer_or("seed", 7) == 7);
    CHECK(root.table("environment").table("light").vector("at") == glm::dvec3(1, 2, 3));
    CHECK(root.table("environment").table("light").number_or("depth", 2.5) == 2.5);
}

TEST_CASE("tables keep the order of the file, because the order of processes has a meaning", "[base]") {
    const Settings root = Settings::parse_toml(scene, "scene.toml");
    CHECK(root.table("environment").keys() == std::vector<std::string>{"water", "light"});
}

TEST_CASE("a key nobody asked for is an error at its place that offers the nearest known name", "[base]") {
    const Settings root = Settings::parse_toml("[light]\nvoxel = 1\ntransmitance = 0.3\n", "scene.toml");
    const Settings light = root.table("light");
    light.number("voxel");
    light.number_or("transmittance", 0.5);
    const std::string message = message_of([&] { root.reject_unread(); });
    CHECK(message.find("scene.toml:3:1") != std::string::npos);
    CHECK(message.find("did you mean 'transmittance'") != std::string::npos);
}

TEST_CASE("a table nobody entered is one error, not one for each of its keys", "[base]") {
    const Settings root = Settings::parse_toml("[ligth]\na = 1\nb = 2\n", "scene.toml");
    try {
        root.reject_unread();
        FAIL("an unread table must be an error");
    } catch (const UserError& error) {
        CHECK(error.diagnostics().size() == 1);
    }
}

TEST_CASE("numbers out of range, not finite or of the wrong type name the place and what was expected", "[base]") {
    const Settings root = Settings::parse_toml("a = -1\nb = nan\nc = \"x\"\nd = [1, 2]", "s.toml");
    CHECK(message_of([&] { root.number("a", Range::positive()); }) == "s.toml:1:1: 'a' must be greater than 0, not -1");
    CHECK(message_of([&] { root.number("b"); }) == "s.toml:2:1: 'b' must be a finite number, not nan");
    CHECK(message_of([&] { root.number("c"); }) == "s.toml:3:1: 'c' must be a number, not a text");
    CHECK(message_of([&] { root.vector("d"); }) == "s.toml:4:1: 'd' must have three numbers [x, y, z], not 2");
    CHECK(message_of([&] { root.number("e"); }).find("'e' is missing") != std::string::npos);
}

TEST_CASE("--set overrides a value, makes a missing one, and enters arrays of tables by number", "[base]") {
    Settings root = Settings::parse_toml("[[plant]]\nname = 'a'\n[[plant]]\nname = 'b'\n", "s.toml");
    root.set("plant.1.name", "c");
    root.set("simulation.steps", "3");
    CHECK(root.tables("plant")[1].text("name") == "c");
    CHECK(root.table("simulation").integer("steps") == 3);
    CHECK_THROWS_AS(root.set("plant.2.name", "d"), UserError);
    CHECK_THROWS_AS(root.set("plant..name", "d"), UserError);
    CHECK_THROWS_AS(root.set("simulation.steps.x", "1"), UserError);
}

TEST_CASE("what was read is resolved with the defaults that were used", "[base]") {
    const Settings root = Settings::parse_toml("a = 1", "s.toml");
    root.integer("a");
    root.number_or("b", 0.5);
    CHECK(root.resolved_json() == "{\n  \"a\": 1,\n  \"b\": 0.5\n}");
}

TEST_CASE("a value of the command line that is no UTF-8 does not keep the settings from being written", "[base]") {
    Settings root = Settings::parse_toml("", "s.toml");
    root.set("name", "\xFF");
    CHECK(root.text("name") == "\xFF");
    CHECK(root.resolved_json() == "{\n  \"name\": \"\uFFFD\"\n}");
}

TEST_CASE("a mistake in TOML shows the line it stands in", "[base]") {
    const std::string message = message_of([] { Settings::parse_toml("a = 1\nb = = 2\n", "s.toml"); });
    CHECK(message.find("s.toml:2:") == 0);
    CHECK(message.find("b = = 2") != std::string::npos);
}

TEST_CASE("a list of points has three numbers each", "[base]") {
    const Settings root =
        Settings::parse_toml("p = [[1, 2, 3], [4.5, 5, 6]]\nq = [[1, 2, 3], [4, 5]]\nr = [1, 2, 3]", "s.toml");
    CHECK(root.vectors("p") == std::vector<glm::dvec3>{{1, 2, 3}, {4.5, 5, 6}});
    CHECK_THROWS_AS(root.vectors("q"), UserError);
    CHECK_THROWS_AS(root.vectors("r"), UserError);
}

TEST_CASE("paths are relative to the file that says them", "[base]") {
    const Settings root = Settings::parse_toml("model = '../m/a.l'", "s.toml", "/scenes");
    CHECK(root.path("model") == "/m/a.l");
}

TEST_CASE("values that may be absent are nothing then, and are read as others where they stand", "[base]") {
    const Settings root = Settings::parse_toml("step = -2\nunit = 'm'\n", "s.toml");
    CHECK(root.number_if_any("step") == -2);
    CHECK(root.text_if_any("unit") == "m");
    CHECK_FALSE(root.number_if_any("lowest"));
    CHECK_FALSE(root.text_if_any("label"));
    CHECK_THROWS_WITH(root.number_if_any("step", Range::positive()), Catch::Contains("s.toml:1"));
    CHECK_THROWS_AS(root.text_if_any("step"), UserError);
}

TEST_CASE("lists of tables and keys that a reader only looks for are offered where a name is misspelt", "[settings]") {
    const Settings settings = Settings::parse_toml("layres = 1\n", "soil.toml");
    CHECK(settings.tables("layers").empty());
    CHECK_THROWS_WITH(settings.reject_unread(), Catch::Contains("did you mean 'layers'?"));
    const Settings scene = Settings::parse_toml("anumation = 'a.a'\n", "scene.toml");
    CHECK_FALSE(scene.path_if_any("animation"));
    CHECK_THROWS_WITH(scene.reject_unread(), Catch::Contains("did you mean 'animation'?"));
    CHECK(scene.number_or("dt", 2) == 2);
    CHECK_FALSE(scene.has("every"));
    CHECK(scene.integer_or("every", 1) == 1);
    CHECK_THAT(scene.resolved_json(), Catch::Contains("\"every\": 1") || Catch::Contains("\"every\":1"));
}

TEST_CASE("texts that begin with '=' are replaced by what they are worth", "[base]") {
    const Settings settings = Settings::parse_toml(
        "a = '= x'\nb = [1, '=y', ['= x']]\nflag = '= one'\nname = 'x = y'\n[[c]]\nd = '= half'\n", "s.toml");
    std::vector<std::string> keys;
    const auto evaluate = [&](std::string_view text, const Place& key) {
        keys.push_back(to_string(key));
        const std::map<std::string_view, double> values{{" x", 3}, {"y", -2}, {" one", 1}, {" half", 0.5}};
        return values.at(text);
    };
    settings.replace_expressions(evaluate);
    CHECK(keys == std::vector<std::string>{"s.toml:1:1", "s.toml:2:1", "s.toml:2:1", "s.toml:3:1", "s.toml:6:1"});
    CHECK(settings.integer("a") == 3);
    CHECK(settings.number("a") == 3);
    CHECK_THROWS_WITH(settings.numbers("b"), Contains("'b' must be a number, not an array"));
    CHECK(settings.flag_or("flag", false));
    CHECK_THROWS_WITH(settings.flag_or("a", false), Contains("s.toml:1:") && Contains("true or false"));
    CHECK(settings.text("name") == "x = y");
    CHECK(settings.tables("c").front().number("d") == 0.5);
    CHECK_THAT(settings.resolved_json(), Contains("\"d\": 0.5"));
}

TEST_CASE("every expression that has no value is told of, with its key and place", "[base]") {
    const Settings settings = Settings::parse_toml("a = '= x'\n[t]\nb = [0, '= y']\n", "s.toml");
    const auto refuse = [](std::string_view text, const Place&) -> double {
        throw UserError("no" + std::string(text));
    };
    try {
        settings.replace_expressions(refuse);
        FAIL("expected an error");
    } catch (const UserError& error) {
        REQUIRE(error.diagnostics().size() == 2);
        CHECK(to_string(error.diagnostics()[0].place) == "s.toml:1:1");
        CHECK(error.diagnostics()[0].message == "the expression of 'a': no x");
        CHECK(to_string(error.diagnostics()[1].place) == "s.toml:3:9");
        CHECK(error.diagnostics()[1].message == "the expression of 'b': no y");
    }
    settings.ignore();
    CHECK_NOTHROW(settings.reject_unread());
}
