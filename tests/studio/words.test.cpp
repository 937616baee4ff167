// Sliders say what they move: the numbers of the library have words, ranges and units, not only names.
#include "espalier/base/file.h"
#include "espalier/environment/environment_process.h"

#include "catch.h"
#include "studio/document/scene_words.h"
#include "studio/document/written_numbers.h"
#include "studio/session/notation_help.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace espalier;
using namespace espalier::studio;

namespace {

namespace fs = std::filesystem;

std::vector<WrittenNumber> numbers_of(const fs::path& file) {
    return written_numbers(file, read_text(file));
}

std::vector<fs::path> files_below(const char* folder, const std::vector<std::string>& kinds) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(ESPALIER_SOURCE_DIR) / folder)) {
        const bool fits = std::count(kinds.begin(), kinds.end(), entry.path().extension()) > 0;
        if (entry.is_regular_file() && fits) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string name_of(const WrittenNumber& number) {
    return number.name.substr(number.name.rfind('.') + 1);
}

}  // namespace

TEST_CASE("every slider of every model has words and a range", "[studio]") {
    int sliders = 0;
    for (const fs::path& file : files_below("models", {".l", ".species", ".pgraph", ".sdl"})) {
        for (const WrittenNumber& number : numbers_of(file)) {
            INFO(file.string() << ": " << number.name);
            ++sliders;
            CHECK_FALSE(number.label.empty());
            CHECK(number.label != number.name);
            CHECK((std::isfinite(number.lowest) || std::isfinite(number.highest)));
        }
    }
    CHECK(sliders > 500);
}

TEST_CASE("the parameters of a species have sliders, each where its line writes it", "[studio]") {
    const std::string text =
        "/* Scale = 3 */\nLevels = 2\nScale, ScaleV = 10, 3  // Ratio = 5\nRatio=0.02\n"
        "0CurveRes, 0Curve , 0CurveBack = 8, 8, -8\n1Branches = 30\n";
    const std::vector<WrittenNumber> numbers = written_numbers("oak.species", text);
    std::vector<std::string> names;
    for (const WrittenNumber& number : numbers) {
        INFO(number.name);
        names.push_back(number.name);
        CHECK(text.substr(number.offset, number.text.size()) == number.text);
        CHECK(std::stod(number.text) == number.value);
    }
    CHECK(names ==
          std::vector<std::string>{"Scale", "ScaleV", "Ratio", "CurveRes_0", "Curve_0", "CurveBack_0", "Branches_1"});
    const std::string changed = with_number(text, numbers[4], "12");
    CHECK(changed.find("= 8, 12, -8") != std::string::npos);
    CHECK(numbers[4].group == "Trunk");
    CHECK(numbers[6].lowest == 0);
    CHECK_FALSE(std::isfinite(numbers[6].highest));  // 100,000 branches, a guard, are no end of a slider
    CHECK(numbers[4].highest == 360);
    CHECK(numbers[6].group == "Level 1");
    for (const fs::path& file : files_below("models", {".species"})) CHECK(numbers_of(file).size() > 20);
}

TEST_CASE("the sliders of a scene say what the model and the documentation say of them", "[studio]") {
    int sliders = 0, described = 0;
    for (const fs::path& file : files_below("environments", {".toml"})) {
        if (read_text(file).find("[[plant]]") == std::string::npos) continue;
        for (const WrittenNumber& number : numbers_of(file)) {
            ++sliders;
            if (number.label != name_of(number))
                ++described;
            else
                UNSCOPED_INFO(file.filename() << " " << number.name);
        }
    }
    CHECK(described == sliders);
}

TEST_CASE("a plant without a name has the sliders of its stages", "[studio]") {
    std::vector<std::string> names;
    for (const WrittenNumber& number : numbers_of(fs::path(ESPALIER_SOURCE_DIR) / "environments/hedge.toml")) {
        names.push_back(number.name);
    }
    for (const char* name : {"plant.0.stage.0.tip", "plant.0.stage.1.size", "environment.markers.influence"}) {
        INFO(name);
        CHECK(std::count(names.begin(), names.end(), name) == 1);
    }
}

TEST_CASE("a number that replaces one of a model has its words, range and unit", "[studio]") {
    const fs::path file = fs::path(ESPALIER_SOURCE_DIR) / "environments/one-root.toml";
    const std::vector<WrittenNumber> numbers = numbers_of(file);
    const auto azimuth = std::find_if(numbers.begin(), numbers.end(),
                                      [](const WrittenNumber& number) { return name_of(number) == "AZIMUTH"; });
    REQUIRE(azimuth != numbers.end());
    CHECK(azimuth->name == "plant.0.define.AZIMUTH");
    CHECK(azimuth->label.starts_with("the first rootlet"));
    CHECK(azimuth->highest == 360);
    CHECK(azimuth->unit == "degrees");
}

TEST_CASE("words of a key are the first sentence of what its row means, which may go on in the next line", "[studio]") {
    const std::string help =
        "What it does.\n\n"
        "  voxel   m, 0.5; edge of a voxel. Whole voxels cover the domain\n"
        "  depth   6; number of layers\n"
        "          below\n"
        "  voxels  other\n";
    CHECK(words_of_key(help, "voxel").meaning == "edge of a voxel");
    CHECK(words_of_key(help, "voxel").unit == "m");
    CHECK(words_of_key(help, "depth").meaning == "number of layers below");
    CHECK(words_of_key(help, "full_light").meaning == "full_light");
}

TEST_CASE("every word of skeletons is explained to the page", "[studio]") {
    const auto words = words_of_languages();
    for (const HelpEntry& entry : words.at("sdl")) {
        INFO(entry.name);
        CHECK_FALSE(entry.summary.empty());
    }
}
