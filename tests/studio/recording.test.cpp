// A recorded run in the studio: watched without being grown, and edited as what it grew from.
#include "session_fixture.h"

using namespace studio_test;

namespace {

const char* const recorded_tree = R"(#define LENGTH 2
lsystem: 1
derivation length: 4
axiom: !(0.1) A(1)
A(n) --> F(LENGTH) [ +(30) A(n+1) ] [ -(30) A(n+1) ] ;(3) { . f(1) . +(90) f(1) . }
endlsystem
)";

/// A studio with a run of the tree, five steps of six, every second recorded.
struct OpenRun : OpenStudio {
    OpenRun() : OpenStudio(recorded_tree) {
        folder.write("scene.toml",
                     "[[plant]]\nmodel = \"plant.l\"\n[timeline]\nevery = 2\nparameters = { length = \"F.1\" }\n");
        record(folder.path() / "scene.toml", 5, folder.path() / "run");
        options.opened.path = folder.path() / "run";
    }
};

}  // namespace

TEST_CASE("a recorded run is watched step by step, with its statistics, and nothing grows", "[studio]") {
    OpenRun studio;
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    CHECK(page.last("document")["kind"] == "run");
    CHECK(page.last("growth")["step"] == 5);
    CHECK(page.last("growth")["derived"] == 0);
    CHECK(page.last("growth")["plants"] == Json({"plant"}));
    CHECK(page.last("statistics")["rows"].size() == 6);
    CHECK(page.last("statistics")["columns"][0] == "step");
    const auto shown = [&](int step) {
        page.packets.clear();
        studio.ask({{"do", "look"}, {"step", step}});
        studio.wait([&] { return !page.packets.empty(); });
        CHECK(number_at<std::int32_t>(page.packets.back(), 8) == step);
        return internodes(page.packets.back());
    };
    CHECK(shown(0) == 0);
    CHECK(shown(2) == 3);
    CHECK(shown(3) == 3);  // the frame before
    CHECK(shown(4) == 15);
    CHECK(number_at<std::uint32_t>(page.packets.back(), 20) == 15 * 3);  // a triangle at every internode
}

TEST_CASE("modules of a recorded run tell who they are, and colour the picture", "[studio]") {
    OpenRun studio;
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    studio.ask({{"do", "look"}, {"step", 4}});
    studio.wait([&] { return number_at<std::int32_t>(page.packets.back(), 8) == 4; });
    const std::string packet = page.packets.back();
    const auto module = number_at<std::uint32_t>(packet, 60 + 4 + 24 * 14 + 20);  // module of the last internode
    const Json growth = page.last("growth")["growth"];
    const Json known = studio.ask({{"do", "pick"}, {"growth", growth}, {"step", 4}, {"module", module}});
    CHECK(known["symbol"] == "F");
    CHECK(known["plant"] == "plant");
    CHECK(known["born"] == 4);
    CHECK(known["order"] == 3);
    CHECK(known["history"]["steps"] == Json({4}));
    CHECK(known["identity"].get<std::string>().size() == 16);
    CHECK(studio.ask({{"do", "pick"}, {"growth", growth}, {"step", 4}, {"module", 100000}}).contains("error"));

    CHECK(page.last("columns")["columns"][0] == "age");
    studio.ask({{"do", "column"}, {"growth", growth}, {"step", 4}, {"name", "age"}});
    const std::string column = page.packets.back();
    CHECK(column.substr(0, 4) == "ESC1");
    const auto modules = number_at<std::uint32_t>(column, 12);
    CHECK(module < modules);
    CHECK(number_at<float>(column, 16) == 0);
    CHECK(number_at<float>(column, 20) == 3);
    CHECK(studio.ask({{"do", "column"}, {"growth", growth}, {"step", 4}, {"name", "colour"}}).contains("error"));
}

TEST_CASE("limbs of a recorded run are where those of its growth are", "[studio]") {
    const auto positions = [](OpenStudio& studio) {
        ListeningPage& page = studio.begin();
        studio.wait_until_grown();
        studio.ask({{"do", "look"}, {"step", 4}});
        studio.wait([&] { return number_at<std::int32_t>(page.packets.back(), 8) == 4; });
        const Json growth = page.last("growth")["growth"];
        studio.ask({{"do", "limbs"}, {"growth", growth}, {"step", 4}, {"skin", "tubes"}});
        studio.wait([&] { return page.packets.back().substr(0, 4) == "ESM1"; });
        const std::string& limbs = page.packets.back();
        CHECK(number_at<std::int32_t>(limbs, 8) == 4);
        const std::size_t vertices = number_at<std::uint32_t>(limbs, 16), ranges = number_at<std::uint32_t>(limbs, 24);
        CHECK(vertices > 15 * 12);
        return limbs.substr(28 + 12 * ranges, 12 * vertices);
    };
    OpenRun recorded;
    OpenStudio grown(recorded_tree);
    CHECK(positions(recorded) == positions(grown));
}

TEST_CASE("to change a recorded run is to grow what it grew from, and undo goes back to it", "[studio]") {
    OpenRun studio;
    studio.folder.write("plant.l", std::string("/* has changed since */\n") + recorded_tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    // The texts are those of the run.
    const Json texts = page.last("document")["texts"];
    REQUIRE(texts.size() == 2);
    CHECK(texts[0]["role"] == "main");
    CHECK(texts[1]["content"] == recorded_tree);
    CHECK(texts[1]["changed"] == true);
    CHECK(page.last("document")["settings"][0]["name"] == "timeline.every");

    studio.change({{"settings", {{"plant.l:LENGTH", "3"}}}, {"label", "LENGTH 3"}});
    studio.wait_until_grown();
    CHECK(page.last("document")["kind"] == "scene");
    CHECK(page.last("growth")["step"] == 5);
    CHECK(internodes(page.packets.back()) == 31);
    studio.ask({{"do", "undo"}});
    studio.wait_until_grown();
    CHECK(page.last("document")["kind"] == "run");
    studio.ask({{"do", "grow"}, {"to", 6}});
    studio.wait_until_grown();
    CHECK(page.last("growth")["step"] == 6);
    CHECK(internodes(page.packets.back()) == 63);
}

TEST_CASE("a run whose model has gone is edited as it was recorded", "[studio]") {
    OpenRun studio;
    std::filesystem::remove(studio.folder.path() / "scene.toml");
    std::filesystem::remove(studio.folder.path() / "plant.l");
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    studio.change({{"steps", 3}});
    studio.wait_until_grown();
    CHECK(page.last("growth")["step"] == 3);
    CHECK(internodes(page.packets.back()) == 7);
}

TEST_CASE("a run that does not tell what it grew from can be watched, but not edited", "[studio]") {
    OpenRun studio;
    const std::filesystem::path file = studio.folder.path() / "run/run.json";
    Json json = Json::parse(text_of(file));
    json.erase("command");
    studio.folder.write("run/run.json", json.dump());
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    CHECK(page.last("document")["texts"].empty());
    CHECK(page.last("problems")["problems"].size() == 1);
    CHECK(studio.change({{"steps", 3}})["error"] == "the run does not tell what it grew from: it can only be watched");
    CHECK(internodes(page.packets.back()) > 0);

    studio.ask({{"do", "export"}, {"format", "csv"}});
    studio.wait([&] { return !page.last("exported").is_null(); });
    CHECK(page.last("exported")["files"].size() > 0);
}

TEST_CASE("a run that is damaged says so", "[studio]") {
    OpenRun studio;
    std::filesystem::remove(studio.folder.path() / "run/plants.pvd");
    ListeningPage& page = studio.begin();
    studio.wait([&] { return !page.last("problems").is_null() && !page.last("problems")["problems"].empty(); });
    CHECK(page.last("growth").is_null());
}
