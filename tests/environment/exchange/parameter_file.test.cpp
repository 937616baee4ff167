#include "environment/exchange/parameter_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "catch.h"
#include "environment/exchange/exchange_plants.h"

#include <filesystem>
#include <unistd.h>

using namespace espalier;
using namespace espalier::environment;

namespace {

/// A parameter file on disk and what its reader says about it.
struct Read {
    explicit Read(const std::string& text, const std::string& scene = "") {
        std::filesystem::create_directories(folder);
        write_text(folder / "process.spec", text);
        context.warnings = &warnings;
        table = Settings::parse_toml("parameters = \"process.spec\"\n" + scene, "scene.toml", folder);
    }

    ~Read() { std::filesystem::remove_all(folder); }

    ParameterFile file() {
        return {table, context, {"radius", "grid size", "3d case", "source direction", "input image"}};
    }

    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("espalier-parameter-file-" + std::to_string(::getpid()));
    std::vector<Diagnostic> warnings;
    EnvironmentContext context;
    Settings table;
};

}  // namespace

TEST_CASE("sizes are split at blanks, commas, colons, tabs and the letter x, and what follows a number is left over",
          "[environment][parameter file]") {
    for (const char* line :
         {"grid size: 32x16x8", "grid size:32 16 8", "grid size\t32,16;8", "grid size: 32x16x8view"}) {
        Read read(line);
        CHECK(read.file().numbers("grid size", {1, 1, 1}) == std::vector<double>{32, 16, 8});
    }
    Read two("grid size: 4 5");
    CHECK(two.file().numbers("grid size", {1, 1, 7}) == std::vector<double>{4, 5, 7});
}

TEST_CASE("a byte-order mark before the first key is passed over", "[environment][parameter file]") {
    Read read("\xEF\xBB\xBFradius: 0.5\n");
    CHECK(read.file().number("radius", 0) == 0.5);
    CHECK(read.warnings.empty());
}

TEST_CASE("a program's dialect may know keys in any case, comments, and values that go on",
          "[environment][parameter file]") {
    Read read("Radius: 0.5\n// radius: 7\nsource direction: 0 1\n: 0 4\n");
    ParameterFile file(read.table, read.context, {"radius", "source direction"}, {true, true, true});
    CHECK(file.number("radius", 0) == 0.5);
    CHECK(file.repeated("source direction", 3, 4) == std::vector<std::vector<double>>{{0, 1, 0, 4}});
    CHECK(file.has("radius"));
    CHECK_FALSE(file.has("grid size"));
    CHECK(read.warnings.empty());
}

TEST_CASE("a key in the wrong case is passed over, with its place and the nearest known key",
          "[environment][parameter file]") {
    Read read("radius: 0.5\n\n3D case: one\r\n3d case: one\n");
    ParameterFile file = read.file();
    CHECK(file.number("radius", 0) == 0.5);
    CHECK_FALSE(file.flag("3d case", false));
    REQUIRE(read.warnings.size() == 2);
    CHECK(lacks(to_string(read.warnings[0]), {"process.spec:3", "'3D case'", "did you mean '3d case'"}) == "");
    CHECK(lacks(to_string(read.warnings[1]), {"process.spec:4", "'one'", "write 'on'"}) == "");
}

TEST_CASE("a missing value keeps the default, the last of two lines counts, and verbose is no mistake",
          "[environment][parameter file]") {
    Read read("verbose: on\nradius: 2\nradius: 3 metres\n3d case:\n");
    ParameterFile file = read.file();
    CHECK(file.number("radius", 0) == 3);
    CHECK(file.flag("3d case", true));
    CHECK(file.numbers("grid size", {1, 1, 1}) == std::vector<double>{1, 1, 1});
    CHECK(read.warnings.empty());
}

TEST_CASE("lines may be long, and a key that may come again keeps them all", "[environment][parameter file]") {
    Read read("source direction: 0 1 0" + std::string(5000, ' ') + "4\nsource direction: 1, 1, 0\n");
    CHECK(read.file().repeated("source direction", 3, 4) == std::vector<std::vector<double>>{{0, 1, 0, 4}, {1, 1, 0}});
}

TEST_CASE("a scene's own keys win over those of the file", "[environment][parameter file]") {
    Read read("radius: 2\ngrid size: 4x4x4\n", "radius = 5\n3d_case = true\nsource_direction = [\"0 -1 0 2\"]\n");
    ParameterFile file = read.file();
    CHECK(file.number("radius", 0) == 5);
    CHECK(file.flag("3d case", false));
    CHECK(file.numbers("grid size", {1, 1, 1}) == std::vector<double>{4, 4, 4});
    CHECK(file.repeated("source direction", 3, 4) == std::vector<std::vector<double>>{{0, -1, 0, 2}});
}

TEST_CASE("numbers out of range are mistakes with their place; no number at all is 0, as cpfg's programs read",
          "[environment][parameter file]") {
    Read low("verbose: on\ngrid size: 4 -1 4\n");
    ParameterFile small = low.file();
    CHECK(lacks(message_of([&] {
                    small.numbers("grid size", {1, 1, 1}, Range::between(1, 100));
                }),
                {"process.spec:2", "'grid size'", "at least 1", "-1"}) == "");
    for (const char* line : {"radius: nan", "radius: inf", "radius: 1e999"}) {
        Read read(line);
        CHECK(lacks(message_of([&] { read.file().number("radius", 0); }), {"process.spec:1", "'radius'"}) == "");
    }
    Read word("radius: wide\n");
    CHECK(word.file().number("radius", 3) == 0);
    CHECK(word.warnings.size() == 1);
    Read few("source direction: 1 2\n");
    CHECK(lacks(message_of([&] { few.file().repeated("source direction", 3, 4); }), {"process.spec:1", "3 numbers"}) ==
          "");
}

TEST_CASE("files are looked for beside the parameter file", "[environment][parameter file]") {
    Read read("input image: ground.rgb\n");
    ParameterFile file = read.file();
    const auto path = file.file("input image");
    REQUIRE(path);
    CHECK(path->filename() == "ground.rgb");
    CHECK(path->parent_path() == read.folder);
    CHECK_FALSE(Read("").file().file("input image"));
}

TEST_CASE("keys are written with underscores in scenes", "[environment][parameter file]") {
    CHECK(scene_key("3d case") == "3d_case");
    CHECK(scene_key("use CIE formula") == "use_cie_formula");
    CHECK(scene_key("leaf material (top)") == "leaf_material_top");
}
