// A text that teaches as one page of HTML.
#include "app/program.h"
#include "catch.h"

#include <nlohmann/json.hpp>

#include <algorithm>

using Catch::Contains;
using Json = nlohmann::json;

namespace {

namespace fs = std::filesystem;

class Class : public Workplace {
public:
    Class() {
        write("stem.l",
              "#define SIZE 2  /* of a segment; 1..10 */\nlsystem: 1\nderivation length: 3\naxiom: A\n"
              "A --> F(SIZE) A\nendlsystem\n");
        write("stem.md",
              "+++\ntitle = \"A <stem>\"\ngrow = \"stem.l\"\nsteps = 4\n[[goal]]\ntext = \"Tall.\"\n"
              "column = \"height\"\nat_least = 10\n[answer]\nSIZE = 3\n+++\n# </script> grows\n");
    }
};

}  // namespace

TEST_CASE_METHOD(Class, "A lesson becomes a page that grows its model", "[app][lesson]") {
    const Outcome made = run("lesson stem.md");
    CHECK(made.code == 0);
    CHECK_THAT(made.out, Contains("Tall.: 8 at first, with the answer 12; at least 10 is asked for"));
    const std::string page = text_of(path() / "stem.html");
    CHECK_THAT(page, Contains("data-open=\"/library/stem.l\" data-steps=\"4\""));
    CHECK_THAT(page, Contains("<title>A &lt;stem></title>"));
    const std::string begin = "id=\"lesson\">";
    const std::size_t at = page.find(begin) + begin.size();
    const Json lesson = Json::parse(page.substr(at, page.find("</script>", at) - at));
    CHECK(lesson["title"] == "A <stem>");
    CHECK(lesson["answer"]["SIZE"] == "3");
}

TEST_CASE_METHOD(Class, "What a lesson consists of is printed for pages of one's own", "[app][lesson]") {
    const Outcome printed = run("lesson stem.md --data");
    const Json data = Json::parse(printed.out);
    CHECK(data["open"] == (fs::canonical(path()) / "stem.l").string());
    CHECK(data["steps"] == 4);
    CHECK(data["lesson"]["goals"].size() == 1);
    CHECK_FALSE(fs::exists(path() / "stem.html"));
}

TEST_CASE_METHOD(Class, "What no page can grow is no lesson", "[app][lesson]") {
    write("rays.toml", "[[plant]]\nmodel = \"stem.l\"\n[environment.light]\nprocess = \"ray-light\"\n");
    write("rays.md", "+++\ntitle = \"Rays\"\ngrow = \"rays.toml\"\n+++\n");
    const Outcome refused = run("lesson rays.md");
    CHECK(refused.code == 1);
    CHECK_THAT(refused.err, Contains("'light' is ray-light, which a page cannot grow"));
    CHECK_FALSE(fs::exists(path() / "rays.html"));
}

TEST_CASE_METHOD(Class, "Every lesson of the manual can be solved, and names the one that follows", "[app][lesson]") {
    const fs::path folder = fs::path(ESPALIER_SOURCE_DIR) / "lessons";
    std::vector<fs::path> lessons;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == ".md") lessons.push_back(entry.path());
    }
    std::sort(lessons.begin(), lessons.end());
    REQUIRE(lessons.size() == 10);
    for (std::size_t i = 0; i < lessons.size(); ++i) {
        INFO(lessons[i]);
        const Outcome data = run("lesson '" + lessons[i].string() + "' --data");
        CHECK(data.err.empty());
        REQUIRE(data.code == 0);
        const Json lesson = Json::parse(data.out)["lesson"];
        const std::string next = i + 1 < lessons.size() ? lessons[i + 1].stem().string() + ".html" : "";
        CHECK(lesson["next"] == next);
        CHECK(lesson["goals"].empty() == lesson["answer"].empty());
        CHECK(lesson["goals"].size() + lesson["questions"].size() > 0);
    }
}
