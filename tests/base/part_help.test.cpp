#include "base/part_help.h"

#include "catch.h"

using namespace espalier;

namespace {

HelpRow row_of(const std::string& text) {
    const std::vector<HelpRow> rows = parameters_of("key  " + text);
    REQUIRE(rows.size() == 1);
    return rows.front();
}

}  // namespace

TEST_CASE("a row of a help text says default, unit, range and meaning", "[base]") {
    const HelpRow voxel = row_of("0.5 m, > 0; edge of a voxel; it is a cube");
    CHECK(voxel.fallback == "0.5");
    CHECK(voxel.unit == "m");
    CHECK(voxel.range == "> 0");
    CHECK(voxel.meaning == "edge of a voxel; it is a cube");
    CHECK(row_of("required, m, 0 to 1; a place").fallback == "required");
    CHECK(row_of("required, m, 0 to 1; a place").unit == "m");
    CHECK(row_of("360 degrees, > 0, <= 360; an angle").range == "> 0, <= 360");
    CHECK(row_of("[0, 0, -1]; to the north").fallback == "[0, 0, -1]");
    CHECK(row_of("half of the influence, m; edge").fallback == "half of the influence");
}

TEST_CASE("a row of a help text lists words, of which the first is the default", "[base]") {
    const HelpRow rule = row_of(R"("simple", or "births", "eligible"; simple: one neighbour)");
    CHECK(rule.fallback == R"("simple")");
    CHECK(rule.range == R"(or "births", "eligible")");
    CHECK(rule.meaning == "simple: one neighbour");
}

TEST_CASE("a row that says no value has a meaning only, with all its words", "[base]") {
    for (const std::string text : {"accepted and ignored: of the grid of cpfg's program", "center, radius",
                                   "base, tip: centres of the end faces; radius", "m, one voxel: distance"}) {
        const HelpRow row = row_of(text);
        INFO(text << " -> " << row.fallback);
        CHECK(row.meaning == text);
        CHECK(row.fallback.empty());
    }
}

TEST_CASE("rows go on in lines that stand further in, and have rows of their own", "[base]") {
    const auto rows = parameters_of(
        "weights  {}; what counts,\n"
        "         and how much\n"
        "    near     0.5, 0 to 1; being near\n"
        "rings    5: rings of the sky, and `around`; so 40\n");
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].meaning == "what counts, and how much");
    CHECK(rows[1].name == "near");
    CHECK(rows[1].depth == 1);
    CHECK(rows[2].depth == 0);
    CHECK(rows[2].meaning == "rings of the sky, and `around`; so 40");
}

TEST_CASE("a help text has paragraphs, queries, headings and lines that stand by themselves", "[base]") {
    using Kind = HelpBlock::Kind;
    const auto blocks = read_help(
        "What it\ndoes:\n\n    F  -> F\n\n"
        "?name(s), ?name(s, n) -> n: neighbours\n"
        "                         that live\n"
        "?name(c)                 c > 0: a cell\n\n"
        "[[plant]]   one per plant\n"
        "key, other  1; what\n");
    REQUIRE(blocks.size() == 6);
    CHECK(blocks[0].text == "What it does:");
    CHECK(blocks[1].kind == Kind::verbatim);
    CHECK(blocks[1].text == "F  -> F\n");
    CHECK(blocks[2].kind == Kind::queries);
    CHECK(blocks[2].rows[0].name == "?name(s), ?name(s, n)");
    CHECK(blocks[2].rows[0].meaning == "n: neighbours that live");
    CHECK(blocks[2].rows[1].meaning == "c > 0: a cell");
    CHECK(blocks[3].kind == Kind::heading);
    CHECK(blocks[3].text == "[[plant]]");
    CHECK(blocks[4].text == "one per plant");
    CHECK(blocks[5].rows[0].name == "key, other");
}
