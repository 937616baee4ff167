// Sliders as the author of a document lays them out.
#include "simulation/object/panels.h"

#include "espalier/base/file.h"

#include "session_fixture.h"
#include "studio/document/document_files.h"
#include "studio/document/saved_places.h"
#include "studio/session/panels.h"

using namespace studio_test;

namespace {

namespace fs = std::filesystem;
using Catch::Contains;

const char* const bare_stalk = R"(#define ANGLE 30  /* of branches; 5..80; degrees */
#define LENGTH 1  /* of an internode */
lsystem: 1
derivation length: 3
axiom: A
A --> F(LENGTH) [ +(ANGLE) F(LENGTH) ] A
endlsystem
)";
const char* const form_panel = R"([[panel]]
title = "Form"
columns = 2
settings = [
  { name = "LENGTH", label = "Internodes", unit = "m", lowest = 0.5, highest = 3, step = 0.25 },
  { name = "ANGLE", lowest = 20 },
]
)";

/// Reads what lies beside a model, as the program does.
espalier::Scene read_with_panels(const espalier::studio::Opened& opened) {
    espalier::Scene scene = read_as_run(opened);
    for (espalier::Diagnostic& mistake : espalier::mistakes_in_panels_of(opened.path))
        scene.notes.diagnostics.push_back(std::move(mistake));
    return scene;
}

struct Laid : OpenStudio {
    explicit Laid(const std::string& text = form_panel) : OpenStudio(bare_stalk) {
        file = folder.write("plant.panel", text);
        options.read = read_with_panels;
        begin();
        wait_until_grown();
    }
    Json shown() const { return page.last("document")["panels"]; }
    Json problems() const { return page.last("problems")["problems"]; }
    void write(const std::string& text) { change({{"texts", {{file.string(), text}}}}); }

    fs::path file;
};

}  // namespace

TEST_CASE("a page is told the panels that lie beside a model", "[studio]") {
    Laid studio;
    const Json panel = studio.shown().at(0);
    CHECK((panel["title"] == "Form" && panel["columns"] == 2 && panel["open"] == true));
    const Json length = panel["sliders"].at(0), angle = panel["sliders"].at(1);
    CHECK((length["name"] == "LENGTH" && length["label"] == "Internodes" && length["unit"] == "m"));
    CHECK((length["lowest"] == 0.5 && length["highest"] == 3 && length["step"] == 0.25));
    CHECK((angle["label"].is_null() && angle["lowest"] == 20 && angle["highest"].is_null() && angle["step"].is_null()));
    CHECK(studio.problems().empty());
}

TEST_CASE("a page is told the panels in the folder of an object", "[studio]") {
    const TemporaryFolder place;
    fs::create_directory(place.path() / "stalk");
    place.write("stalk/plant.l", bare_stalk);
    place.write("stalk/plant.panel", form_panel);
    OpenStudio studio(bare_stalk);
    studio.options.opened.path = place.path() / "stalk";
    studio.options.read = [](const espalier::studio::Opened& opened) {
        espalier::Scene scene = espalier::scene_of_object(espalier::simulation::read_object_folder(opened.path));
        espalier::mistakes_in_panels_of(opened.path);
        return scene;
    };
    studio.begin();
    studio.wait_until_grown();
    const Json panels = studio.page.last("document")["panels"];
    REQUIRE(panels.size() == 1);
    const Json length = panels.at(0)["sliders"].at(0);
    CHECK((length["name"] == "plant.l:LENGTH" && length["label"] == "Internodes"));
}

TEST_CASE("panels are edited as other texts are, undone, and nothing grows anew for them", "[studio]") {
    Laid studio;
    const std::size_t packets = studio.page.packets.size();
    const std::string packet = studio.page.packets.back().substr(8);
    studio.write("[[panel]]\ntitle = \"One\"\nsettings = [\"ANGLE\"]\n");
    studio.wait_until_grown();
    CHECK((studio.shown().size() == 1 && studio.shown().at(0)["title"] == "One"));
    CHECK(studio.page.packets.size() >= packets);
    CHECK((studio.page.packets.back().substr(8) == packet));
    studio.ask({{"do", "undo"}});
    studio.wait_until_grown();
    CHECK(studio.shown().at(0)["title"] == "Form");
}

TEST_CASE("a mistake in panels is told at its place, and the plant stays", "[studio]") {
    Laid studio;
    studio.write("[[panel]]\ntitle = \"One\"\n");
    studio.wait_until_grown();
    studio.wait([&] { return !studio.problems().empty(); });
    const Json problem = studio.problems().at(0);
    CHECK((problem["severity"] == "error" && problem["file"] == studio.file.string() && problem["line"] == 1));
    CHECK(studio.shown().empty());
    CHECK(studio.page.last("growth")["state"] == "done");
    studio.write("[[panel]]\ntitle = \"One\"\nsettings = [\n\"ANGEL\", \"LENGTH\"]\n");
    studio.wait_until_grown();
    studio.wait([&] { return studio.problems().size() == 1 && studio.problems().at(0)["severity"] == "warning"; });
    CHECK_THAT(studio.problems().dump(), Contains("there is no setting 'ANGEL' (did you mean 'ANGLE'?)"));
    CHECK(studio.shown().at(0)["sliders"].size() == 1);
}

TEST_CASE("a slider beyond its setting has the ends of the setting, with a warning", "[studio]") {
    Laid studio("[[panel]]\ntitle = \"One\"\nsettings = [{ name = \"ANGLE\", highest = 90 }]\n");
    CHECK_THAT(studio.problems().dump(), Contains("'ANGLE' goes beyond the setting, which lies between 5 and 80"));
    CHECK(studio.shown().at(0)["sliders"].at(0)["highest"].is_null());
}

TEST_CASE("a scene has its panels in its own text", "[studio]") {
    OpenStudio studio(bare_stalk);
    const std::string scene =
        "[[plant]]\nmodel = \"plant.l\"\n[[panel]]\ntitle = \"Both\"\nsettings = [\"plant.l:ANGLE\"]\ncolumns = 2\n";
    studio.options.opened.path = studio.folder.write("scene.toml", scene);
    studio.begin();
    studio.wait_until_grown();
    const Json document = studio.page.last("document");
    CHECK(document["panels"].at(0)["sliders"].at(0)["name"] == "plant.l:ANGLE");
    // What lays out sliders has none itself.
    CHECK_FALSE(Contains("panel").match(document["settings"].dump()));
}

TEST_CASE("panels that a model finds by its name follow the name", "[studio]") {
    const std::map<fs::path, std::string> files{{"/m/tree.l", ""}, {"/m/tree.panel", ""}};
    CHECK(espalier::studio::saved_places("/m/tree.l", files, "/m/oak.l", "/m") ==
          std::map<fs::path, fs::path>{{"/m/tree.l", "/m/oak.l"}, {"/m/tree.panel", "/m/oak.panel"}});
}

TEST_CASE("the panels of the library name settings that there are", "[studio]") {
    std::size_t count = 0;
    for (const char* part : {"models", "environments"}) {
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(ESPALIER_SOURCE_DIR) / part)) {
            const fs::path file = entry.path();
            const bool is_scene =
                file.extension() == ".toml" && espalier::read_text(file).find("[[panel]]") != std::string::npos;
            if (!is_scene && file.extension() != ".panel") continue;
            INFO(file);
            espalier::studio::DocumentState state;
            state.opened.path = is_scene ? file : fs::path(file).replace_extension(".l");
            const espalier::ReadLog log;
            is_scene ? read_as_run(state.opened) : read_with_panels(state.opened);
            espalier::studio::DocumentTexts texts("");
            texts.learn(log.files());
            CHECK(espalier::studio::panel_warnings(texts, state).empty());
            CHECK_FALSE(espalier::studio::shown_panels(texts, state).empty());
            ++count;
        }
    }
    CHECK(count >= 2);
}
