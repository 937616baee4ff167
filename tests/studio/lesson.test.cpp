// Lessons: texts with a table, and whether their goals can be reached.
#include "studio/lesson/lesson.h"

#include "espalier/base/file.h"

#include "catch.h"
#include "studio/lesson/lesson_growth.h"
#include "studio/lesson/marked_text.h"
#include "temporary_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

const std::string model =
    "#define SIZE 2  /* length of a segment; 1..10 */\nlsystem: 1\nderivation length: 3\naxiom: A\nA --> F(SIZE) "
    "A\nendlsystem\n";
const std::string goal = "[[goal]]\ntext = \"Tall.\"\ncolumn = \"height\"\nat_least = 10\n";

/// A folder with a model, and lessons of it.
struct School : TemporaryFolder {
    School() { write_text(path() / "tree.l", model); }

    fs::path lesson(const std::string& table, const std::string& text = "# Hello\n") const {
        const fs::path file = path() / "lesson.md";
        write_text(file, "+++\ntitle = \"A tree\"\ngrow = \"tree.l\"\n" + table + "+++\n" + text);
        return file;
    }
    LessonOutcome tried(const std::string& table) const {
        return try_lesson(read_lesson(lesson(table)), path(), [](const Opened& opened) {
            Scene scene;
            scene.plants.push_back(plant_of_file(opened.path, {}));
            scene.steps = opened.steps;
            return scene;
        });
    }
};

}  // namespace

TEST_CASE_METHOD(School, "the text of a lesson becomes HTML below the heading of its page", "[studio][lesson]") {
    const Lesson lesson = read_lesson(this->lesson("seed = 4\n", "# One *two*\n\n- a\n- [b](https://example.org)\n"));
    CHECK(lesson.title == "A tree");
    CHECK(lesson.seed == 4);
    CHECK(lesson.texts == "locked");
    CHECK(lesson.grows == fs::absolute(path() / "tree.l").lexically_normal());
    CHECK(lesson.html ==
          "<h2>One <em>two</em></h2>\n<ul>\n<li>a</li>\n<li><a href=\"https://example.org\">b</a></li>\n</ul>\n");
}

TEST_CASE_METHOD(School, "no script and no element of HTML comes from a lesson, and each is named",
                 "[studio][lesson]") {
    const Lesson lesson =
        read_lesson(this->lesson("", "Hello\n\n<b>x</b> [y](javascript:alert(1))\n\n<script>z</script>\n"));
    CHECK(lesson.html.find("<b>") == std::string::npos);
    CHECK(lesson.html.find("script>") == std::string::npos);
    CHECK(lesson.html.find("javascript") == std::string::npos);
    REQUIRE(lesson.warnings.size() == 3);
    CHECK(lesson.warnings.front().place.line == 7);
    CHECK(lesson.warnings.back().place.line == 9);
}

TEST_CASE_METHOD(School, "a picture beside a lesson becomes part of it, others are refused", "[studio][lesson]") {
    const std::string png = "\x89PNG\r\n\x1a\n";
    write_text(path() / "a.png", png);
    write_text(path() / "b.txt", "no picture");
    const Lesson lesson = read_lesson(this->lesson("", "![seen](a.png)\n"));
    CHECK(lesson.html == "<p><img src=\"data:image/png;base64,iVBORw0KGgo=\" alt=\"seen\" /></p>\n");
    CHECK_THROWS_WITH(read_lesson(this->lesson("", "\n![](b.txt)\n")),
                      Catch::Contains("lesson.md:6") && Catch::Contains("neither PNG nor JPEG"));
    CHECK_THROWS_WITH(read_lesson(this->lesson("", "![](../a.png)\n")), Catch::Contains("does not lie beside"));
    CHECK_THROWS_WITH(read_lesson(this->lesson("", "![](https://example.org/a.png)\n")),
                      Catch::Contains("example.org"));
}

TEST_CASE_METHOD(School, "mistakes in the table of a lesson stand at their lines", "[studio][lesson]") {
    write_text(path() / "none.md", "# Only text\n");
    CHECK_THROWS_WITH(read_lesson(path() / "none.md"), Catch::Contains("none.md:1") && Catch::Contains("+++"));
    CHECK_THROWS_WITH(read_lesson(lesson("sead = 3\n")), Catch::Contains("lesson.md:4") && Catch::Contains("seed"));
    CHECK_THROWS_WITH(read_lesson(lesson("texts = \"open\"\n")), Catch::Contains("hidden"));
    CHECK_THROWS_WITH(read_lesson(lesson("[[goal]]\ntext = \"x\"\ncolumn = \"height\"\n")),
                      Catch::Contains("at_least"));
    CHECK_THROWS_WITH(read_lesson(lesson("[[question]]\ntext = \"x\"\nchoices = [\"a\", \"b\"]\nright = 3\n")),
                      Catch::Contains("lesson.md:7"));
    CHECK_THROWS_WITH(read_lesson(lesson("next = \"other.md\"\n")), Catch::Contains("other.md"));
}

TEST_CASE_METHOD(School, "a lesson is grown as it begins and with its answer", "[studio][lesson]") {
    const LessonOutcome outcome = tried(goal + "[answer]\nSIZE = 4\n");
    CHECK(outcome.at_first == std::vector<double>{6});
    CHECK(outcome.with_answer == std::vector<double>{12});
    REQUIRE(outcome.files.size() == 1);
    CHECK(outcome.files.begin()->second.bytes == model);
    CHECK(tried("steps = 4\n" + goal).at_first == std::vector<double>{8});
    CHECK(tried(goal).with_answer.empty());
}

TEST_CASE_METHOD(School, "a lesson that cannot be solved, or is solved at once, is refused", "[studio][lesson]") {
    CHECK_THROWS_WITH(tried(goal + "[answer]\nSIZE = 3\n"),
                      Catch::Contains("lesson.md:6") && Catch::Contains("is 9 then"));
    CHECK_THROWS_WITH(tried("steps = 7\n" + goal + "[answer]\nSIZE = 4\n"),
                      Catch::Contains("before anything was changed"));
    CHECK_THROWS_WITH(tried("sliders = [\"SIZES\"]\n"),
                      Catch::Contains("lesson.md:4") && Catch::Contains("did you mean 'SIZE'"));
    CHECK_THROWS_WITH(tried("[answer]\nSIZE = 40\n"), Catch::Contains("between 1 and 10"));
    CHECK_THROWS_WITH(tried("[[goal]]\ntext = \"x\"\ncolumn = \"hight\"\nat_least = 1\n"),
                      Catch::Contains("did you mean 'height'"));
    CHECK_THROWS_WITH(tried("[[goal]]\ntext = \"x\"\ncolumn = \"height\"\nplant = \"oak\"\nat_least = 1\n"),
                      Catch::Contains("no plant 'oak'"));
}

TEST_CASE_METHOD(School, "the page of a lesson reads what its text says", "[studio][lesson]") {
    const Lesson lesson = read_lesson(this->lesson("texts = \"free\"\nsliders = [\"SIZE\"]\nnext = \"lesson.md\"\n" +
                                                   goal + "at_most = 20\n[answer]\nSIZE = 4\n"));
    const auto json = nlohmann::json::parse(json_of_lesson(lesson));
    CHECK(json["texts"] == "free");
    CHECK(json["sliders"] == nlohmann::json::array({"SIZE"}));
    CHECK(json["next"] == "lesson.html");
    CHECK(json["goals"][0]["least"] == 10);
    CHECK(json["goals"][0]["most"] == 20);
    CHECK(json["answer"]["SIZE"] == "4");
}

}  // namespace espalier::studio
