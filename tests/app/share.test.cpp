// A run as one page of HTML.
#include "app/program.h"
#include "catch.h"

#include <nlohmann/json.hpp>

#include <regex>

using Catch::Contains;
using Json = nlohmann::json;

namespace {

/// A plant that has grown for six steps, in the folder `run`.
class Recorded : public Workplace {
public:
    Recorded() {
        write("bush.l",
              "lsystem: bush\nderivation length: 6\naxiom: A(1)\nA(x) --> F(x)[+A(x/2)][-A(x/2)]\nendlsystem\n");
        REQUIRE(run("run bush.l --output run --quiet").code == 0);
    }

    Json recording_in(const std::string& file) const {
        const std::string page = text_of(path() / file), begin = "id=\"recording\">";
        const std::size_t at = page.find(begin) + begin.size();
        return Json::parse(page.substr(at, page.find("</script>", at) - at));
    }
};

std::size_t count(const std::string& text, const std::string& word) {
    std::size_t found = 0;
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++found;
    return found;
}

}  // namespace

TEST_CASE_METHOD(Recorded, "A shared page has all frames of a run, and nothing is loaded", "[app][share]") {
    const Outcome shared = run("share run --json");
    REQUIRE(shared.code == 0);
    CHECK(Json::parse(shared.out)["frames"] == 7);
    const std::string page = text_of(path() / "run/share.html");
    CHECK(page.size() == Json::parse(shared.out)["bytes"]);
    const Json recording = recording_in("run/share.html");
    CHECK(recording["steps"] == Json{0, 1, 2, 3, 4, 5, 6});
    CHECK(recording["together"] == 8);
    CHECK(recording["packets"].size() == 1);
    CHECK(recording["moments"].size() == 1);
    CHECK(recording["fields"].empty());
    CHECK(recording["organs"].get<std::string>().size() > 100);
    CHECK(count(page, "</script>") == 2);
    CHECK_THAT(page, Contains("default-src 'none'") && !Contains("<link") && !Contains("<script src"));
}

TEST_CASE_METHOD(Recorded, "A shared page has so many frames as one asks for, and its title is text", "[app][share]") {
    REQUIRE(run("share run --frames 3 --dark --title '</script><i>&' --output pages/bush.html").code == 0);
    const Json recording = recording_in("pages/bush.html");
    CHECK(recording["steps"] == Json{0, 3, 6});
    CHECK(recording["theme"] == "dark");
    CHECK(recording["title"] == "</script><i>&");
    CHECK_THAT(text_of(path() / "pages/bush.html"), Contains("<title>&lt;/script>&lt;i>&amp;</title>"));
    REQUIRE(run("share run --step 2 --output one.html").code == 0);
    CHECK(recording_in("one.html")["steps"] == Json{2});
}

TEST_CASE_METHOD(Recorded, "A shared page has the fields that the run recorded", "[app][share]") {
    write("wet.toml",
          "[[plant]]\nmodel = \"bush.l\"\n[environment.water]\nprocess = \"soil-water\"\nvoxel = 0.5\ninitial = 0.2\n"
          "domain = { lower = [-1, -2, -1], upper = [1, 0, 1] }\n[timeline]\nfields = [\"water\"]\n");
    REQUIRE(run("run wet.toml --steps 9 --output wet --quiet").code == 0);
    REQUIRE(run("share wet --output wet.html").code == 0);
    const Json fields = recording_in("wet.html")["fields"];
    REQUIRE(fields.size() == 1);
    CHECK(fields[0]["name"] == "water");
    CHECK(fields[0]["unit"] == "m3/m3");
    CHECK(fields[0]["texts"].size() == 2);  // of ten frames, eight in the first
}

TEST_CASE_METHOD(Recorded, "What cannot be shared is said", "[app][share]") {
    CHECK_THAT(run("share run --output page.pdf").err, Contains(".html"));
    CHECK_THAT(run("share bush.l").err, Contains("bush.l"));
    CHECK_THAT(run("share run --step 99").err, Contains("99"));
    CHECK(run("share none").code == 1);
}

TEST_CASE_METHOD(Recorded, "A page has as many frames as its size allows, and says so", "[app][share]") {
    const std::size_t whole = Json::parse(run("share run --json").out)["bytes"];
    const std::size_t one = Json::parse(run("share run --frames 1 --json").out)["bytes"];
    const std::size_t between = (whole + one) / 2;
    const Outcome less = run("share run --size " + std::to_string(between));
    CHECK_THAT(less.out, Contains(" of 7 frames"));
    CHECK(text_of(path() / "run/share.html").size() <= between);
    CHECK(recording_in("run/share.html")["steps"].size() < 7);
    CHECK(recording_in("run/share.html")["steps"].back() == 6);
    const Outcome none = run("share run --size 1K");
    CHECK(none.code == 1);
    CHECK_THAT(none.err, Contains("--size 1M") || Contains("--size 2M"));
}

TEST_CASE_METHOD(Recorded, "A page that grows is made of a model, of a scene and of a run", "[app][share]") {
    write("bush.toml", "[[plant]]\nmodel = \"bush.l\"\n");
    CHECK(Json::parse(run("share --live bush.l --json").out)["files"] == 1);
    CHECK(Json::parse(run("share --live bush.toml --output scene.html --json").out)["files"] == 2);
    CHECK_THAT(text_of(path() / "bush.html"), Contains("data-open=\"/library/bush.l\""));
    CHECK_THAT(text_of(path() / "scene.html"), Contains("data-open=\"/library/bush.toml\""));
    const Outcome of_run = run("share --live run");
    CHECK(of_run.code == 0);
    CHECK(of_run.err.empty());
    CHECK_THAT(text_of(path() / "run/share.html"), Contains("data-open=\"/library/bush.l\""));
}

TEST_CASE_METHOD(Recorded, "What a page that grows lacks is named", "[app][share]") {
    REQUIRE(run("run bush.l --steps 3 --output shorter --quiet").code == 0);
    CHECK_THAT(run("share --live shorter").err, Contains("without --steps 3"));
    write("rays.toml", "[[plant]]\nmodel = \"bush.l\"\n[environment.light]\nprocess = \"ray-light\"\n");
    CHECK_THAT(run("share --live rays.toml").err, Contains("'light' is ray-light, which needs the program"));
    const Outcome both = run("share --live bush.l --frames 3");
    CHECK(both.code != 0);
    CHECK_THAT(both.err, Contains("excludes"));
}
