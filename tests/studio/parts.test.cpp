#include "espalier/simulation/world.h"

#include "catch.h"
#include "studio/document/written_numbers.h"
#include "studio/growth/kept_steps.h"
#include "studio/server/access.h"
#include "studio/server/page_files.h"
#include "temporary_folder.h"

using namespace espalier::studio;

TEST_CASE("only this machine under its own names and the port of the studio is a host", "[studio]") {
    for (const char* host : {"127.0.0.1:8700", "localhost:8700"}) {
        INFO(host);
        CHECK(is_own_host(host, 8700));
        CHECK_FALSE(is_own_host(host, 8701));
    }
    for (const char* host :
         {"", "localhost", "127.0.0.1", "[::1]:8700", "evil.example:8700", "127.0.0.1.evil.example:8700",
          "localhost:87x", "localhost:", "localhost:08700", "127.0.0.2:8700", "user@localhost:8700"}) {
        INFO(host);
        CHECK_FALSE(is_own_host(host, 8700));
    }
}

TEST_CASE("only pages of the studio may open its socket", "[studio]") {
    CHECK(is_own_origin("http://localhost:8700", "localhost:8700"));
    CHECK_FALSE(is_own_origin("", "localhost:8700"));
    CHECK_FALSE(is_own_origin("null", "localhost:8700"));
    CHECK_FALSE(is_own_origin("http://localhost:8701", "localhost:8700"));
    CHECK_FALSE(is_own_origin("https://localhost:8700", "localhost:8700"));
    CHECK_FALSE(is_own_origin("https://evil.example", "localhost:8700"));
}

TEST_CASE("tokens are long and never the same", "[studio]") {
    const std::string token = new_token();
    CHECK(token.size() == 32);
    CHECK(token != new_token());
    CHECK(is_token(token, token));
    CHECK_FALSE(is_token("", token));
    CHECK_FALSE(is_token(token.substr(1), token));
}

TEST_CASE("the numbers of a scene file are found where they are written", "[studio]") {
    const std::string scene = R"(# two plants
[simulation]
steps = 20
[environment.light]
process = "voxel-shade"
voxel = 0.5   # metres
depth = -3
on = true
[[plant]]
model = "a.l"
position = [1, 2, 3]
[[plant]]
model = "b.l"
define = { HEIGHT = 1e1 }
positions = [
    [0, 0, 0],
    [1.5, 0, -2],
]
[[plant]]
model = "c.l"
position = ["= A", 0, 0]
)";
    const std::vector<WrittenNumber> numbers = written_numbers("scene.toml", scene);
    std::vector<std::string> names;
    for (const WrittenNumber& number : numbers) {
        names.push_back(number.name);
        CHECK(scene.substr(number.offset, number.text.size()) == number.text);
    }
    REQUIRE(names == std::vector<std::string>{"simulation.steps", "environment.light.voxel", "environment.light.depth",
                                              "environment.light.on", "plant.0.position.x", "plant.0.position.y",
                                              "plant.0.position.z", "plant.1.define.HEIGHT", "plant.1.positions.0.x",
                                              "plant.1.positions.0.y", "plant.1.positions.0.z", "plant.1.positions.1.x",
                                              "plant.1.positions.1.y", "plant.1.positions.1.z"});
    CHECK(numbers[0].whole);
    CHECK(numbers[1].label == "metres");
    CHECK_FALSE(numbers[1].whole);
    CHECK(numbers[2].value == -3);
    CHECK(numbers[3].is_switch);
    CHECK(numbers[6].label == "z of the position");
    CHECK(numbers[6].unit == "m");
    CHECK(numbers[7].value == 10);
    CHECK(numbers[13].value == -2);
    CHECK(numbers[13].label == "z of position 2");
    CHECK(numbers[1].group == "environment, light");
    CHECK(numbers[7].group == "plant 2, define");
    CHECK(with_number(scene, numbers[1], "0.25").find("voxel = 0.25   # metres") != std::string::npos);
}

TEST_CASE("macros that are not plain numbers are no settings", "[studio]") {
    const std::string model = R"(#define A 2  /* width; 1..3; m */
#define B (A * 2)
#define C -.5e1  // bend
#define D 3 4
#define SUM(x) x
lsystem: 1
derivation length: 1
axiom: F(A + B + C)
endlsystem
)";
    const std::vector<WrittenNumber> numbers = written_numbers("a.l", model);
    REQUIRE(numbers.size() == 2);
    CHECK(numbers[0].highest == 3);
    CHECK(numbers[1].name == "C");
    CHECK(numbers[1].value == -5);
    CHECK(numbers[1].label == "bend");
}

TEST_CASE("macros of plain numbers have the labels of their comments", "[studio]") {
    const std::string model =
        "#define A 2.\t/* a */\r\n  #define\tB  +.5E-2//half\n#define C 3 // \n#define D 4/**/\n"
        "#define E 1e\n#define F 1 + /* sum */ 2\n#define G .\n#define H 5m\n"
        "lsystem: 1\naxiom: F(A+B+C+D)\nendlsystem\n";
    const std::vector<WrittenNumber> numbers = written_numbers("a.l", model);
    std::vector<std::string> labels;
    for (const WrittenNumber& number : numbers) labels.push_back(number.name + "=" + number.text + " " + number.label);
    CHECK(labels == std::vector<std::string>{"A=2. a", "B=+.5E-2 half", "C=3 C", "D=4 D"});
    REQUIRE(numbers.size() == 4);
    CHECK(numbers[1].value == 0.005);
    CHECK(numbers[1].offset == model.find("+.5E-2"));
}

TEST_CASE("steps that do not fit into memory are the same from a file", "[studio]") {
    const TemporaryFolder folder;
    espalier::Scene scene;
    scene.plants.push_back(
        espalier::plant_of_text("lsystem: 1\nderivation length: 6\naxiom: A\nA --> F(1)[+A]A\n"
                                "endlsystem\n"));
    espalier::World world(scene);
    KeptSteps roomy(1, folder.path() / "a"), tight(1, folder.path() / "b", 500);
    world.start();
    for (int step = 0; step <= 6; ++step) {
        roomy.add(world.frame());
        tight.add(world.frame());
        if (step < 6) world.step();
    }
    CHECK_FALSE(std::filesystem::exists(folder.path() / "a"));
    CHECK(std::filesystem::exists(folder.path() / "b"));
    for (int step = 0; step <= 6; ++step) {
        CHECK(roomy.packet(step) == tight.packet(step));
        const LimbAxes here = roomy.limb_axes(step), there = tight.limb_axes(step);
        CHECK(here.geometry.points == there.geometry.points);
        CHECK(here.geometry.lines.offsets == there.geometry.lines.offsets);
        CHECK(here.modules == there.modules);
        const espalier::ModuleString a = roomy.string(step, 0), b = tight.string(step, 0);
        CHECK(a.letters == b.letters);
        CHECK(a.parameters == b.parameters);
        CHECK(a.identity(a.size() - 1) == b.identity(b.size() - 1));
    }
    CHECK_FALSE(tight.has(7));
}

TEST_CASE("an axis goes on behind its branches, until it begins anew elsewhere", "[studio]") {
    const TemporaryFolder folder;
    espalier::Scene scene;
    for (const char* axiom : {"F(1)[+F(1)F(1)]F(1)f(1)F(1)", "F(2)"}) {
        scene.plants.push_back(espalier::plant_of_text(std::string("lsystem: 1\nderivation length: 0\naxiom: ") +
                                                       axiom + "\nendlsystem\n"));
    }
    espalier::World world(scene);
    KeptSteps steps(1, folder.path() / "steps");
    world.start();
    steps.add(world.frame());
    const LimbAxes axes = steps.limb_axes(0);
    // The trunk, its branch, the axis behind the gap, and the second plant.
    CHECK(axes.geometry.lines.offsets == espalier::Column<std::int32_t>{0, 3, 6, 8, 10});
    CHECK(axes.geometry.of_cells.plants == espalier::Column<std::uint32_t>{0, 0, 0, 1});
    CHECK(axes.geometry.of_cells.orders == espalier::Column<std::uint16_t>{0, 1, 0, 0});
    CHECK(axes.geometry.points[7].y == 4);
    CHECK(axes.modules == std::vector<std::uint32_t>{0, 0, 6, 3, 3, 4, 8, 8, 9, 9});
}

TEST_CASE("the page is part of the program", "[studio]") {
    REQUIRE(page_file("/"));
    CHECK(page_file("/")->bytes.find("studio.js") != std::string_view::npos);
    CHECK(page_file("/studio.js")->bytes.size() > 100000);
    CHECK(page_file("/LICENSES.txt")->bytes.find("MIT") != std::string_view::npos);
    CHECK_FALSE(page_file("/../etc/passwd"));
}
