// The grammar of skeleton descriptions: what is read, and what is said of mistakes.
#include "espalier/base/file.h"
#include "espalier/language/notation.h"
#include "espalier/language/reader.h"

#include "catch.h"
#include "language/sdl/skeleton.h"
#include "language/sdl/translation.h"
#include "language/text/marks.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

using namespace espalier;
namespace fs = std::filesystem;

namespace {

namespace sdl = language::sdl;

const char* const straw = R"(// source for describing simple straw skeleton
define{
  start[0,1,0,0];
  straw[0.5:0.3,0.8:0.3,0,30:10];
}
rules{
  start -> (straw);
  straw -> (straw);
}
)";

std::string complaint(const std::string& text) {
    try {
        sdl::parse(text, "test.sdl");
    } catch (const UserError& error) {
        return error.what();
    }
    return "";
}

std::vector<fs::path> files_in(const char* folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(fs::path(ESPALIER_SOURCE_DIR) / folder)) {
        if (entry.path().extension() == ".sdl") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

TEST_CASE("the straw of Szemla's paper is read as it is printed", "[sdl]") {
    const sdl::Skeleton skeleton = sdl::parse(straw, "straw.sdl");
    REQUIRE(skeleton.components.size() == 2);
    const sdl::Component& part = skeleton.components[1];
    CHECK(part.name == "straw");
    CHECK(*part.features[sdl::Component::beginning].middle.number == 0.5);
    CHECK(*part.features[sdl::Component::beginning].deviation->number == 0.3);
    CHECK(*part.features[sdl::Component::length].middle.number == 0.8);
    CHECK_FALSE(part.features[sdl::Component::vertical].deviation);
    CHECK(*part.features[sdl::Component::horizontal].deviation->number == 10);
    CHECK(skeleton.start().name == "start");
    REQUIRE(skeleton.rules.size() == 2);
    CHECK(skeleton.rules[1].right_sides[0].slaves[0].component == "straw");
}

TEST_CASE("NULL, #const_ver, #const_hor, empty right sides and nested branches belong to the grammar", "[sdl]") {
    const sdl::Skeleton skeleton = sdl::parse(
        "define{#const_ver a[0,1,-2.5,3e1:.5];#const_hor b[0,1,0,0];c[NULL];}rules{a->(a b(c()c)b);b->();}", "x.sdl");
    CHECK(skeleton.components[0].constant_ver);
    CHECK_FALSE(skeleton.components[0].constant_hor);
    CHECK(*skeleton.components[0].features[sdl::Component::vertical].middle.number == -2.5);
    CHECK(*skeleton.components[0].features[sdl::Component::horizontal].middle.number == 30);
    CHECK(skeleton.components[1].constant_hor);
    CHECK(skeleton.components[2].is_null);
    REQUIRE(skeleton.rules[0].right_sides[0].slaves.size() == 3);
    CHECK(skeleton.rules[0].right_sides[0].slaves[1].slaves.size() == 2);
    CHECK(skeleton.rules[1].right_sides[0].slaves.empty());
}

TEST_CASE("a description may have no rules, and then begins with its first component", "[sdl]") {
    CHECK(sdl::parse("define { a[0,1,0,0]; b[0,1,0,0]; } rules { }", "x.sdl").start().name == "a");
}

TEST_CASE("features that are left out at the end are 0, as the paper's grammar allows", "[sdl]") {
    const sdl::Skeleton skeleton = sdl::parse("define{ a[0.5]; b[0, 2:1]; c[1, 2, 30]; } rules{}", "x.sdl");
    const sdl::Skeleton whole = sdl::parse("define{ a[0.5,0,0,0]; b[0,2:1,0,0]; c[1,2,30,0]; } rules{}", "x.sdl");
    CHECK(sdl::to_text(skeleton) == sdl::to_text(whole));
    CHECK_THAT(complaint("define{ a[]; } rules{}"), Catch::Contains("the beginning of 'a'"));
    CHECK_THAT(complaint("define{ a[0,]; } rules{}"), Catch::Contains("the length of 'a'"));
}

TEST_CASE("define and rules may be empty: nothing grows, with a warning", "[sdl]") {
    CHECK(sdl::to_text(sdl::parse("define{ } rules{ }", "x.sdl")) == "define{\n}\nrules{\n}\n");
    const TranslatedText model = sdl::model_of(sdl::parse("define{} rules{} generations 3;", "x.sdl"), "x.sdl");
    REQUIRE(model.warnings.size() == 1);
    CHECK_THAT(model.warnings[0].message, Catch::Contains("has no components"));
    CHECK(read_model_text(model.text, "x")->systems.size() == 1);
    CHECK_THAT(complaint("define{} rules{ a -> (); }"), Catch::Contains("component 'a' is not defined"));
}

TEST_CASE("expressions, cycles, weights, fibres and generations are read", "[sdl]") {
    const sdl::Skeleton skeleton = sdl::parse(R"(
        define{ a[0,1,0,0]; b[0.2 + i / 4, -length / (2 + i), 360 * i / 3, 2 * 10 : 3]; }
        rules{ a -> (b*3) : 0.7 | () : 0.3; }
        fibres{ wooden a{ cut[0.1]; ring[0, 0.5]; contour[10]; } leaf{ solid; quality[4, 6]; material[3, 1]; } }
        generations 7;)",
                                              "x.sdl");
    const sdl::Component& b = skeleton.components[1];
    CHECK(language::without_marks(b.features[0].middle.text) == "0.2 + i / 4");
    CHECK(language::without_marks(b.features[1].middle.text) == "-length / (2 + i)");
    CHECK(*b.features[3].middle.number == 20);
    CHECK(skeleton.rules[0].right_sides.size() == 2);
    CHECK(skeleton.rules[0].right_sides[0].slaves[0].count == 3);
    CHECK(*skeleton.rules[0].right_sides[1].weight->number == 0.3);
    REQUIRE(skeleton.fibres.size() == 2);
    CHECK_FALSE(skeleton.fibres[0].is_flat);
    CHECK_FALSE(skeleton.fibres[1].is_flat);  // because it says solid
    CHECK(skeleton.fibres[1].magnets == 6);
    CHECK(skeleton.fibre_of("a") == &skeleton.fibres[0]);
    CHECK(skeleton.fibre_of("b") == &skeleton.fibres[1]);
    CHECK(skeleton.generations == 7);
}

TEST_CASE("a skeleton is printed as a text that parses as the same skeleton", "[sdl]") {
    std::vector<std::string> texts{straw, "define{a[0,1,0,0];}rules{}"};
    for (const fs::path& file : files_in("models/sdl")) texts.push_back(read_text(file));
    CHECK(texts.size() > 6);
    for (const std::string& text : texts) {
        const std::string printed = sdl::to_text(sdl::parse(text, "first.sdl"));
        CHECK(sdl::to_text(sdl::parse(printed, "printed.sdl")) == printed);
    }
    CHECK(sdl::to_text(sdl::parse(straw, "straw.sdl")) ==
          "define{\n  start[0, 1, 0, 0];\n  straw[0.5:0.3, 0.8:0.3, 0, 30:10];\n}\n"
          "rules{\n  start -> (straw);\n  straw -> (straw);\n}\n");
}

// ESPALIER_APPROVE=1 in the environment writes what is said now as what is to be said.
TEST_CASE("every mistake in a skeleton is explained at its place as approved", "[sdl]") {
    const std::vector<fs::path> files = files_in("tests/language/sdl/mistakes");
    CHECK(files.size() >= 30);
    for (const fs::path& file : files) {
        std::string said;
        try {
            sdl::parse(read_text(file), file.filename().string());
        } catch (const UserError& error) {
            said = error.what();
        }
        INFO(file);
        CHECK(said.starts_with(file.filename().string() + ":"));
        fs::path expected = file;
        expected.replace_extension(".expected");
        if (std::getenv("ESPALIER_APPROVE")) write_text(expected, said + "\n");
        CHECK(said + "\n" == read_text(expected));
    }
}

TEST_CASE("all mistakes of a skeleton are reported at once", "[sdl]") {
    const std::string said = complaint("define{ a[0,1,0,0,5]; b[0,1,0,0]; }\nrules{ a -> (c); b - (a); b -> (d); }\n");
    CHECK(said.find("test.sdl:1:18: ") != std::string::npos);
    CHECK(said.find("test.sdl:2:14: component 'c' is not defined") != std::string::npos);
    CHECK(said.find("test.sdl:2:20: expected '->' after 'b', found '-'") != std::string::npos);
    CHECK(said.find("test.sdl:2:33: component 'd' is not defined") != std::string::npos);
}

TEST_CASE("nesting that no one writes is a mistake, not a crash", "[sdl]") {
    const std::string deep(100000, '(');
    CHECK(complaint("define{ a[" + deep + "0,1,0,0]; } rules{}").find("nested more than 50 deep") != std::string::npos);
    std::string rule = "define{ a[0,1,0,0]; } rules{ a -> ";
    for (int i = 0; i < 1000; ++i) rule += "(a";
    CHECK(complaint(rule).find("nested more than 50 deep") != std::string::npos);
    CHECK(complaint("define{ a[" + std::string(100000, '-') + "1,1,0,0]; } rules{}").find("nested") !=
          std::string::npos);
}

TEST_CASE("the weight of a single right side changes nothing", "[sdl]") {
    const std::string weighted = "define{ a[0,1,0,0]; } rules{ a -> (a) : 1 / generation; }";
    const std::string plain = "define{ a[0,1,0,0]; } rules{ a -> (a); }";
    const auto model = [](const auto& text) { return sdl::model_of(sdl::parse(text, "x.sdl"), "x.sdl").text; };
    CHECK(model(weighted) == model(plain));
}

TEST_CASE("files of the notation are models for every command", "[sdl]") {
    const fs::path file = fs::path(ESPALIER_SOURCE_DIR) / "models/sdl/straw.sdl";
    REQUIRE(language::notation_of(file));
    CHECK(language::notation_of(file)->name == "sdl");
    CHECK(read_model(file)->main().productions.size() == 2);
}
