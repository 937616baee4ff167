// Object folders: which files are taken, and what is said when that is not clear.
#include "espalier/simulation/object.h"

#include "espalier/simulation/world.h"

#include "catch.h"
#include "temporary_folder.h"

#include <algorithm>

using namespace espalier;
using Catch::Contains;

namespace {

const char* const model = "lsystem: 1\nderivation length: 3\naxiom: A\nA --> F[+A]A\nendlsystem\n";

class ObjectFolder {
public:
    ObjectFolder() {
        for (const char* name : {"plant.l", "other.l"}) folder_.write(name, model);
        folder_.write("plant.v", "angle increment: 30\n");
        folder_.write("plant.a", "last frame: 2\n");
        folder_.write("plant.map", std::string(768, '\7'));
        folder_.write("plant.mat", std::string(15, '\7'));
    }
    void menu(const std::string& command) const {
        folder_.write("specifications", "plant.l\nplant.v\n*\nL-system:\n\tgenerate:\n\t\t" + command + "\n");
    }
    ObjectFiles read() const { return read_object_folder(folder_.path()); }
    ObjectFiles read(const std::string& command) const {
        menu(command);
        return read();
    }
    std::string message(const std::string& command) const {
        menu(command);
        return message();
    }
    std::string message() const {
        try {
            read();
        } catch (const UserError& error) {
            return error.what();
        }
        return "no error";
    }
    std::string name_of(const std::filesystem::path& path) const {
        return path.empty() ? "" : path.lexically_relative(folder_.path()).string();
    }
    const TemporaryFolder& folder() const { return folder_; }

private:
    TemporaryFolder folder_;
};

}  // namespace

TEST_CASE_METHOD(ObjectFolder, "the first cpfg command of the menu says which files make the object", "[simulation]") {
    folder().write("specifications",
                   "rmode: triggered\n; a comment\nplant.l\nplant.v\nother.l\nignore:\n*.o\n*\n"
                   "; another\nedit:\n\tL-system:\n\t\tEDIT plant.l\nL-system:\n\tgenerate:\n"
                   "\t\tcpfg -m plant.map -w 300 500 plant.l plant.v plant.a\n\t\tcpfg other.l plant.v\n");
    const ObjectFiles object = read();
    CHECK(name_of(object.model) == "plant.l");
    CHECK(name_of(object.view) == "plant.v");
    CHECK(name_of(object.animation) == "plant.a");
    CHECK(name_of(object.colour_maps.at(1)) == "plant.map");
    CHECK(object.materials.empty());
    CHECK(object.listed == std::vector<std::string>{"plant.l", "plant.v", "other.l"});
    CHECK(object.diagnostics.empty());
    CHECK(unused_files(object) == std::vector<std::string>{"other.l"});
}

TEST_CASE_METHOD(ObjectFolder, "switches stand in any order, and those of the window are ignored", "[simulation]") {
    folder().write("plant.e", "executable: shape\n");
    const ObjectFiles object = read(
        "cpfg -homo -wt title plant.l -e plant.e -rmode expose -wp 1 2 -c3 -M2 plant.mat -a plant.v -wnb -P none "
        "-b 1 -wr .1 .2 plant.a -str out.str  ");
    CHECK(name_of(object.model) == "plant.l");
    CHECK(name_of(object.view) == "plant.v");
    CHECK(name_of(object.animation) == "plant.a");
    CHECK(name_of(object.environment) == "plant.e");
    CHECK(name_of(object.materials.at(2)) == "plant.mat");
    REQUIRE(object.diagnostics.size() == 1);
    CHECK_THAT(object.diagnostics[0].message, Contains("preprocessor"));
}

TEST_CASE_METHOD(ObjectFolder, "of colours and materials the later on the line decides", "[simulation]") {
    CHECK(read("cpfg -M plant.mat -m plant.map plant.l plant.v").materials.empty());
    CHECK(read("cpfg -m plant.map -M plant.mat plant.l plant.v").colour_maps.empty());
    CHECK(read("cpfg -m1 plant.map -m2 plant.map plant.l plant.v").colour_maps.size() == 2);
    CHECK(read("cpfg -m plant.map plant.l plant.v &").diagnostics.empty());
}

TEST_CASE_METHOD(ObjectFolder, "a colour map that is missing is told of and left out", "[simulation]") {
    const ObjectFiles object = read("cpfg -m lost.map plant.l plant.v");
    CHECK(object.colour_maps.empty());
    REQUIRE(object.diagnostics.size() == 1);
    CHECK_THAT(to_string(object.diagnostics[0]), Contains("specifications:6") && Contains("lost.map"));
}

TEST_CASE_METHOD(ObjectFolder, "a file that is missing is an error with the command's line", "[simulation]") {
    for (const char* command : {"cpfg lost.l plant.v", "cpfg plant.l lost.v", "cpfg plant.l plant.v lost.a",
                                "cpfg -e lost.e plant.l plant.v", "cpfg plant.l ext", "cpfg", "cpfg plant.l -m"}) {
        INFO(command);
        std::filesystem::create_directories(folder().path() / "ext");
        CHECK_THAT(message(command), Contains("specifications:6"));
    }
}

TEST_CASE_METHOD(ObjectFolder, "files outside the folder are refused", "[simulation]") {
    for (const char* command : {"cpfg ../plant.l plant.v", "cpfg ext/../../plant.l", "cpfg /etc/passwd plant.v",
                                "cpfg .. plant.v", "cpfg -m ../x.map plant.l plant.v", "cpfg '' plant.v"}) {
        INFO(command);
        CHECK_THAT(message(command), Contains("specifications:6"));
    }
    CHECK(name_of(read("cpfg ./plant.l ext/../plant.v").view) == "plant.v");
}

TEST_CASE_METHOD(ObjectFolder, "an object of lpfg is told apart", "[simulation]") {
    CHECK_THAT(message("lpfg plant.l plant.v"), Contains("specifications:6") && Contains("lpfg"));
    CHECK(name_of(read("lpfg other.l\n\t\tcpfg plant.l plant.v").model) == "plant.l");
}

TEST_CASE_METHOD(ObjectFolder, "without specifications files are recognised by their extensions", "[simulation]") {
    std::filesystem::remove(folder().path() / "other.l");
    std::filesystem::remove(folder().path() / "plant.mat");
    folder().write(".hidden.l", model);
    folder().write("README.txt", "a plant\n");
    folder().write("heights.csv", "day,height\n1,0.2\n");
    const ObjectFiles object = read();
    CHECK(name_of(object.model) == "plant.l");
    CHECK(name_of(object.view) == "plant.v");
    CHECK(name_of(object.animation) == "plant.a");
    CHECK(name_of(object.colour_maps.at(1)) == "plant.map");
    CHECK(object.environment.empty());
}

TEST_CASE_METHOD(ObjectFolder, "the model of an object may be in any notation", "[simulation]") {
    for (const char* name : {"plant.l", "other.l"}) std::filesystem::remove(folder().path() / name);
    folder().write("straw.sdl", "define{ a[0,1,0,0]; } rules{ a -> (a); }\n");
    const ObjectFiles object = read();
    CHECK(name_of(object.model) == "straw.sdl");
    CHECK(name_of(object.view) == "plant.v");
    CHECK(object.arithmetic != Arithmetic::cpfg);
    folder().write("stem.pgraph", "pgraph 1\nHorn stem\ncamera -> stem\n");
    CHECK_THAT(message(), Contains("stem.pgraph, straw.sdl"));
    std::filesystem::remove(folder().path() / "straw.sdl");
    CHECK(name_of(read().model) == "stem.pgraph");
    std::filesystem::remove(folder().path() / "stem.pgraph");
    CHECK_THAT(message(),
               Contains("nor one that ends in .l, .xml, .dgf, .mtg, .opf, .ops, .pgraph, .rparam, .rsml, .sdl"));
}

TEST_CASE_METHOD(ObjectFolder, "a choice that is not clear is an error that names the choices", "[simulation]") {
    CHECK_THAT(message(), Contains("other.l, plant.l"));
    std::filesystem::remove(folder().path() / "other.l");
    CHECK(name_of(read().colour_maps.at(1)) == "plant.map");  // rather than materials
    folder().write("more.map", "");
    CHECK(read().colour_maps.empty());
    CHECK_THAT(read().diagnostics.at(0).message, Contains("more.map, plant.map"));
    folder().write("b.v", "");
    CHECK_THAT(message(), Contains("b.v, plant.v") && Contains("--view"));
    std::filesystem::remove(folder().path() / "plant.l");
    CHECK_THAT(message(), Contains("holds no model"));
}

TEST_CASE_METHOD(ObjectFolder, "a menu without cpfg falls back on the extensions", "[simulation]") {
    std::filesystem::remove(folder().path() / "other.l");
    const ObjectFiles object = read("EDIT plant.l");
    CHECK(name_of(object.model) == "plant.l");
    CHECK_THAT(object.diagnostics.at(0).message, Contains("no command of the menu starts cpfg"));
}

TEST_CASE_METHOD(ObjectFolder, "broken specifications are refused, whatever is in them", "[simulation]") {
    for (const std::string& text :
         {std::string(), std::string("plant.l\nplant.v\n"), std::string("\xff\xfe\0*\n", 5)}) {
        folder().write("specifications", text);
        CHECK_THAT(message(), Contains("specifications") && Contains("'*'"));
    }
    folder().write("specifications", std::string("*\ncpfg \"\0\x80\n", 11));
    CHECK_THAT(message(), Contains("specifications:2"));
    folder().write("specifications", "a\na\n*\n;\n\n\tcpfg plant.l plant.v\n");
    CHECK(read().diagnostics.size() == 1);
}

TEST_CASE_METHOD(ObjectFolder, "an object becomes a scene of one plant that its run.json can repeat", "[simulation]") {
    const Scene scene = scene_of_object(read("cpfg -m plant.map plant.l plant.v plant.a"));
    CHECK(scene.name == folder().path().filename());
    REQUIRE(scene.plants.size() == 1);
    CHECK_FALSE(scene.steps);
    CHECK(scene.last_frame == 2);
    CHECK(scene.environment.keeps_unanswered);
    CHECK(scene.notes.files.size() == 3);
    const Scene again = read_scene_text(scene.text, "again", {});
    CHECK(again.last_frame == 2);
    CHECK(again.plants[0].view != nullptr);
    CHECK(World(scene).last_step() == 2);
    CHECK(Derivation(scene.plants[0].model).length() == 3);
}

TEST_CASE_METHOD(ObjectFolder, "steps given by hand are the derivation length and the last frame", "[simulation]") {
    SceneOptions options;
    options.steps = 5;
    const Scene scene = scene_of_object(read("cpfg plant.l plant.v plant.a"), options);
    CHECK(scene.steps == 5);
    CHECK_FALSE(scene.last_frame);
    World world(scene);
    CHECK(world.last_step() == 5);
}

TEST_CASE_METHOD(ObjectFolder, "an animation may end before or after the derivation length, which it leaves alone",
                 "[simulation]") {
    folder().write("counting.l",
                   "lsystem: 1\nderivation length: 3\naxiom: A(0,0)\nEnd: { e = 1; }\n"
                   "A(n,m) --> A(Z,e)\nendlsystem\n");
    folder().write("plant.a", "last frame: 5\n");
    World world(scene_of_object(read("cpfg counting.l plant.v plant.a")));
    world.start();
    while (world.steps_done() < world.last_step()) world.step();
    CHECK(world.steps_done() == 5);
    CHECK(to_text(world.string(0), world.model(0).alphabet) == "A(3,1)");

    folder().write("plant.a", "first frame: 7\nlast frame: -1\n");
    CHECK(World(scene_of_object(read("cpfg counting.l plant.v plant.a"))).last_step() == 7);
}
