#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/picture_file.h"

#include "catch.h"
#include "exchange_plants.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <unistd.h>

using namespace espalier;

namespace {

/// A folder that goes away with the program.
const std::filesystem::path& folder() {
    static const struct Folder {
        Folder() { std::filesystem::create_directories(path); }
        ~Folder() { std::filesystem::remove_all(path); }
        std::filesystem::path path =
            std::filesystem::temp_directory_path() / ("espalier-clover-" + std::to_string(::getpid()));
    } made;
    return made.path;
}

std::filesystem::path written(const std::string& name, const std::string& bytes) {
    write_text(folder() / name, bytes);
    return folder() / name;
}

std::string bytes_of(std::initializer_list<int> values) {
    std::string bytes;
    for (const int value : values) bytes += static_cast<char>(value);
    return bytes;
}

/// 3 x 2 pixels; red is 10 x + y, green 100 + red, blue 200 + red, y counted from below.
int value(int x, int y, int channel) {
    return 100 * channel + 10 * x + y;
}

int wrong_pixels(const std::filesystem::path& path) {
    const Picture image = read_picture(path);
    if (image.width != 3 || image.height != 2) return 6;
    int wrong = 0;
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            for (int channel = 0; channel < 3; ++channel) {
                const int read = image.at((x + 0.5) / 3, (y + 0.5) / 2)[static_cast<std::size_t>(channel)];
                wrong += read != value(x, y, channel);
            }
        }
    }
    return wrong;
}

std::string sgi(bool coded) {
    std::string bytes = bytes_of({1, 218, coded, 1, 0, 3, 0, 3, 0, 2, 0, 3});
    bytes.resize(512);
    std::string rows, starts, lengths;
    for (int channel = 0; channel < 3; ++channel) {
        for (int y = 0; y < 2; ++y) {
            const std::string row = bytes_of({value(0, y, channel), value(1, y, channel), value(2, y, channel)});
            starts += bytes_of({0, 0, 2, 0}).substr(0, 2) +
                      bytes_of({(560 + int(rows.size())) / 256, (560 + int(rows.size())) % 256});
            // One run of a single pixel and two pixels as they are, then the end of the row.
            rows += coded ? bytes_of({1}) + row.substr(0, 1) + bytes_of({130}) + row.substr(1) + bytes_of({0}) : row;
            lengths += bytes_of({0, 0, 0, 6});
        }
    }
    return bytes + (coded ? starts + lengths : "") + rows;
}

std::string targa(bool coded, bool top_first) {
    std::string bytes = bytes_of({2, 0, coded ? 10 : 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 2, 0, 24, top_first ? 32 : 0});
    bytes += "id";
    for (int row = 0; row < 2; ++row) {
        const int y = top_first ? 1 - row : row;
        for (int x = 0; x < 3; ++x) {
            if (coded && x == 0) bytes += bytes_of({2});        // three pixels as they are,
            if (coded && x == 0 && row == 1) bytes.pop_back();  // but
            if (coded && row == 1) bytes += bytes_of({128});    // runs of one in the second row
            bytes += bytes_of({value(x, y, 2), value(x, y, 1), value(x, y, 0)});
        }
    }
    return bytes;
}

std::filesystem::path png() {
    vtkNew<vtkImageData> data;
    data->SetDimensions(3, 2, 1);
    data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    for (int i = 0; i < 18; ++i) {
        data->SetScalarComponentFromDouble(i / 3 % 3, i / 9, 0, i % 3, value(i / 3 % 3, i / 9, i % 3));
    }
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(data);
    writer->SetFileName((folder() / "ground.png").c_str());
    writer->Write();
    return folder() / "ground.png";
}

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

TEST_CASE("pictures of three kinds, plain and coded, show the same pixels from the lowest row up", "[clover]") {
    CHECK(wrong_pixels(written("plain.rgb", sgi(false))) == 0);
    CHECK(wrong_pixels(written("coded.rgb", sgi(true))) == 0);
    CHECK(wrong_pixels(written("plain.tga", targa(false, false))) == 0);
    CHECK(wrong_pixels(written("top.tga", targa(false, true))) == 0);
    CHECK(wrong_pixels(written("coded.tga", targa(true, false))) == 0);
    CHECK(wrong_pixels(png()) == 0);
}

TEST_CASE("pictures that are cut short, huge or none are mistakes that name the file", "[clover]") {
    const auto refused = [](const std::string& name, const std::string& bytes) {
        return message_of([&] { read_picture(written(name, bytes)); });
    };
    for (const std::string& whole : {sgi(false), sgi(true)}) {
        for (std::size_t length = 0; length + 1 < whole.size(); length += 7) {
            CHECK(lacks(refused("cut.rgb", whole.substr(0, length)), {"cut.rgb"}) == "");
        }
    }
    const std::string whole = targa(true, false), good = read_text(png());
    for (std::size_t length = 0; length < whole.size(); ++length) {
        CHECK(lacks(refused("cut.tga", whole.substr(0, length)), {"cut.tga"}) == "");
    }
    for (std::size_t length = 0; length < good.size(); ++length) {
        CHECK(lacks(refused("cut.png", good.substr(0, length)), {"cut.png"}) == "");
    }
    std::string huge = sgi(false);
    for (const std::size_t i : {6u, 7u, 8u, 9u}) huge[i] = static_cast<char>(255);
    CHECK(lacks(refused("huge.rgb", huge), {"cannot be read"}) == "");
    huge = good;
    for (std::size_t i = 16; i < 24; ++i) huge[i] = 127;
    CHECK(lacks(refused("huge.png", huge), {"cannot be read"}) == "");
    CHECK(lacks(refused("ground.gif", "GIF"), {"rgb, tga or png"}) == "");
}

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
    const std::string name = written("plain.rgb", sgi(false)).string();
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
