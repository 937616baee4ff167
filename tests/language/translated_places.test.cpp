// What goes wrong as a translated model is read or grows is told at its place in the notation.
#include "espalier/language/model_settings.h"
#include "espalier/language/notation.h"

#include "catch.h"
#include "language/growing.h"
#include "language/text/marks.h"
#include "temporary_folder.h"

#include <fmt/format.h>

using namespace espalier;
using namespace espalier::test;

namespace {

/// Files in a folder, of which one is read and grown.
class Files {
public:
    void write(const std::string& name, const std::string& text) { folder_.write(name, text); }

    /// What the run of a file says, without the name of the folder.
    std::string failure(const std::string& name, const Defines& defines = {}) const {
        try {
            const auto model = read_model(folder_.path() / name, {.defines = defines});
            Derivation derivation(compile(model));
            ModuleString string, next;
            derivation.start(string);
            for (std::uint64_t k = 0; k < 8; ++k) {
                draw(derivation, string, model->alphabet);
                derivation.step(string, next);
                std::swap(string, next);
            }
        } catch (const std::runtime_error& error) {
            return without_folder(error.what());
        }
        return "";
    }

    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }

private:
    static void draw(const Derivation& derivation, const ModuleString& string, const Alphabet& alphabet) {
        BranchLinks links;
        link_branches(string, links);
        const std::vector<std::size_t> offsets = parameter_offsets(string, alphabet);
        ModuleString pictures;
        for (std::size_t i = 0; i < string.size(); ++i) {
            derivation.picture(string, &offsets, links, i, offsets[i], pictures);
        }
    }

    std::string without_folder(std::string text) const {
        const std::string folder = folder_.path().string() + "/";
        for (std::size_t at = text.find(folder); at != text.npos; at = text.find(folder)) text.erase(at, folder.size());
        return text;
    }

    TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("An error in the run of a graph names the word of the graph that it comes from", "[pgraph]") {
    Files files;
    const std::string head = "pgraph 1\nHydra star\n  count 5\nLeaf petal\n", links = "camera -> star -> petal\n";
    files.write("division.pgraph", head + "  length 0.5 / (i - 2)\n" + links);
    CHECK_THAT(files.failure("division.pgraph"),
               Catch::StartsWith("division.pgraph:5:14: division by zero: 0.5 / 0") &&
                   Catch::EndsWith("\n      length 0.5 / (i - 2)\n                 ^"));
    files.write("root.pgraph", head + "  width 1 .. 2 then sqrt(1.5 - x) noise 0.1\n" + links);
    CHECK_THAT(files.failure("root.pgraph"),
               Catch::StartsWith("root.pgraph:5:9: parameter 2 of the new module is -nan"));
    files.write("range.pgraph", head + "  width 1 .. 2 / (u - 0.25)\n" + links);
    CHECK_THAT(files.failure("range.pgraph"), Catch::StartsWith("range.pgraph:5:16: division by zero"));
    files.write("noise.pgraph", head + "  width 1 noise 1 / (i - 2)\n" + links);
    CHECK_THAT(files.failure("noise.pgraph"), Catch::StartsWith("noise.pgraph:5:19: division by zero"));
    files.write("macro.pgraph", "pgraph 1\n#define PART (1 / (i - 2))\nHydra star\n  count 5\n  angle 3 * PART\n" +
                                    std::string("Leaf petal\n") + links);
    CHECK_THAT(files.failure("macro.pgraph"), Catch::StartsWith("macro.pgraph:5:13: division by zero"));
    files.write("drawn.pgraph", head + "  bend 1 .. 3 then 1 / (x - 2)\n  pieces 3\n" + links);
    CHECK_THAT(files.failure("drawn.pgraph"), Catch::StartsWith("drawn.pgraph:5:22: division by zero"));
}

TEST_CASE("What no word of a graph stands for is told at its component", "[pgraph]") {
    Files files;
    files.write("thick.pgraph", "pgraph 1\nHorn stem\n  radius 1.5e308\ncamera -> stem\n");
    CHECK_THAT(files.failure("thick.pgraph"),
               Catch::StartsWith("thick.pgraph:2:6: parameter 1 of the new module is inf"));
}

TEST_CASE("An error in an included graph names that file", "[pgraph]") {
    Files files;
    files.write("leaves.pgraph", "pgraph 1\n\nLeaf oak\n  width 1\n  length sqrt(1 - i)\n");
    files.write("plant.pgraph", "pgraph 1\ninclude \"leaves.pgraph\"\nHydra star\n  count 3\ncamera -> star -> oak\n");
    CHECK_THAT(files.failure("plant.pgraph"),
               Catch::StartsWith("leaves.pgraph:5:10: parameter 1 of the new module is -nan") &&
                   Catch::EndsWith("\n      length sqrt(1 - i)\n             ^"));
}

TEST_CASE("An error in the run of a skeleton names the word of its description", "[sdl]") {
    Files files;
    const std::string rules = "}\nrules{\n  start -> (straw);\n  straw -> (straw*3);\n}\n";
    files.write("division.sdl", "define{\n  start[0,1,0,0];\n  straw[0.5, 0.1 / (i - 2), 0, 30];\n" + rules);
    CHECK_THAT(files.failure("division.sdl"),
               Catch::StartsWith("division.sdl:3:18: division by zero") &&
                   Catch::EndsWith("\n      straw[0.5, 0.1 / (i - 2), 0, 30];\n                     ^"));
    files.write("root.sdl", "define{\n  start[0,1,0,0];\n  straw[0.5, 0, sqrt(1 - i), 30:10];\n" + rules);
    CHECK_THAT(files.failure("root.sdl"), Catch::StartsWith("root.sdl:3:17: parameter 2 of the new module is -nan"));
    files.write("weight.sdl",
                "define{\n  start[0,1,0,0];\n  straw[0.5, 0, 0, 30];\n}\nrules{\n  start -> (straw);\n"
                "  straw -> (straw) : 1\n         | () : 1 / (generation - 2);\n}\n");
    CHECK_THAT(files.failure("weight.sdl"), Catch::StartsWith("weight.sdl:8:19: division by zero"));
    files.write("cut.sdl", "define{\n  start[0,1,0,0];\n  straw[0.5, 0, 0, 30];\n" + rules +
                               "fibres{\n  wooden{\n    cut[0.1, 1 / (length - 1)];\n  }\n}\n");
    CHECK_THAT(files.failure("cut.sdl"), Catch::StartsWith("cut.sdl:11:16: division by zero"));
}

TEST_CASE("An error in the run of a species names the first line that sets a parameter of the level", "[species]") {
    Files files;
    files.write("tall.species", "// too tall\nLevels = 2\nScale = 1e308\n0Length = 10\n1Length = 0.3\n");
    CHECK_THAT(files.failure("tall.species"),
               Catch::StartsWith("tall.species:4:1: a parameter of Bud0 is inf") && Catch::Contains("0Length = 10"));
}

TEST_CASE("A setting that is out of range is told where its notation sets it", "[settings]") {
    Files files;
    files.write("oak.species", "Levels = 2\nRatio = 0.02\n");
    CHECK_THAT(files.failure("oak.species", {{"Ratio", "-1"}}),
               Catch::StartsWith("oak.species:2:1: the setting 'Ratio'"));
    files.write("straw.sdl", "define{\n  a[0,1,0,0];\n}\nrules{\n}\ngenerations 3;\n");
    CHECK_THAT(files.failure("straw.sdl", {{"GENERATIONS", "0.5"}}),
               Catch::StartsWith("straw.sdl:6:1: the setting 'GENERATIONS'"));
    CHECK_THAT(files.failure("straw.sdl", {{"LENGTH", "1"}}),
               Catch::StartsWith("straw.sdl: 'LENGTH' cannot be overridden"));
}

TEST_CASE("The settings of every notation, and of the graphs that one includes, are known", "[settings]") {
    Files files;
    files.write("sizes.pgraph", "pgraph 1\n#define SIZE 3  /* of everything; 1..9; m */\n");
    files.write("plant.pgraph", "pgraph 1\ninclude \"sizes.pgraph\"\nHorn stem\n  length SIZE\ncamera -> stem\n");
    const ModelSettings settings = ModelSettings::read(files.path("plant.pgraph"));
    REQUIRE(settings.list().size() == 1);
    CHECK(settings.list()[0].place.file == files.path("sizes.pgraph").string());
    CHECK(settings.list()[0].place.line == 2);
    CHECK(settings.value("2 * SIZE") == 6);
    files.write("straw.sdl", "define{\n  a[0,1,0,0];\n}\nrules{\n}\ngenerations 3;\n");
    CHECK(ModelSettings::read(files.path("straw.sdl")).value("GENERATIONS") == 3);
}

TEST_CASE("Marks keep places through joining, and are no part of the text", "[language]") {
    using language::marked, language::unmarked, language::without_marks;
    const std::string text = "a " + marked("b" + marked("c\nd", {1, 3, 5}) + "e", {0, 7, 2}) + " f";
    CHECK(without_marks(text) == "a bc\nde f");
    const TranslatedText read = unmarked(text, {"one", "two"});
    CHECK(read.text == "a bc\nde f");
    std::string places;
    for (const auto& [line, column, place] : read.origins) {
        places += fmt::format("{}:{} {}; ", line, column, to_string(place));
    }
    CHECK(places == "1:3 one:7:2; 1:4 two:3:5; 2:2 one:7:2; 2:3 ; ");
    // What only looks like a mark stays.
    CHECK(unmarked("\x01"
                   "9.1.1\x02x\x03",
                   {"one"})
              .text ==
          "\x01"
          "9.1.1\x02x\x03");
}
