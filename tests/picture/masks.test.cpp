// Masks of pictures against shapes whose places are known, and against the pictures that they belong to.
#include "espalier/base/error.h"
#include "espalier/picture/render.h"
#include "espalier/simulation/simulation.h"

#include "picture/pictures.h"
#include "temporary_folder.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <numbers>

using namespace espalier;
using namespace espalier::picture;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

/// What one model draws, as a run.
struct Drawn {
    TemporaryFolder folder;
    std::optional<RecordedRun> run;

    explicit Drawn(const std::string& axiom) {
        Scene scene;
        scene.plants.push_back(plant_of_file(
            folder.write("model.l", "lsystem: 1\nderivation length: 0\naxiom: " + axiom + "\nendlsystem\n"), {}));
        RunOptions options;
        options.output = folder.path() / "run";
        espalier::run(scene, options);
        run.emplace(options.output);
    }

    RenderJob job() const {
        RenderJob job{*run, {&run->frames().back()}, {}, {}, 0, false, false, {320, 240}, {}};
        job.style.shading = job.style.legend = false;
        job.style.background.transparent = true;
        job.masks = true;
        return job;
    }
};

/// The values of an .npy file of this program.
template <class Value>
std::vector<Value> array_of(const fs::path& file, const std::string& type, const std::string& shape) {
    const std::string bytes = text_of(file);
    REQUIRE(bytes.starts_with("\x93NUMPY\x01"));
    const std::size_t head = 10 + static_cast<unsigned char>(bytes[8]) +
                             256 * static_cast<std::size_t>(static_cast<unsigned char>(bytes[9]));
    CHECK(head % 64 == 0);
    CHECK_THAT(bytes.substr(10, head - 10), Contains("'descr': '" + type + "'") && Contains("'shape': " + shape));
    std::vector<Value> values((bytes.size() - head) / sizeof(Value));
    std::memcpy(values.data(), bytes.data() + head, values.size() * sizeof(Value));
    return values;
}

/// The files beside a picture.
struct Masks {
    std::size_t width = 320;
    std::vector<float> depths, normals;
    std::vector<std::int32_t> organs;
    glm::dmat3 turn;  ///< its rows are the axes of the camera
    glm::dvec3 shift;
    double scale, middle_x, middle_y;
    bool is_parallel;

    explicit Masks(const fs::path& picture) {
        const std::string name = (picture.parent_path() / picture.stem()).string();
        depths = array_of<float>(name + "-depth.npy", "<f4", "(240, 320,)");
        normals = array_of<float>(name + "-normal.npy", "<f4", "(240, 320, 3,)");
        organs = array_of<std::int32_t>(name + "-organ.npy", "<i4", "(240, 320,)");
        const auto json = nlohmann::json::parse(text_of(name + "-camera.json"));
        scale = json["K"][0][0], middle_x = json["K"][0][2], middle_y = json["K"][1][2];
        CHECK(json["K"][1][1] == json["K"][0][0]);
        is_parallel = json["projection"] == "parallel";
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column) turn[column][row] = json["world_to_camera"][row][column];
            shift[row] = json["world_to_camera"][row][3];
        }
    }
    /// Where in the run the middle of a pixel lies.
    glm::dvec3 place(std::size_t pixel) const {
        const double depth = depths[pixel];
        const double x = (static_cast<double>(pixel % width) - middle_x) / scale;
        const double y = (static_cast<double>(pixel / width) - middle_y) / scale;
        const double by = is_parallel ? 1 : depth;
        return glm::transpose(turn) * (glm::dvec3(x * by, y * by, depth) - shift);
    }
    glm::dvec3 normal(std::size_t pixel) const {
        return {normals[3 * pixel], normals[3 * pixel + 1], normals[3 * pixel + 2]};
    }
    /// Whether all pixels around show the same organ: there the middle of the pixel is on it.
    bool is_inside(std::size_t pixel) const {
        const std::size_t x = pixel % width, y = pixel / width;
        if (x == 0 || y == 0 || x + 1 == width || y + 1 == organs.size() / width) return false;
        for (const std::size_t row : {pixel - width, pixel, pixel + width}) {
            for (const std::size_t other : {row - 1, row, row + 1}) {
                if (organs[other] != organs[pixel] || (depths[other] > 0) != (depths[pixel] > 0)) return false;
            }
        }
        return true;
    }
};

}  // namespace

TEST_CASE("masks: pixels of a cylinder, a sphere and a plane lie where these are", "[pictures][masks]") {
    if (!can_draw()) return;
    const Drawn drawn("!(0.6)F(3)[@M(2,1,1)@O(1.6)][@M(-1,0,-1){.f(2).+(90)f(1.5).+(90)f(2).}]");
    RenderJob job = drawn.job();
    job.camera.is_parallel = GENERATE(false, true);
    job.camera.azimuth = GENERATE(0.0, 37.0);
    job.camera.elevation = 20;
    const auto files = render_pictures(job, drawn.folder.path() / "picture.png");
    CHECK(files.size() == 8);
    const Masks masks(files.front());
    std::array<std::size_t, 3> seen{};
    for (std::size_t pixel = 0; pixel < masks.organs.size(); ++pixel) {
        if (masks.organs[pixel] < 0) {
            REQUIRE(masks.depths[pixel] == 0);
            REQUIRE(masks.normal(pixel) == glm::dvec3(0));
            continue;
        }
        ++seen[static_cast<std::size_t>(masks.organs[pixel])];
        if (!masks.is_inside(pixel)) continue;
        const glm::dvec3 place = masks.place(pixel), normal = masks.normal(pixel);
        REQUIRE(glm::length(normal) == Approx(1));
        REQUIRE(glm::dot(masks.turn * normal, glm::dvec3(0, 0, 1)) < 0.2);  // towards the camera
        // Round things are drawn with facets whose corners lie on them.
        if (masks.organs[pixel] == 0 && place.y > 0.01 && place.y < 2.99) {
            const double from_axis = std::hypot(place.x, place.z);
            REQUIRE(from_axis == Approx(0.3).epsilon(0.04));
            REQUIRE(normal.x == Approx(place.x / from_axis).margin(0.15));
            REQUIRE(normal.y == Approx(0).margin(0.02));
        } else if (masks.organs[pixel] == 2) {
            const glm::dvec3 off = place - glm::dvec3(2, 1, 1);
            REQUIRE(glm::length(off) < 0.8 + 1e-4);
            REQUIRE(glm::length(off) > 0.8 * std::pow(std::cos(std::numbers::pi / 8), 2));
            REQUIRE(glm::dot(off, normal) / glm::length(off) > 0.97);
        } else if (masks.organs[pixel] == 1) {
            REQUIRE(place.z == Approx(-1).margin(1e-4));
            REQUIRE(std::abs(normal.z) == Approx(1));
        }
    }
    for (const std::size_t pixels : seen) CHECK(pixels > 500);
    // The plane is 1.5 m x 2 m, or what the cylinder leaves of it.
    if (job.camera.azimuth == 0 && job.camera.is_parallel) {
        const double shortened = std::cos(20 * std::numbers::pi / 180);
        CHECK(static_cast<double>(seen[1]) <= 1.01 * 3 * masks.scale * masks.scale * shortened);
        CHECK(static_cast<double>(seen[1]) >= 0.7 * 3 * masks.scale * masks.scale * shortened);
    }
}

TEST_CASE("masks: what is in the picture has an organ, and nothing else", "[pictures][masks]") {
    if (!can_draw()) return;
    std::string axiom = "!(0.2)F(1)";
    for (int i = 0; i < 60; ++i)
        axiom += "[/(" + std::to_string(137 * i) + ")&(" + std::to_string(30 + i) +
                 ")!(0.01)F(1){.f(.3).+(40)f(.2).+(140)f(.3).}]F(0.03)";
    const Drawn drawn(axiom);
    RenderJob job = drawn.job();
    job.camera.azimuth = GENERATE(10.0, 200.0);
    job.style.title = "a plant";  // moves the plant in the picture
    const auto files = render_pictures(job, drawn.folder.path() / "picture.png");
    job.style.title.clear();
    const Masks masks(files.front());
    const auto image = read_png(files.front());
    std::size_t shown = 0, different = 0;
    for (std::size_t pixel = 0; pixel < masks.organs.size(); ++pixel) {
        const auto x = static_cast<int>(pixel % masks.width), row = static_cast<int>(pixel / masks.width);
        if (row < 30) continue;  // the title
        const int opacity = pixel_at(*image, x, 239 - row)[3];
        const bool has_organ = masks.organs[pixel] >= 0;
        if (opacity == 255) REQUIRE(has_organ);
        if (opacity == 0) REQUIRE_FALSE(has_organ);
        shown += has_organ;
        different += has_organ != (opacity >= 128);
    }
    CHECK(shown > 3000);
    // Graphics cards count places within a pixel in 256ths: now and then an edge falls to the other side of a sample.
    CHECK(different <= shown / 500);
}

TEST_CASE("masks: the ground has a depth and no organ, and the table counts the pixels of each", "[pictures][masks]") {
    if (!can_draw()) return;
    const Drawn drawn("!(0.4)F(2)[@M(1,1,0)@O(0.5)]");
    RenderJob job = drawn.job();
    job.ground = true;
    job.camera.elevation = 25;
    const auto files = render_pictures(job, drawn.folder.path() / "picture.png");
    const Masks masks(files.front());
    std::size_t ground = 0;
    std::array<std::size_t, 2> pixels{};
    for (std::size_t pixel = 0; pixel < masks.organs.size(); ++pixel) {
        if (masks.organs[pixel] >= 0) ++pixels[static_cast<std::size_t>(masks.organs[pixel])];
        if (masks.organs[pixel] >= 0 || masks.depths[pixel] == 0) continue;
        ++ground;
        CHECK(masks.normal(pixel) == glm::dvec3(0, 1, 0));
        if (masks.is_inside(pixel)) REQUIRE(masks.place(pixel).y == Approx(0).margin(1e-3));
    }
    CHECK(ground > 2000);
    const std::string table = text_of(drawn.folder.path() / "picture-organs.csv");
    CHECK_THAT(table, Contains("organ,plant,name,identity,symbol_number,symbol,order,birth,age,leaf,pixels\n0,0,"));
    CHECK_THAT(table, Contains("F,0,0,0,0," + std::to_string(pixels[0]) + "\n") &&
                          Contains(",O,1,0,0,1," + std::to_string(pixels[1]) + "\n"));
}
