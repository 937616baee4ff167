#include "espalier/language/model_settings.h"

#include "catch.h"
#include "reading.h"
#include "temporary_folder.h"

#include <cmath>

using namespace espalier;
using namespace espalier::test;
using Catch::Contains;

namespace {

const std::string header = R"(/* A crown. */
/* --- Crown --- */
#define WIDTH 6          /* width of the crown; 0.5..40; m */
#define GNARLY 0.25      /* how crooked branches are; 0..1 */
// --- Leaves ---
#define LEAVES (2 * 4)   // leaves of a node; 0..; leaves
#define DEPTH -3         /* below the ground; ..0; m */
#define INFLUENCE (D * (3 + 9 * (1 - GNARLY)))
#define D 0.5            /* length of an internode */
#define TWICE(x) (2 * x) /* a macro with arguments; 0..1 */
)";

ModelSettings settings(const Defines& defines = {}) {
    return ModelSettings::parse(header, "tree.l", {}, defines);
}

std::string refusal(const Defines& defines) {
    return messages(header + lsystem_of("", "F(WIDTH)", ""), {.defines = defines});
}

std::string refused_expression(const std::string& expression) {
    try {
        settings().value(expression);
    } catch (const UserError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("a #define whose comment has a range is a setting", "[language]") {
    const std::vector<ModelSetting> list = settings().list();
    REQUIRE(list.size() == 4);
    CHECK(list[0].name == "WIDTH");
    CHECK(list[0].text == "6");
    CHECK(list[0].value == 6);
    CHECK(list[0].summary == "width of the crown");
    CHECK(list[0].lowest == 0.5);
    CHECK(list[0].highest == 40);
    CHECK(list[0].unit == "m");
    CHECK(list[0].group == "Crown");
    CHECK(to_string(list[0].place) == "tree.l:3:1");
    CHECK(list[1].name == "GNARLY");
    CHECK(list[1].unit.empty());
    CHECK(list[1].range() == "0..1");
    CHECK(list[2].value == 8);
    CHECK(list[2].group == "Leaves");
    CHECK(std::isinf(list[2].highest));
    CHECK(list[2].range() == "0..");
    CHECK(list[2].what_is_allowed() == "a number of at least 0 leaves");
    CHECK(list[3].range() == "..0");
    CHECK(list[3].what_is_allowed() == "a number of at most 0 m");
}

TEST_CASE("settings are read where conditions hold, from included files too, and the last definition counts",
          "[language]") {
    TemporaryFolder folder;
    folder.write("crown.h", "/* --- Crown --- */\n#define WIDTH 6 /* width; 1..9; m */\n");
    const auto model = folder.write("tree.l",
                                    "/* --- All --- */\n#include \"crown.h\"\n"
                                    "#define N 2 /* number; 1..3 */\n#undef N\n#define N 5 /* number; 4..6 */\n"
                                    "#ifdef SMALL\n#define HEIGHT 3 /* height; 0..9; m */\n#endif\n");
    const std::vector<ModelSetting> list = ModelSettings::read(model).list();
    REQUIRE(list.size() == 2);
    CHECK(list[0].name == "WIDTH");
    CHECK(list[0].group == "Crown");
    CHECK(list[0].place.file == (folder.path() / "crown.h").string());
    CHECK(list[1].value == 5);
    CHECK(list[1].lowest == 4);
    CHECK(ModelSettings::read(model, {{"SMALL", ""}}).list().size() == 3);
}

TEST_CASE("the summary of a setting may have semicolons, and a range may be one of whole numbers", "[language]") {
    const std::vector<ModelSetting> list =
        ModelSettings::parse(
            "#define A 0 /* 0: straight; 1: winding; 0..1 */\n#define B 2 // years; from sowing; 1..9 whole; a\n",
            "m.l")
            .list();
    REQUIRE(list.size() == 2);
    CHECK(list[0].summary == "0: straight; 1: winding");
    CHECK(list[0].unit.empty());
    CHECK_FALSE(list[0].whole);
    CHECK(list[1].summary == "years; from sowing");
    CHECK(list[1].unit == "a");
    CHECK(list[1].what_is_allowed() == "a whole number between 1 and 9 a");
    CHECK(list[1].range() == "1..9 whole");
    CHECK(list[1].allows(3));
    CHECK_FALSE(list[1].allows(3.5));
}

TEST_CASE("a define replaces a setting's value, and must be a number of its range", "[language]") {
    CHECK(settings({{"WIDTH", "7"}}).list()[0].value == 7);
    CHECK(refusal({{"WIDTH", "40"}}).empty());
    CHECK(refusal({{"WIDTH", "40 / 2"}}).empty());
    const std::string allowed = "the setting 'WIDTH' (width of the crown) must be a number between 0.5 and 40 m, not ";
    CHECK(refusal({{"WIDTH", "41"}}) == "3:1: " + allowed + "41");
    CHECK(refusal({{"WIDTH", "wide"}}) == "3:1: " + allowed + "wide");
    CHECK(refusal({{"WIDTH", "1 / 0"}}) == "3:1: " + allowed + "1 / 0");
    CHECK(refusal({{"D", "wide"}}).empty());  // no setting, because its comment has no range
    CHECK_THROWS_AS(settings({{"WIDTH", "41"}}), UserError);
}

TEST_CASE("a default outside its range is a mistake of the model", "[language]") {
    CHECK_THAT(messages("#define N 4 /* number; 1..3 */\n" + lsystem_of("", "F(N)", "")),
               Contains("the setting 'N' (number) must be a number between 1 and 3, not 4"));
}

TEST_CASE("comments without a range document nothing", "[language]") {
    for (const char* comment : {"/* 0..1 */", "/* width; m */", "/* width; ..; m */", "/* width; a..b */", "/* ; */",
                                "// see 1..2; m", "", "/* width */ // 0..1"}) {
        INFO(comment);
        CHECK(ModelSettings::parse("#define N 4 " + std::string(comment) + "\n", "n.l").list().empty());
    }
}

TEST_CASE("expressions are read with all definitions of the model", "[language]") {
    CHECK(settings().value("INFLUENCE") == 0.5 * (3 + 9 * 0.75));
    CHECK(settings({{"GNARLY", "1"}}).value("INFLUENCE") == 1.5);
    CHECK(settings().value("TWICE(WIDTH) + DEPTH^2") == 21);
    CHECK(settings().value("LEAVES > 0") == 1);
    CHECK(settings().value("floor(WIDTH / 4) + sqrt(4) + pi") == Approx(3 + std::acos(-1)));
    CHECK_THAT(refused_expression("INFLUENC * 2"), Contains("'INFLUENC'") && Contains("did you mean 'INFLUENCE'?"));
    CHECK_THAT(refused_expression("WIDTH / (D - 0.5)"), Contains("no finite value"));
    CHECK_THAT(refused_expression("ran(1)"), Contains("no finite value"));
    CHECK_THAT(refused_expression("WIDTH WIDTH"), Contains("expected the end of the expression"));
    CHECK_THAT(refused_expression("WIDTH +"), Contains("expected"));
    CHECK_THAT(refused_expression(""), Contains("expected"));
    CHECK_THAT(refused_expression("WIDTH = 2"), Contains("assigned"));
}

TEST_CASE("an expression knows the settings that it reads, also through other definitions", "[language]") {
    using Names = std::vector<std::string>;
    CHECK(settings().read_by("2 * WIDTH + WIDTH + INFLUENCE") == Names{"WIDTH", "GNARLY"});
    CHECK(settings().read_by("TWICE(DEPTH) + WIDTHS").size() == 1);
    CHECK(settings().read_by("D + 1").empty());
    const auto loop = ModelSettings::parse("#define A B /* a; 0.. */\n#undef A\n#define B C\n#define C B\n", "m.l");
    CHECK(loop.read_by("B").empty());
}

TEST_CASE("a model with mistakes of the preprocessor has no settings", "[language]") {
    CHECK_THROWS_AS(ModelSettings::parse("#if 1\n", "n.l"), UserError);
    CHECK_THROWS_AS(ModelSettings::parse("#define N 1\n", "n.l", {}, {{"M", "2"}}), UserError);
    CHECK_THROWS_AS(ModelSettings::read("nowhere.l"), UserError);
}
