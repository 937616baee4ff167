// Panels of sliders, as the files of their authors lay them out.
#include "simulation/object/panels.h"

#include "espalier/simulation/scene.h"

#include "catch.h"
#include "temporary_folder.h"

using namespace espalier;
using namespace espalier::simulation;

namespace {

const char* const two_sliders = R"([[panel]]
title = "Growth"
columns = 2
settings = [
  { name = "ANGLE", label = "Angle", unit = "degrees", lowest = 10, highest = 60, step = 2.5 },
  { name = "STEPS" },
]
)";

std::string mistake_in_panels(const std::string& text) {
    try {
        read_panel_text(text, "tree.panel");
    } catch (const UserError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a panel has a title, columns, and sliders in the order of the file", "[panels]") {
    const std::vector<Panel> panels = read_panel_text(
        std::string(two_sliders) + "[[panel]]\ntitle = \"Rest\"\nopen = false\nsettings = [\"B\", \"A\"]\n",
        "tree.panel");
    REQUIRE(panels.size() == 2);
    CHECK((panels[0].title == "Growth" && panels[0].columns == 2 && panels[0].is_open));
    const PanelSlider& angle = panels[0].sliders.at(0);
    CHECK((angle.setting == "ANGLE" && angle.label == "Angle" && angle.unit == "degrees"));
    CHECK((angle.lowest == 10.0 && angle.highest == 60.0 && angle.step == 2.5));
    CHECK(angle.place.line == 5);
    const PanelSlider& steps = panels[0].sliders.at(1);
    CHECK((steps.setting == "STEPS" && !steps.label && !steps.unit && !steps.lowest && !steps.highest && !steps.step));
    CHECK((panels[1].columns == 1 && !panels[1].is_open));
    CHECK((panels[1].sliders.at(0).setting == "B" && panels[1].sliders.at(1).setting == "A"));
    CHECK(read_panel_text("", "tree.panel").empty());
}

TEST_CASE("what is wrong with a panel is told with its line", "[panels]") {
    const auto [text, place, words] = GENERATE(table<std::string, std::string, std::string>({
        {"[[panel]]\nsettings = [\"A\"]\n", "tree.panel:1:", "title"},
        {"[[panel]]\ntitle = \"T\"\n", "tree.panel:1:", "settings = [\"NAME\""},
        {"[[panel]]\ntitle = \"T\"\nsettings = []\n", "tree.panel:1:", "settings = [\"NAME\""},
        {"[[panel]]\ntitle = \"T\"\nsettings = [\"A\"]\ncolumns = 5\n", "tree.panel:4:", "4"},
        {"[[panel]]\ntitle = \"T\"\nsettings = [{ label = \"x\" }]\n", "tree.panel:3:", "name"},
        {"[[panel]]\ntitle = \"T\"\nsettings = [{ name = \"A\", step = 0 }]\n", "tree.panel:3:", "step"},
        {"[[panel]]\ntitle = \"T\"\nsettings = [{ name = \"A\", lowest = 2, highest = 2 }]\n",
         "tree.panel:3:", "must be less"},
        {"[[panel]]\ntitle = \"T\"\nsettings = [{ name = \"A\", lable = \"x\" }]\n", "tree.panel:3:", "label"},
        {"[[panel]]\ntitle = \"T\"\nsettings = [\"A\", \"B\",\n\"A\"]\n", "tree.panel:3:", "'A' has a slider already"},
        {"[[panels]]\ntitle = \"T\"\n", "tree.panel:1:", "panel"},
    }));
    INFO(text << "\n" << mistake_in_panels(text));
    CHECK(mistake_in_panels(text).starts_with(place));
    CHECK_THAT(mistake_in_panels(text), Catch::Contains(words));
}

TEST_CASE("a scene may have panels, which change nothing of what grows", "[panels]") {
    const TemporaryFolder folder;
    folder.write("tree.l", "lsystem: 1\nderivation length: 3\naxiom: A\nA --> F A\nendlsystem\n");
    const std::string scene = "[[plant]]\nmodel = \"tree.l\"\n";
    CHECK(read_scene_text(scene + two_sliders, "s.toml", folder.path()).plants.size() == 1);
    CHECK_THROWS_WITH(read_scene_text(scene + "[[panel]]\ntitle = \"T\"\nsettings = 3\n", "s.toml", folder.path()),
                      Catch::Contains("s.toml:5:"));
    CHECK(panel_file_of("models/tree.l") == "models/tree.panel");
}

TEST_CASE("the panels of an object lie beside its model, in its folder", "[panels]") {
    const TemporaryFolder folder;
    const std::filesystem::path object = folder.path() / "shoot";
    std::filesystem::create_directory(object);
    folder.write("shoot/plant.l", "lsystem: 1\nderivation length: 1\naxiom: A\nA --> F A\nendlsystem\n");
    CHECK(panel_file_of(object) == object / "plant.panel");
    CHECK(mistakes_in_panels_of(object).empty());
    folder.write("shoot/plant.panel", "[[panel]]\ntitle = \"T\"\n");
    REQUIRE(mistakes_in_panels_of(object).size() == 1);
    CHECK(mistakes_in_panels_of(object).front().place.line == 1);
    folder.write("shoot/other.l", "");
    CHECK_THROWS_AS(panel_file_of(object), UserError);
}
