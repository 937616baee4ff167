// The requests of docs/developer/studio-protocol.md as a page makes them.
#include "base/base64.h"
#include "session_fixture.h"

#include <algorithm>
#include <chrono>

using namespace studio_test;
namespace fs = std::filesystem;

namespace {

const char* const tree = R"(#define ANGLE 30  /* between branches; 0..90; degrees */
#define LENGTH 2
lsystem: 1
derivation length: 4
axiom: A(1)
A(n) --> F(LENGTH) [ +(ANGLE) A(n+1) ] [ -(ANGLE) A(n+1) ]
endlsystem
)";

const char* const random_tree = R"(lsystem: 1
seed: 5
derivation length: 3
axiom: A
A --> F(1) A : 0.5
A --> F(2) A : 0.5
endlsystem
)";

// The height of the box of all internodes.
float height(const std::string& packet) {
    return number_at<float>(packet, 48) - number_at<float>(packet, 36);
}

}  // namespace

TEST_CASE("what is open grows at once, and its last step is sent", "[studio]") {
    OpenStudio studio(tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    CHECK(page.last("growth")["step"] == 4);
    REQUIRE(!page.packets.empty());
    CHECK(page.packets.back().substr(0, 4) == "ESP1");
    CHECK(internodes(page.packets.back()) == 15);  // 2^4 - 1
    CHECK(page.last("statistics")["columns"][0] == "step");
    CHECK(page.last("statistics")["units"]["volume"] == "m3");
}

TEST_CASE("a page that says hello late is told everything", "[studio]") {
    OpenStudio studio(tree);
    studio.begin();
    studio.wait_until_grown();
    ListeningPage second;
    studio.session->join(second);
    studio.session->receive(second, R"({"do": "hello", "id": 1})");
    CHECK(second.last("document")["name"] == "plant.l");
    CHECK(second.last("growth")["state"] == "done");
    CHECK(second.last("statistics")["rows"].size() == 5);
    CHECK(second.packets.size() == 1);
    studio.session->leave(second);
}

TEST_CASE("settings are the numbers of the text, and a slider changes the text", "[studio]") {
    OpenStudio studio(tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    const Json settings = page.last("document")["settings"];
    REQUIRE(settings.size() == 2);
    CHECK(settings[0]["name"] == "ANGLE");
    CHECK(settings[0]["label"] == "angle: between branches");
    CHECK(settings[0]["highest"] == 90);
    CHECK(settings[0]["unit"] == "degrees");
    CHECK(settings[1]["name"] == "LENGTH");
    CHECK(settings[1]["highest"].is_null());

    const float before = height(page.packets.back());
    CHECK_FALSE(studio.change({{"settings", {{"LENGTH", "4"}}}}).contains("error"));
    studio.wait_until_grown();
    CHECK(height(page.packets.back()) == Approx(2 * before));
    const std::string text = page.last("document")["texts"][0]["content"];
    CHECK(text.find("#define LENGTH 4\n") != std::string::npos);
    CHECK(page.last("document")["settings"][1]["changed"] == true);
    CHECK(text_of(studio.file) == tree);  // nothing is saved unasked

    CHECK(studio.change({{"settings", {{"ANGLE", "100"}}}})["error"] == "ANGLE lies between 0 and 90");
    studio.change({{"settings", {{"LENGTH", nullptr}}}});
    CHECK(page.last("document")["texts"][0]["content"] == tree);
}

TEST_CASE("a mistake is told with its place, and the plant stays until it is mended", "[studio]") {
    OpenStudio studio(tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    const std::size_t packets = page.packets.size();
    std::string broken = tree;
    broken.replace(broken.find("+(ANGLE)"), 8, "+(ANGEL");
    studio.change({{"texts", {{studio.file.string(), broken}}}});
    studio.wait([&] { return !page.last("problems")["problems"].empty(); });
    const Json problem = page.last("problems")["problems"][0];
    CHECK(problem["severity"] == "error");
    CHECK(problem["file"] == studio.file.string());
    CHECK(problem["line"] == 6);
    CHECK(page.packets.size() == packets);

    studio.change({{"texts", {{studio.file.string(), tree}}}});
    studio.wait_until_grown();
    CHECK(page.last("problems")["problems"].empty());
}

TEST_CASE("undo takes back the seed, the steps and the text; drags are one change", "[studio]") {
    OpenStudio studio(random_tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    studio.change({{"seed", 7}, {"label", "seed 7"}});
    CHECK(page.last("document")["seed"] == 7);
    CHECK(page.last("document")["undo"] == "seed 7");
    for (const int steps : {4, 5, 6}) studio.change({{"steps", steps}, {"label", "steps"}}, true);
    studio.change({{"steps", 8}, {"label", "steps 8"}});
    studio.wait_until_grown();
    CHECK(page.last("growth")["step"] == 8);

    studio.ask({{"do", "undo"}});
    CHECK(page.last("document")["redo"] == "steps 8");
    studio.wait_until_grown();
    CHECK(page.last("growth")["step"] == 3);
    CHECK(page.last("document")["seed"] == 7);
    studio.ask({{"do", "undo"}});
    CHECK(page.last("document")["seed"] != 7);
    CHECK(page.last("document")["undo"].is_null());  // nothing was open before
    studio.ask({{"do", "redo"}});
    CHECK(page.last("document")["seed"] == 7);
}

TEST_CASE("a module tells who it is, who bore it and which production made it", "[studio]") {
    OpenStudio studio(tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    const Json growth = page.last("growth");
    const std::string& packet = page.packets.back();
    // The module of the last internode: behind 60 bytes of header and one plant, 24 bytes an internode.
    const auto module = number_at<std::uint32_t>(packet, 60 + 4 + 24 * (internodes(packet) - 1) + 20);
    const Json known = studio.ask({{"do", "pick"}, {"growth", growth["growth"]}, {"step", 4}, {"module", module}});
    CHECK(known["text"] == "F(2)");
    CHECK(known["born"] == 4);
    CHECK(known["parent"]["text"] == "A(4)");
    CHECK(known["parent"]["born"] == 3);
    CHECK(known["history"]["steps"] == Json({4}));
    REQUIRE(known["places"].size() == 1);
    CHECK(known["places"][0]["line"] == 6);
    CHECK(
        studio.ask({{"do", "pick"}, {"growth", growth["growth"]}, {"step", 4}, {"module", 100000}}).contains("error"));
}

namespace {

std::string breathing_scene(const std::string& dt) {
    return "[simulation]\nsteps = 20\ndt = " + dt + R"(
time_unit = "day"
[[plant]]
model = "leaf.l"
[environment.light]
process = "canopy-light"
voxel = 0.5
sky = { par = 900, diffuse = 0.5, sun = [0, 1, 0] }
[environment.leaves]
process = "leaf-exchange"
light = "light"
[[keyframes]]
key = "environment.leaves.temperature"
times = [0, 0.5, 1, 1.5, 2]
values = [10, 30, 10, 20, 10]
[timeline]
organs = ["leaves.temperature"]
)";
}

const char* const one_leaf_on_a_stem = R"(lsystem: 1
derivation length: 20
axiom: F(1)L
L --> L
homomorphism
L --> { . +(60) f(0.1) . -(120) f(0.1) . }
endlsystem
)";

}  // namespace

TEST_CASE("a leaf tells the course of the day of the step", "[studio]") {
    OpenStudio studio(breathing_scene("0.125"), "scene.toml");
    studio.folder.write("leaf.l", one_leaf_on_a_stem);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    const Json growth = page.last("growth")["growth"];
    const auto day_of = [&](int step) {
        return studio.ask({{"do", "pick"}, {"growth", growth}, {"step", step}, {"module", 1}})["day"];
    };
    const Json first = day_of(3), second = day_of(12);
    CHECK(first["steps"] == Json({1, 2, 3, 4, 5, 6, 7, 8}));
    CHECK(first["hours"] == Json({3, 6, 9, 12, 15, 18, 21, 24}));
    CHECK(second["steps"] == Json({9, 10, 11, 12, 13, 14, 15, 16}));
    CHECK(second["hours"] == first["hours"]);
    CHECK(day_of(20)["steps"] == Json({17, 18, 19, 20}));
    CHECK(day_of(0)["steps"] == first["steps"]);
    REQUIRE(first["names"] == Json({"light.absorbed", "leaves.assimilation", "leaves.temperature"}));
    CHECK(first["units"][2] == "degC");
    // At noon of the first day the air has 30 degrees, of the second 20, and at midnight 10.
    const auto temperature = [](const Json& day, int at) { return day["values"][2][at].get<double>(); };
    CHECK(temperature(first, 3) > temperature(first, 7) + 12);
    CHECK(temperature(first, 3) > temperature(second, 3) + 6);
    studio.ask({{"do", "column"}, {"growth", growth}, {"step", 4}, {"name", "leaves.temperature"}});
    const std::string& bytes = page.packets.back();
    CHECK(number_at<float>(bytes, bytes.size() - 4) == temperature(first, 3));
    // A stem has light, and no gas exchange.
    CHECK(studio.ask({{"do", "pick"}, {"growth", growth}, {"step", 3}, {"module", 0}})["day"]["names"] ==
          Json({"light.absorbed"}));
}

TEST_CASE("a day of few steps has no course", "[studio]") {
    OpenStudio studio(breathing_scene("1"), "scene.toml");
    studio.folder.write("leaf.l", one_leaf_on_a_stem);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    const Json known =
        studio.ask({{"do", "pick"}, {"growth", page.last("growth")["growth"]}, {"step", 3}, {"module", 1}});
    CHECK(known["symbol"] == "L");
    CHECK_FALSE(known.contains("day"));
}

TEST_CASE("modules can be coloured by their age", "[studio]") {
    OpenStudio studio(tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    CHECK(page.last("columns")["columns"] == Json({"age", "plant", "symbol", "parameter 1"}));
    studio.ask({{"do", "column"}, {"growth", page.last("growth")["growth"]}, {"step", 4}, {"name", "age"}});
    const std::string& bytes = page.packets.back();
    REQUIRE(bytes.substr(0, 4) == "ESC1");
    const auto modules = number_at<std::uint32_t>(bytes, 12);
    CHECK(modules == page.last("growth")["modules"]);
    CHECK(number_at<float>(bytes, 16) == 0);
    CHECK(number_at<float>(bytes, 20) == 4);  // the first apex keeps the identity of the axiom
    CHECK(bytes.size() == 24 + 4 + 4 + 4 * modules);
}

TEST_CASE("modules are coloured by the names that the scene gives to their parameters", "[studio]") {
    OpenStudio studio("[[plant]]\nmodel = \"plant.l\"\n[timeline]\nparameters = { generation = \"A.1\" }\n",
                      "scene.toml");
    studio.folder.write("plant.l", tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    CHECK(page.last("columns")["columns"] == Json({"generation", "age", "plant", "symbol", "parameter 1"}));
    studio.ask({{"do", "column"}, {"growth", page.last("growth")["growth"]}, {"step", 4}, {"name", "generation"}});
    const std::string& bytes = page.packets.back();
    REQUIRE(bytes.substr(0, 4) == "ESC1");
    // Only apices have one, and all are of the fifth generation; F(LENGTH) has another parameter.
    CHECK(number_at<float>(bytes, 16) == 5);
    CHECK(number_at<float>(bytes, 20) == 5);
}

TEST_CASE("the same step is shown again after an edit, and none is grown twice", "[studio]") {
    OpenStudio studio(tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    studio.ask({{"do", "look"}, {"step", 2}});
    CHECK(internodes(page.packets.back()) == 3);
    const std::size_t packets = page.packets.size();
    studio.ask({{"do", "look"}, {"step", 2}, {"held", page.last("growth")["growth"]}});
    CHECK(page.packets.size() == packets);
    studio.change({{"settings", {{"LENGTH", "3"}}}});
    studio.wait_until_grown();
    REQUIRE(page.packets.size() == packets + 1);
    CHECK(internodes(page.packets.back()) == 3);
}

TEST_CASE("growing on does not grow again what is there, unless the model asks how far it is to grow", "[studio]") {
    for (const bool asks : {false, true}) {
        std::string model = tree;
        if (asks) model.replace(model.find("F(LENGTH)"), 9, "F(LENGTH * (1 + Z))");
        OpenStudio studio(model);
        ListeningPage& page = studio.begin();
        studio.wait_until_grown();
        const Json before = page.last("growth")["growth"];
        studio.ask({{"do", "grow"}, {"to", 6}});
        studio.wait_until_grown();
        CHECK(page.last("growth")["step"] == 6);
        CHECK((page.last("growth")["growth"] == before) == !asks);
        CHECK(internodes(page.packets.back()) == 63);
        CHECK(page.last("statistics")["rows"].back()[0] == 6);
        studio.ask({{"do", "undo"}});
        studio.wait_until_grown();
        CHECK(page.last("growth")["step"] == 4);
    }
}

TEST_CASE("a change of looks derives nothing, and draws first what pages look at", "[studio]") {
    OpenStudio studio(tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    CHECK(page.last("growth")["derived"] == 5);
    studio.ask({{"do", "look"}, {"step", 2}});
    page.packets.clear();
    studio.change({{"settings", {{"ANGLE", "45"}}}});
    studio.wait_until_grown();
    CHECK(page.last("growth")["derived"] == 0);
    CHECK(page.last("growth")["step"] == 4);
    REQUIRE(page.packets.size() == 1);
    CHECK(internodes(page.packets.back()) == 3);
    // Any other step follows as well, drawn for that or meanwhile.
    for (const int step : {4, 0, 3, 1}) {
        page.packets.clear();
        studio.ask({{"do", "frame"}, {"growth", page.last("growth")["growth"]}, {"step", step}});
        studio.wait([&] { return !page.packets.empty(); });
        CHECK(internodes(page.packets.back()) == (1u << step) - 1);
    }
    studio.wait([&] { return !page.last("statistics").is_null() && page.last("statistics")["rows"].back()[0] == 4; });
}

TEST_CASE("growth can be stopped", "[studio]") {
    OpenStudio studio(random_tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    studio.ask({{"do", "grow"}, {"to", 1000000}});
    studio.wait([&] { return page.last("growth")["step"] > 4; });
    studio.ask({{"do", "stop"}});
    studio.wait([&] { return page.last("growth")["state"] == "stopped"; });
    CHECK(page.last("growth")["step"] < 1000000);
    CHECK(page.last("document")["undo"] == "grow to step 1000000");
}

TEST_CASE("growth can be stopped in the midst of a step, and goes on when it is asked to", "[studio][stop]") {
    const std::string loop = "F : {i = 0; while (Q == 3 && i < 9e7) {i = i + LENGTH;}} 1 --> F F\nendlsystem\n";
    const std::string begin = "#define LENGTH 1\nlsystem: 1\nderivation length: 5\naxiom: " + std::string(500, 'F');
    const std::string light = "environment p;\n" + begin + "?p(1)\n" + loop;
    for (const bool is_lit : {false, true}) {
        OpenStudio studio(is_lit ? light : begin + "\n" + loop);
        if (is_lit) {
            studio.options.opened.path = studio.folder.write(
                "lit.toml", "[[plant]]\nmodel = \"plant.l\"\n[environment.p]\nprocess = \"voxel-shade\"\n");
        }
        ListeningPage& page = studio.begin();
        const auto begun = std::chrono::steady_clock::now();
        studio.wait([&] { return std::chrono::steady_clock::now() - begun > std::chrono::seconds(1); });
        const auto asked = std::chrono::steady_clock::now();
        studio.ask({{"do", "stop"}});
        studio.wait([&] { return page.last("growth")["state"] == "stopped"; });
        CHECK(std::chrono::steady_clock::now() - asked < std::chrono::seconds(5));
        CHECK(page.last("growth")["step"] == 2);
        // An earlier step can still be shown, and a change grows anew.
        page.packets.clear();
        studio.ask({{"do", "frame"}, {"growth", page.last("growth")["growth"]}, {"step", 1}});
        studio.wait([&] { return !page.packets.empty(); });
        if (is_lit) continue;  // a scene has no settings of its model
        CHECK_FALSE(studio.change({{"settings", {{"LENGTH", "100000000"}}}}).contains("error"));
        studio.wait([&] { return page.last("growth")["step"] == 5; });
    }
}

TEST_CASE("a growth asks before it passes five million modules, and once for a document", "[studio][stop]") {
    OpenStudio studio("#define STEPS 23\nlsystem: 1\nderivation length: STEPS\naxiom: A\nA --> AA\nendlsystem\n");
    ListeningPage& page = studio.begin();
    const auto is = [&](const std::string& state) {
        const Json growth = page.last("growth");
        return !growth.is_null() && growth["state"] == state;
    };
    studio.wait([&] { return is("asks"); });
    CHECK(page.last("growth")["step"] == 22);
    CHECK(page.last("growth")["modules"] == 1 << 22);
    CHECK(page.last("growth")["reason"] == "step 23 may have 8388608 modules");
    SECTION("told to go on, it does, and a later growth need not ask") {
        studio.ask({{"do", "go-on"}});
        studio.wait([&] { return is("done"); });
        CHECK(page.last("growth")["modules"] == 1 << 23);
        CHECK(studio.ask({{"do", "go-on"}}).contains("error"));
        page.texts.clear();
        studio.change({{"seed", 5}});
        studio.wait_until_grown();
        CHECK(std::none_of(page.texts.begin(), page.texts.end(),
                           [](const Json& text) { return text.value("state", "") == "asks"; }));
    }
    SECTION("told to stop, it stops, and to grow on is an answer, too") {
        studio.ask({{"do", "stop"}});
        CHECK(is("stopped"));
        CHECK(page.last("growth")["reason"] == "");
        studio.ask({{"do", "grow"}, {"to", 23}});
        studio.wait([&] { return page.last("growth")["step"] == 23; });
    }
    SECTION("a change ends it") {
        studio.change({{"settings", {{"STEPS", "3"}}}});
        studio.wait_until_grown();
        CHECK(page.last("growth")["modules"] == 8);
    }
}

TEST_CASE("a plant that stands there at once is not taken for one that multiplies", "[studio][stop]") {
    OpenStudio studio("lsystem: 1\nderivation length: 3\naxiom: A\nA --> " + std::string(3000, 'F') + "\nendlsystem\n");
    ListeningPage& page = studio.begin();
    studio.wait([&] { return page.last("growth").is_object() && page.last("growth")["state"] != "growing"; });
    CHECK(page.last("growth")["state"] == "done");
}

TEST_CASE("a change ends the endless growth before it, and so does the end of the studio", "[studio][stop]") {
    const auto begin = std::chrono::steady_clock::now();
    {
        OpenStudio studio("#define LENGTH 1\nlsystem: 1\nderivation length: 5\naxiom: " + std::string(500, 'F') +
                          "\nF : {i = 0; while (i < 9e7) {i = i + LENGTH;}} 1 --> F\nendlsystem\n");
        ListeningPage& page = studio.begin();
        studio.wait([&] { return page.last("growth")["step"] == 0; });
        studio.change({{"settings", {{"LENGTH", "100000000"}}}});
        studio.wait_until_grown();
        studio.change({{"settings", {{"LENGTH", "1"}}}});
    }
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(10));
}

TEST_CASE("what models print is one message of the page", "[studio][stop]") {
    OpenStudio studio(
        "#define LENGTH 1\nlsystem: 1\nStartEach: { for (i = 0; i < 300; i += 1) { printf(\"step %g%c\\n\", Q, 27); } "
        "}\n"
        "derivation length: 3\naxiom: F(LENGTH)\nF --> F\nendlsystem\n");
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    studio.wait([&] { return !page.last("message").is_null(); });
    const std::string text = page.last("message")["text"];
    CHECK(text.starts_with("Printed by the model:\nstep 1\\x1b\nstep 1\\x1b\n"));
    CHECK(text.size() < 5000);
    CHECK(page.last("message")["severity"] == "note");
}

TEST_CASE("nothing is written outside the opened folder", "[studio]") {
    OpenStudio studio(tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    for (const char* path : {"../elsewhere.l", "/elsewhere.l", "a/../../elsewhere.l"}) {
        INFO(path);
        CHECK(studio.ask({{"do", "save"}, {"path", path}}).contains("error"));
    }
    CHECK(studio.ask({{"do", "open"}, {"path", "/etc/hostname"}}).contains("error"));
    CHECK(studio.change({{"texts", {{"/etc/hostname", "x"}}}}).contains("error"));

    studio.change({{"settings", {{"LENGTH", "4"}}}});
    CHECK_FALSE(studio.ask({{"do", "save"}}).contains("error"));
    CHECK(text_of(studio.file).find("#define LENGTH 4") != std::string::npos);
    CHECK(page.last("document")["texts"][0]["changed"] == false);
    CHECK_FALSE(studio.ask({{"do", "save"}, {"path", "copies/other.l"}}).contains("error"));
    CHECK(text_of(studio.folder.path() / "copies/other.l") == text_of(studio.file));
    studio.wait_until_grown();
    CHECK(page.last("document")["name"] == "other.l");
}

TEST_CASE("a new side file stands beside the document, never over another file or elsewhere", "[studio]") {
    OpenStudio studio(tree);
    studio.begin();
    studio.wait_until_grown();
    const auto ask = [&](const char* name) {
        return studio.ask({{"do", "new-file"}, {"name", name}, {"content", "line style: cylinder\n"}});
    };
    CHECK_FALSE(ask("plant.v").contains("error"));
    CHECK(text_of(studio.folder.path() / "plant.v") == "line style: cylinder\n");
    for (const char* name : {"plant.v", "plant.l", "notes", "run.sh", ""}) {
        INFO(name);
        CHECK(ask(name).contains("error"));
    }
    CHECK_FALSE(ask("../other.v").contains("error"));  // its last part is the name
    CHECK_FALSE(std::filesystem::exists(studio.folder.path() / "../other.v"));
}

TEST_CASE("undo goes back behind a save, and the file follows the next one", "[studio]") {
    OpenStudio studio(tree);
    studio.begin();
    studio.wait_until_grown();
    const std::string other = std::string(tree) + "/* more */\n";
    studio.change({{"texts", {{studio.file.string(), other}}}});
    studio.ask({{"do", "save"}});
    CHECK(text_of(studio.file) == other);
    studio.ask({{"do", "undo"}});
    CHECK(studio.page.last("document")["texts"][0]["content"] == tree);
    CHECK(studio.page.last("document")["texts"][0]["changed"] == true);
    studio.ask({{"do", "save"}});
    CHECK(text_of(studio.file) == tree);
    studio.ask({{"do", "redo"}});
    CHECK(studio.page.last("document")["texts"][0]["content"] == other);
}

TEST_CASE("unsaved work is there again after the program was killed", "[studio]") {
    OpenStudio studio(tree);
    studio.options.state = studio.scratch.path() / "state.json";
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    studio.change({{"settings", {{"LENGTH", "9"}}}, {"label", "LENGTH 9"}});
    studio.session->tick();
    const std::string kept = text_of(studio.options.state);
    studio.session.reset();
    studio.folder.write("state-of-the-killed", kept);

    OpenStudio second(tree);
    page.texts.clear();
    studio.begin();
    studio.wait_until_grown();
    CHECK(page.last("document")["texts"][0]["changed"] == true);
    CHECK(page.last("document")["undo"] == "LENGTH 9");
    studio.ask({{"do", "undo"}});
    CHECK(page.last("document")["texts"][0]["content"] == tree);

    studio.session.reset();
    studio.scratch.write("state.json", "{\"states\": [1]}");
    page.texts.clear();
    studio.begin();
    CHECK(page.last("message")["severity"] == "warning");
}

TEST_CASE("a document that the studio ended at while opening it is not opened again by itself", "[studio]") {
    OpenStudio studio(tree);
    studio.options.state = studio.scratch.path() / "state.json";
    const fs::path mark = studio.scratch.path() / "state.json.opening";
    std::string marked;
    const auto read = studio.options.read;
    studio.options.read = [&](const espalier::studio::Opened& opened) {
        marked = text_of(mark);
        return read(opened);
    };
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    CHECK(marked == studio.file.string());
    CHECK_FALSE(fs::exists(mark));
    studio.change({{"settings", {{"LENGTH", "9"}}}, {"label", "LENGTH 9"}});
    studio.wait_until_grown();
    studio.session->tick();
    studio.session.reset();
    CHECK_FALSE(fs::exists(mark));

    const auto restart = [&] {
        studio.session.reset();
        studio.scratch.write("state.json.opening", studio.file.string());
        page.texts.clear();
        marked.clear();
        studio.begin();
    };
    SECTION("nothing is open then, and undo opens it with its unsaved texts") {
        studio.options.opened = {};
        restart();
        CHECK(page.last("document")["path"] == "");
        CHECK(page.last("message")["severity"] == "warning");
        CHECK(page.last("message")["text"].get<std::string>().find("plant.l") != std::string::npos);
        CHECK(marked.empty());
        studio.ask({{"do", "undo"}});
        studio.wait_until_grown();
        CHECK(page.last("document")["texts"][0]["changed"] == true);
        CHECK(marked == studio.file.string());
    }
    SECTION("nor is it opened as what a studio opens where nothing was named") {
        studio.options.is_named = false;
        restart();
        CHECK(page.last("document")["path"] == "");
    }
    SECTION("who names it gets what is on disk") {
        restart();
        studio.wait_until_grown();
        CHECK(page.last("document")["path"] == studio.file.string());
        CHECK(page.last("document")["texts"][0]["content"] == tree);
        CHECK(page.last("document")["texts"][0]["changed"] == false);
    }
    SECTION("a mark of another document says nothing of this one") {
        studio.session.reset();
        studio.scratch.write("state.json.opening", "/another/plant.l");
        page.texts.clear();
        studio.begin();
        studio.wait_until_grown();
        CHECK(page.last("document")["texts"][0]["changed"] == true);
    }
}

TEST_CASE("half a character in a text is answered, and becomes the sign for a lost one", "[studio]") {
    OpenStudio studio(tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    const std::string text = "/* \\ud83c\\udf33 \\ud83c */\\n";
    studio.session->receive(page, R"({"do": "change", "id": 901, "label": "\ud83c", "texts": {")" +
                                      studio.file.string() + "\": \"" + text + "\"}}");
    const auto replied = std::find_if(page.texts.begin(), page.texts.end(),
                                      [](const Json& one) { return one.contains("reply") && one["reply"] == 901; });
    REQUIRE(replied != page.texts.end());
    CHECK_FALSE(replied->contains("error"));
    CHECK(page.last("document")["texts"][0]["content"] == "/* \xf0\x9f\x8c\xb3 \xef\xbf\xbd */\n");
}

TEST_CASE("what growths posted before a studio ended is not done afterwards", "[studio]") {
    OpenStudio studio(tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    studio.change({{"settings", {{"LENGTH", "9"}}}});
    studio.session->tick();
    const std::size_t told = page.texts.size();
    studio.session.reset();
    while (studio.mailbox.work_once(std::chrono::milliseconds(50))) {
    }
    CHECK(page.texts.size() == told);
}

TEST_CASE("a colour map travels in base64, and is kept as it was", "[studio]") {
    const std::string bytes = "\xff\x00\x80" + std::string(765, '\x7f');
    OpenStudio studio("lsystem: 1\nderivation length: 1\naxiom: ;(1)F\nendlsystem\n");
    studio.folder.write("plants.map", std::string(768, '\0'));
    studio.options.state = studio.scratch.path() / "state.json";
    studio.options.read = [](const espalier::studio::Opened& opened) {
        espalier::ObjectFiles object;
        object.model = opened.path;
        object.colour_maps[1] = opened.path.parent_path() / "plants.map";
        return espalier::scene_of_object(object, {{}, opened.steps, opened.seed});
    };
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    const auto map = [&] { return page.last("document")["texts"][1]; };
    CHECK(map()["language"] == "map");
    CHECK(map()["content"] == std::string(1024, 'A'));
    const std::string file = map()["path"], content = espalier::base64(bytes.substr(0, 768));
    CHECK(studio.change({{"texts", {{file, "no base64!"}}}}).contains("error"));
    studio.change({{"texts", {{file, content}}}});
    studio.wait_until_grown();
    studio.session.reset();
    page.texts.clear();
    studio.begin();
    studio.wait_until_grown();
    CHECK(map()["content"] == content);
    CHECK(page.last("message").is_null());
}

TEST_CASE("files that go away while a studio runs are told, and end nothing", "[studio]") {
    OpenStudio studio(tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    std::filesystem::remove(studio.file);
    studio.change({{"steps", 5}});
    for (int i = 0; i < 20; ++i) studio.mailbox.work_once(std::chrono::milliseconds(10)), studio.session->tick();
    studio.folder.write("plant.l", tree);
    studio.change({{"steps", 6}});
    studio.wait_until_grown();
    CHECK(page.last("growth")["step"] == 6);
}

TEST_CASE("a scene with a process grows with its fields, which pages can see", "[studio]") {
    const std::string model =
        "environment light;\nlsystem: 1\nderivation length: 5\nStartEach: { n = n + 1; }\naxiom: A\n"
        "A --> F(1) ?light(1) A\nendlsystem\n";
    const std::string scene =
        "[[plant]]\nmodel = \"tree.l\"\n[environment.light]\nprocess = \"voxel-shade\"\n"
        "voxel = 0.5\n";
    OpenStudio studio(scene, "scene.toml");
    studio.folder.write("tree.l", model);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    CHECK(page.last("growth")["step"] == 5);
    CHECK(page.last("document")["kind"] == "scene");
    CHECK(page.last("document")["texts"].size() == 2);
    REQUIRE(!page.last("fields")["fields"].empty());
    CHECK(page.last("fields")["fields"][0]["name"] == "light");
    const auto field_at = [&](int step) {
        studio.ask({{"do", "field"}, {"growth", page.last("growth")["growth"]}, {"step", step}, {"name", "light"}});
        REQUIRE(page.packets.back().substr(0, 4) == "ESF1");
        return page.packets.back();
    };
    // The lowest light: the more there is to cast shade, the less.
    const std::string first = field_at(1), field = field_at(5);
    CHECK(number_at<std::int32_t>(first, 8) == 1);
    CHECK(number_at<std::int32_t>(field, 8) == 5);
    CHECK(number_at<float>(first, 48) > number_at<float>(field, 48));
    const Json later = {{"do", "field"}, {"growth", page.last("growth")["growth"]}, {"step", 6}, {"name", "light"}};
    CHECK(studio.ask(later)["error"] == "step 6 has not been grown");
    const auto voxels =
        number_at<std::uint32_t>(field, 12) * number_at<std::uint32_t>(field, 16) * number_at<std::uint32_t>(field, 20);
    CHECK(voxels > 0);
    CHECK(field.size() == 24 + 24 + 8 + 4 + 8 + voxels);  // "light", padded
    CHECK(number_at<float>(field, 48) < number_at<float>(field, 52));
}

TEST_CASE("malformed requests are answered, not obeyed", "[studio]") {
    OpenStudio studio(tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    for (const char* text : {"", "{", "[]", "1", R"({"do": 1, "id": 2})", R"({"do": "look", "id": 2})",
                             R"({"do": "nothing", "id": 2})", R"({"do": "frame", "growth": "x", "step": [], "id": 3})",
                             R"({"do": "change", "texts": [], "steps": "x", "id": 4})",
                             R"({"do": "pick", "growth": 1, "step": 1e99, "module": -1, "id": 5})"}) {
        INFO(text);
        const std::size_t before = page.texts.size();
        studio.session->receive(page, text);
        REQUIRE(page.texts.size() == before + 1);
        CHECK(page.texts.back().contains("error"));
    }
}

TEST_CASE("what is open is exported as `export` would do it", "[studio]") {
    OpenStudio studio(tree);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    CHECK(studio.ask({{"do", "export"}, {"format", "nothing"}}).contains("error"));
    studio.ask({{"do", "export"}, {"format", "csv"}});
    studio.wait([&] { return !page.last("exported").is_null(); });
    const Json files = page.last("exported")["files"];
    REQUIRE(!files.empty());
    const auto file = studio.session->file(files[0]["number"].get<std::uint32_t>());
    REQUIRE(file);
    CHECK(std::filesystem::file_size(*file) == files[0]["bytes"]);
    CHECK_FALSE(studio.session->file(99999));
}

TEST_CASE("a thousand changes in a row cancel a thousand growths", "[studio]") {
    OpenStudio studio(tree);
    ListeningPage& page = studio.begin();
    for (int change = 1; change <= 1000; ++change) {
        const std::string value = std::to_string(change);
        REQUIRE_FALSE(studio.change({{"settings", {{"LENGTH", value}}}}, change % 3 == 0).contains("error"));
        studio.mailbox.work_once(std::chrono::milliseconds(change % 7 == 0 ? 5 : 0));
        if (change % 50 == 25) page.texts.clear();
        studio.session->tick();
    }
    studio.wait_until_grown();
    const std::string text = page.last("document")["texts"][0]["content"];
    CHECK(text.find("#define LENGTH 1000\n") != std::string::npos);
    CHECK(page.last("growth")["step"] == 4);
}

TEST_CASE("another growth of twenty thousand nodes begins before the first has ended", "[studio]") {
    const std::string large = R"(#define STEPS 100000
lsystem: 1
derivation length: STEPS
axiom: A(0)
A(n) : n < 14 --> F(0.01) [ +(30) A(n+1) ] A(n+1)
F(x) --> F(x * 1.0001)
endlsystem
)";
    OpenStudio studio(large);
    ListeningPage& page = studio.begin();
    studio.wait([&] { return !page.last("growth").is_null() && page.last("growth")["step"] > 16; });
    CHECK(page.last("growth")["internodes"] == 16383);
    for (int change = 0; change < 5; ++change) {
        studio.change({{"settings", {{"STEPS", std::to_string(50000 + change)}}}});
        const Json version = page.last("document")["version"];
        studio.wait([&] { return page.last("growth")["version"] == version; });
        CHECK(page.last("growth")["step"] < 50000);
    }
    studio.change({{"settings", {{"STEPS", "15"}}}});
    studio.wait_until_grown();
    CHECK(page.last("growth")["step"] == 15);
}
