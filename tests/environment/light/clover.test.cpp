#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "base/picture_file.h"
#include "catch.h"
#include "environment/exchange/exchange_plants.h"
#include "picture_bytes.h"
#include "temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <unistd.h>

using namespace espalier;
using namespace espalier::environment;

namespace {

const std::string hundred =
    "process = \"clover\"\ngrid_size = [1000, 1000]\ngrid_range = [100, 100]\n"
    "grid_position = [-50, -50]\ntransmittance = 0.5\n";

Environment field(const std::string& lines = "") {
    return environment_of("[light]\n" + hundred + lines);
}

std::vector<double> ask(Environment& environment, const std::vector<Asked>& questions) {
    AskingPlants plants;
    plants.add(questions).exchange(environment);
    return plants.parameters();
}

}  // namespace

TEST_CASE("n leaves over a place leave t^n of its light, and red / 128 comes back beside it", "[clover]") {
    Environment environment = field();
    CHECK(ask(environment, {{{1, 2, 0}, {7}}}) == std::vector<double>{1});
    const double area = std::numbers::pi * 9;
    CHECK(ask(environment, {{{1, 2, 0}, {1, area, 5}}}) == std::vector<double>{0.5, 255 / 128.0, 5});
    CHECK(ask(environment, {{{1, 2, 0}, {1, area}}, {{3.9, 2, 0}, {0, 0}}, {{4.1, 2, 0}, {0, 0}}}) ==
          std::vector<double>{0.25, 255 / 128.0, 0.25, 255 / 128.0, 1, 255 / 128.0});
    CHECK(ask(environment, {{{1, 2, 0}, {2, area}}, {{1, 2, 0}, {-1, area}}})[0] == 1);
    CHECK(ask(environment, {{{60, 0, 0}, {3}}}) == std::vector<double>{0});
}

TEST_CASE("a leaf covers its area", "[clover]") {
    Environment environment = field();
    std::vector<Asked> questions{{{0.03, 0.07, 0}, {1, 100}}};
    for (int i = 0; i < 400; ++i) {
        for (int j = 0; j < 400; ++j) questions.push_back({{(i - 199.5) / 20, (j - 199.5) / 20, 0}, {0}});
    }
    const std::vector<double> light = ask(environment, questions);
    CHECK(static_cast<double>(std::count(light.begin() + 2, light.end(), 0.5)) / 400 == Approx(100).epsilon(0.01));
}

TEST_CASE("leaves stay from step to step and through a checkpoint, unless old ones are removed", "[clover]") {
    Environment keeps = field(), forgets = field("remove_old_leaves = true\n");
    for (Environment* environment : {&keeps, &forgets}) ask(*environment, {{{0, 0, 0}, {1, 4}}});
    std::stringstream saved;
    keeps.save(saved);
    Environment resumed = field();
    resumed.restore(saved);
    for (Environment* environment : {&keeps, &resumed}) {
        CHECK(ask(*environment, {{{0, 0, 0}, {0}}}) == std::vector<double>{0.5});
    }
    CHECK(ask(forgets, {{{0, 0, 0}, {0}}}) == std::vector<double>{1});
}

TEST_CASE("the ground is x and y, or x and z where z is not up", "[clover]") {
    Environment level = field(), upright = field("z_is_up = false\n");
    const std::vector<Asked> questions{{{0, 0, 20}, {1, 4}}, {{0, 20, 0}, {0}}, {{0, 0, 30}, {0}}};
    CHECK(ask(level, questions) == std::vector<double>{0.5, 255 / 128.0, 1, 0.5});
    CHECK(ask(upright, questions) == std::vector<double>{0.5, 255 / 128.0, 1, 1});
}

TEST_CASE("a picture's green is the light, its red the second answer", "[clover]") {
    const TemporaryFolder folder;
    const std::string name = folder.write("plain.rgb", sgi(false)).string();
    Environment environment =
        environment_of("[light]\nprocess = \"clover\"\ngrid_size = [3, 2]\ninput_image = \"" + name + "\"\n");
    CHECK(ask(environment, {{{0.9, 0.9, 0}, {0, 0}}, {{0.1, 0.1, 0}, {0, 0}}}) ==
          std::vector<double>{121 / 255.0, 21 / 128.0, 100 / 255.0, 0});
}

TEST_CASE("the order of the queries changes no answer about the ground", "[clover]") {
    std::vector<Asked> questions;
    for (int i = 0; i < 300; ++i) questions.push_back({{i % 17 - 8.0, i % 13 - 6.0, 0}, {double(i % 3), 5.0}});
    Environment forward = field(), backward = field();
    std::vector<double> first = ask(forward, questions);
    std::reverse(questions.begin(), questions.end());
    std::vector<double> second = ask(backward, questions);
    for (std::size_t i = 0; i < second.size(); i += 2) std::swap(second[i], second[i + 1]);
    std::reverse(second.begin(), second.end());
    CHECK(first == second);
}

TEST_CASE(
    "with the numbers of cpfg, leaves lie over all cells that they touch, come and go in string order, and get no "
    "answer",
    "[clover]") {
    const std::string grid = "process = \"clover\"\ngrid_size = [9, 7]\ngrid_range = [9, 7]\ntransmittance = 0.5\n";
    const std::vector<Asked> leaves{{{2.6, 3.3, 0}, {2, 3}},
                                    {{2.6, 3.3, 0}, {1, 3}},
                                    {{7, 5, 0}, {1, 2}},
                                    {{7, 5, 0}, {2, 2}},
                                    {{7.5, 2, 0}, {1, 0.01}}};
    std::vector<Asked> questions = leaves;
    std::vector<double> expected{2, 3, 1, 3, 1, 2, 2, 2, 1, 0.01};
    for (int j = 0; j < 7; ++j) {
        for (int i = 0; i < 9; ++i) {
            questions.push_back({{i + 0.5, j + 0.5, 0}, {0}});
            double light = 1;
            for (std::size_t k = 0; k < leaves.size(); ++k) {
                if (k == 0 || k == 2 || k == 3) continue;  // one goes before it came, one comes and goes
                const glm::dvec3& at = leaves[k].position;
                const double across = at.x - std::clamp(at.x, i + 0.03, i + 0.97);
                const double along = at.y - std::clamp(at.y, j + 0.03, j + 0.97);
                const bool touches = across * across + along * along <= leaves[k].parameters[1] / std::numbers::pi;
                if (touches) light /= 2;
            }
            expected.push_back(light);
        }
    }
    Environment as_cpfg = environment_of("[light]\n" + grid + "numbers = \"cpfg\"\n");
    CHECK(ask(as_cpfg, questions) == expected);
    Environment ours = environment_of("[light]\n" + grid);
    const std::vector<double> exact = ask(ours, questions);
    CHECK(std::count(exact.begin() + 10, exact.end(), 1) > std::count(expected.begin() + 10, expected.end(), 1));
    CHECK(exact[0] == 1);
}

TEST_CASE("with the numbers of cpfg, a leaf leaves out a cell that it touches by 0.02 of its width", "[clover]") {
    Environment environment = environment_of(
        "[light]\nprocess = \"clover\"\nnumbers = \"cpfg\"\ngrid_size = [100, 100]\ngrid_range = [100, 100]\n"
        "transmittance = 0.5\n");
    const double area = std::numbers::pi * 2.670 * 2.670;
    const std::vector<double> light = ask(environment, {{{51.352, 8.032, 0}, {1, area}},
                                                        {{54.5, 8.5, 0}, {0}},
                                                        {{53.5, 8.5, 0}, {0}},
                                                        {{48.5, 8.5, 0}, {0}},
                                                        {{47.5, 8.5, 0}, {0}}});
    CHECK(std::vector<double>(light.begin() + 2, light.end()) == std::vector<double>{1, 0.5, 0.5, 1});
}

TEST_CASE("with the numbers of cpfg, the picture is stretched from corner cell to corner cell", "[clover]") {
    const TemporaryFolder folder;
    const std::string name = folder.write("plain.rgb", sgi(false)).string();  // 3 x 2 pixels
    const Picture picture = read_picture(name);
    Environment environment = environment_of(
        "[light]\nprocess = \"clover\"\ngrid_size = [5, 3]\nnumbers = \"cpfg\"\ninput_image = \"" + name + "\"\n");
    const int column[] = {0, 0, 1, 1, 2}, row[] = {0, 0, 1};
    std::vector<Asked> questions;
    std::vector<double> expected;
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 5; ++i) {
            questions.push_back({{(i + 0.5) / 5, (j + 0.5) / 3, 0}, {0}});
            expected.push_back(picture.pixels[std::size_t(row[j] * 3 + column[i])][1] / 255.0);
        }
    }
    CHECK(ask(environment, questions) == expected);
}

TEST_CASE("with the numbers of cpfg, there is no red without a picture", "[clover]") {
    Environment white = environment_of("[light]\nprocess = \"clover\"\nnumbers = \"cpfg\"\n");
    CHECK(ask(white, {{{0.5, 0.5, 0}, {0, 3}}}) == std::vector<double>{1, 0});
    const TemporaryFolder folder;
    const std::string name = folder.write("plain.rgb", sgi(false)).string();
    Environment environment = environment_of(
        "[light]\nprocess = \"clover\"\ngrid_size = [3, 2]\nnumbers = \"cpfg\"\ninput_image = \"" + name + "\"\n");
    CHECK(ask(environment, {{{0.9, 0.9, 0}, {0, 0}}})[1] == 21 / 128.0);
}

TEST_CASE("a file of parameters asks for the numbers of cpfg, and a scene may ask for the exact ones", "[clover]") {
    const TemporaryFolder folder;
    const std::string file = folder.write("clover.spec", "grid size: 9x7\ngrid range: 9 7\n").string();
    const std::vector<Asked> leaf{{{2.6, 3.3, 0}, {1, 3}}};
    Environment as_cpfg = environment_of("[light]\nprocess = \"clover\"\nparameters = \"" + file + "\"\n");
    CHECK(ask(as_cpfg, leaf) == std::vector<double>{1, 3});
    Environment ours =
        environment_of("[light]\nprocess = \"clover\"\nnumbers = \"exact\"\nparameters = \"" + file + "\"\n");
    CHECK(ask(ours, leaf) == std::vector<double>{0.6, 255 / 128.0});
}

TEST_CASE("a grid larger than memory is a mistake", "[clover]") {
    EnvironmentContext context;
    context.memory = 1000;
    const auto grid = [&](const std::string& size) {
        return message_of([&] { environment_of("[light]\nprocess = \"clover\"\ngrid_size = " + size, context); });
    };
    CHECK(lacks(grid("[100, 100]"), {"100 x 100 cells", "memory"}) == "");
    CHECK(lacks(grid("[1e9, 1e9]"), {"memory"}) == "");
    CHECK(lacks(grid("[0, 4]"), {"grid_size", "at least 1"}) == "");
}

TEST_CASE("ornaments count the discs over each place, their own among them", "[ornament]") {
    Environment environment =
        environment_of("[light]\nprocess = \"ornament\"\ngrid_size = [100, 100]\ngrid_range = [10, 10]\n");
    const std::vector<Asked> questions{
        {{2, 2, 0}, {0, 1}}, {{3.5, 2, 0}, {0, 1}}, {{2.7, 2, 0}, {0}}, {{9, 9, 9}, {5}}};
    CHECK(ask(environment, questions) == std::vector<double>{1, 1, 1, 1, 2, 0});
    CHECK(ask(environment, questions) == std::vector<double>{1, 1, 1, 1, 2, 0});
}
