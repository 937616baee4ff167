// Virtual scans against geometry that is known.
#include "study/scan/scan.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/random.h"

#include "catch.h"
#include "study/fit/growth.h"
#include "study/scan/leaf_density.h"
#include "study/scan/point_files.h"
#include "temporary_folder.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tbb/task_arena.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <sstream>

using namespace espalier;
using namespace espalier::study;
using Catch::Contains;

namespace {

/// What an axiom draws.
FrameGeometry drawn(const std::string& axiom) {
    const TemporaryFolder folder;
    write_text(folder.path() / "model.l", "lsystem: 1\nderivation length: 0\naxiom: " + axiom + "\nendlsystem\n");
    const Growth growth(Subject{folder.path() / "model.l"});
    return *growth.grow(growth.scene({}), 0, {true, false})->geometry;
}

constexpr double edge = 0.1;

/// Square leaves at random in a box of `width` x 1 x `width` m, the foot of the box at height 1.
std::string leaves(int count, double width, bool upright, std::uint64_t seed) {
    std::string axiom;
    RandomSamples samples(RandomKey(seed, 0, Stream::process), 0, 0);
    for (int i = 0; i < count; ++i) {
        const double x = width * samples.uniform(), y = 1 + samples.uniform(), z = width * samples.uniform();
        const std::string turn = upright ? fmt::format("/({})", 360 * samples.uniform()) : "&(90)";
        axiom += fmt::format("[@M({},{},{}){}{{.f({}).+(90)f({}).+(90)f({}).}}]", x, y, z, turn, edge, edge, edge);
    }
    return axiom;
}

/// Parallel beams onto the middle of such a box, as a grid, `angle` degrees from the vertical.
std::vector<Beam> parallel(double width, double angle, int columns) {
    const double tilt = angle * std::numbers::pi / 180;
    const glm::dvec3 down(std::sin(tilt), -std::cos(tilt), 0);
    std::vector<Beam> beams;
    for (int i = 0; i < columns; ++i) {
        for (int k = 0; k < columns; ++k) {
            const glm::dvec3 aim(width * (0.35 + 0.3 * (i + 0.5) / columns), 1.5,
                                 width * (0.35 + 0.3 * (k + 0.5) / columns));
            beams.push_back({aim - 20.0 * down, down});
        }
    }
    return beams;
}

double gap(const ScannedPlants& plants, const std::vector<Beam>& beams) {
    std::size_t free = 0;
    for (const Beam& beam : beams) {
        free += plants.touch(glm::vec3(beam.origin), glm::vec3(beam.direction), 100) ? 0 : 1;
    }
    return static_cast<double>(free) / static_cast<double>(beams.size());
}

/// The distance of a ray to a triangle, or nothing (Moeller & Trumbore 1997), in 64 bits.
std::optional<double> distance_to(const Beam& beam, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 p = glm::cross(beam.direction, c - a), t = beam.origin - a, q = glm::cross(t, b - a);
    const double determinant = glm::dot(b - a, p);
    if (std::abs(determinant) < 1e-14) return std::nullopt;
    const double u = glm::dot(t, p) / determinant, v = glm::dot(beam.direction, q) / determinant;
    const double distance = glm::dot(c - a, q) / determinant;
    if (u < 0 || v < 0 || u + v > 1 || distance <= 0) return std::nullopt;
    return distance;
}

}  // namespace

TEST_CASE("points of a stem lie on its cylinder, as many as it subtends", "[scan]") {
    constexpr double radius = 0.2, away = 5, step = 0.2;
    const ScannedPlants plants(drawn("!(0.4)F(3)"), 64, std::nullopt);
    TripodScanner scanner;
    scanner.place = {away, 1.5, 0};
    scanner.step = step;
    scanner.lowest = -4, scanner.highest = 4;
    const std::vector<ScanPoint> points = scan(plants, scanner.beams(), {});
    for (const ScanPoint& point : points) {
        const double from_axis = std::hypot(point.place.x, point.place.z);
        CHECK(from_axis <= radius + 1e-5);
        CHECK(from_axis >= radius * std::cos(std::numbers::pi / 64) - 1e-5);
        REQUIRE(point.organ == 0);
    }
    const double columns = 2 * std::asin(radius / away) * 180 / std::numbers::pi / step, rows = 8 / step + 1;
    CHECK(static_cast<double>(points.size()) == Approx(columns * rows).epsilon(0.05));
}

TEST_CASE("a scanner that flies sees a level leaf at its height, and the ground beside it", "[scan]") {
    const ScannedPlants plants(drawn("[@M(0,1,0)&(90){.f(1).+(90)f(1).+(90)f(1).}]"), 8, 0);
    FlyingScanner scanner{{-3, 20, 0}, {3, 20, 0}, 400, 8};
    const std::vector<Beam> beams = scanner.beams();
    std::size_t on_leaf = 0;
    for (const ScanPoint& point : scan(plants, beams, {})) {
        CHECK(point.place.y == Approx(point.organ ? 1 : 0).margin(1e-4));
        on_leaf += point.organ ? 1 : 0;
    }
    // Beams lie 20/19 as densely at the leaf's height, across the path.
    CHECK(static_cast<double>(on_leaf) == Approx(400 * 20.0 / 19).epsilon(0.06));
}

TEST_CASE("a depth camera's beams meet its target in the middle of the picture", "[scan]") {
    DepthCamera camera{{0, 2, 10}, {1, 1, -1}, 40, 101, 51};
    const std::vector<Beam> beams = camera.beams();
    REQUIRE(beams.size() == 101 * 51);
    const glm::dvec3 middle = beams[25 * 101 + 50].direction;
    CHECK(glm::distance(middle, glm::normalize(camera.target - camera.eye)) < 1e-12);
    const double top = std::acos(glm::dot(beams[50].direction, middle)) * 180 / std::numbers::pi;
    CHECK(top == Approx(20).epsilon(0.03));
}

TEST_CASE("the gap fraction of random black leaves is exp(-G LAI / cos)", "[scan]") {
    constexpr double width = 8;
    constexpr int count = 5000;
    const double index = count * edge * edge / (width * width);
    const ScannedPlants level(drawn(leaves(count, width, false, 3)), 8, std::nullopt);
    const ScannedPlants upright(drawn(leaves(count, width, true, 4)), 8, std::nullopt);
    // Level leaves: G = cos. Upright ones of all azimuths: G = 2 / pi sin (Ross 1981).
    CHECK(gap(level, parallel(width, 0, 80)) == Approx(std::exp(-index)).margin(0.05));
    CHECK(gap(level, parallel(width, 40, 80)) == Approx(std::exp(-index)).margin(0.05));
    CHECK(gap(upright, parallel(width, 45, 80)) == Approx(std::exp(-index * 2 / std::numbers::pi)).margin(0.05));
    CHECK(gap(upright, parallel(width, 0.001, 40)) > 0.98);
}

TEST_CASE("what beams meet first is what all triangles say, and points lie on their own organ", "[scan]") {
    const ScannedPlants plants(drawn(leaves(300, 2, true, 5) + "[!(0.3)F(2)[+(50)F(1)]]"), 12, std::nullopt);
    TripodScanner scanner;
    scanner.place = {-1, 1.4, 3.5};
    scanner.step = 2;
    const std::vector<Beam> beams = scanner.beams();
    std::size_t met = 0;
    for (const Beam& beam : beams) {
        double nearest = 100;
        std::size_t organ = 0;
        for (std::size_t i = 0; i < plants.organ_of_triangle().size(); ++i) {
            const glm::vec3* const corner = &plants.corners()[3 * i];
            const auto distance = distance_to(beam, corner[0], corner[1], corner[2]);
            if (distance && *distance < nearest) nearest = *distance, organ = plants.organ_of_triangle()[i];
        }
        const auto touch = plants.touch(glm::vec3(beam.origin), glm::vec3(beam.direction), 100);
        if (nearest > 99) continue;  // at an edge 32 bits may still meet it
        ++met;
        REQUIRE(touch);
        CHECK(touch->distance == Approx(nearest).margin(1e-3));
        CHECK(plants.organs()[*touch->organ].identity == plants.organs()[organ].identity);
    }
    CHECK(met > 100);
}

TEST_CASE("a wide beam at an edge returns twice, and noise is as large as it says", "[scan]") {
    const ScannedPlants plants(drawn("[@M(0,3,0)&(90){.f(1).+(90)f(1).+(90)f(1).}]"), 8, 0);
    const std::array beams{Beam{{0, 10, -0.5}, {0, -1, 0}}};
    ScanOptions options;
    options.divergence = 1, options.rays = 64;
    const std::vector<ScanPoint> points = scan(plants, beams, options);
    REQUIRE(points.size() == 2);
    CHECK(points[0].of == 2);
    CHECK(points[0].distance == Approx(7).margin(0.01));
    CHECK(points[1].distance == Approx(10).margin(0.01));
    CHECK(points[0].intensity + points[1].intensity == Approx(1).margin(0.01));
    CHECK_FALSE(points[1].organ);
    ScanOptions noisy;
    noisy.distance_noise = 0.02;
    const std::vector<Beam> many(4000, Beam{{0, 10, 5}, {0, -1, 0}});
    double squares = 0;
    for (const ScanPoint& point : scan(plants, many, noisy)) squares += point.place.y * point.place.y / 4000;
    CHECK(std::sqrt(squares) == Approx(0.02).epsilon(0.05));
}

TEST_CASE("a scan is the same with any number of threads", "[scan]") {
    const ScannedPlants plants(drawn(leaves(500, 3, true, 6)), 8, 0);
    TripodScanner scanner;
    scanner.place = {1, 1, 8};
    scanner.step = 0.5;
    ScanOptions options;
    options.distance_noise = 0.01, options.angle_noise = 0.02, options.divergence = 0.2, options.rays = 5;
    const std::vector<Beam> beams = scanner.beams();
    std::vector<ScanPoint> alone;
    tbb::task_arena(1).execute([&] { alone = scan(plants, beams, options); });
    const std::vector<ScanPoint> together = scan(plants, beams, options);
    REQUIRE(alone.size() == together.size());
    for (std::size_t i = 0; i < alone.size(); ++i) REQUIRE(alone[i].place == together[i].place);
}

TEST_CASE("leaf area comes back from contacts and path lengths", "[scan]") {
    constexpr double width = 6;
    const ScannedPlants plants(drawn(leaves(1500, width, false, 7)), 8, std::nullopt);
    std::vector<Beam> beams;
    for (int i = 0; i < 300; ++i) {
        for (int k = 0; k < 300; ++k)
            beams.push_back({{width * (i + 0.5) / 300, 10, width * (k + 0.5) / 300}, {0, -1, 0}});
    }
    const DensityResult found = leaf_density(plants, beams, 100, 1, 1);  // level leaves under vertical beams: G = 1
    CHECK(found.estimated_area == Approx(found.real_area).epsilon(0.05));
    CHECK(found.real_area + found.unseen_area == Approx(1500 * edge * edge).epsilon(0.02));
    CHECK(found.gap_fraction == Approx(std::exp(-1500 * edge * edge / (width * width))).margin(0.05));
}

TEST_CASE("files of points hold what was scanned", "[scan]") {
    const TemporaryFolder folder;
    const FrameGeometry geometry = drawn("!(0.2)F(2)[+(60)F(1)]");
    const ScannedPlants plants(geometry, 8, 0);
    TripodScanner scanner;
    scanner.place = {3, 1, 3};
    scanner.step = 2;
    const std::vector<ScanPoint> points = scan(plants, scanner.beams(), {});
    const PointNames names{{"plant"}, geometry.symbol_names, 0};
    write_points(points, plants, names, {}, folder.path() / "scan.csv");
    const std::string table = read_text(folder.path() / "scan.csv");
    CHECK(table.starts_with("x,y,z,distance,intensity,return,returns,beam,plant,organ,identity,symbol,order,age\n"));
    CHECK(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')) == points.size() + 1);
    CHECK_THAT(table, Contains(",plant,0,") && Contains(",ground,-1,"));
    write_points(points, plants, names, {{}, 'z'}, folder.path() / "scan.ply");
    const vtkNew<vtkPLYReader> reader;
    reader->SetFileName((folder.path() / "scan.ply").c_str());
    reader->Update();
    CHECK(reader->GetOutput()->GetNumberOfPoints() == static_cast<vtkIdType>(points.size()));
    double last[3];
    reader->GetOutput()->GetPoint(static_cast<vtkIdType>(points.size() - 1), last);
    CHECK(last[2] == Approx(points.back().place.y).margin(1e-5));
    write_points(points, plants, names, {{"x", "y", "z", "return"}}, folder.path() / "scan.xyz");
    CHECK_THAT(read_text(folder.path() / "scan.xyz"), !Contains(",") && !Contains("x"));
    write_points(points, plants, names, {}, folder.path() / "scan.vtp");
    CHECK(std::filesystem::file_size(folder.path() / "scan.vtp") > 1000);
    CHECK_THROWS_AS(require_point_file("scan.las", {}), UserError);
    CHECK_THROWS_AS(require_point_file("scan.csv", {{"colour"}}), UserError);
    CHECK_THROWS_AS(require_point_file("scan.ply", {{"identity"}}), UserError);
}

TEST_CASE("a level leaf on the wall of a voxel is in one, and its area comes back", "[scan]") {
    const ScannedPlants plants(drawn("!(0.2)F(1)[@M(0,1,0)&(90){.f(1).+(90)f(1).+(90)f(1).}]"), 8, std::nullopt);
    const FlyingScanner scanner{{-2, 10, 0}, {2, 10, 0}, 400, 15};
    const DensityResult found = leaf_density(plants, scanner.beams(), 100, 0.5, 1);
    CHECK(found.real_area == Approx(1).epsilon(0.01));
    CHECK(found.unseen_area == 0);
    CHECK(found.estimated_area == Approx(1).epsilon(0.1));  // by beams that come nearly from above
}

TEST_CASE("columns of HELIOS++ are eleven numbers, and directions and times are those of the beams", "[scan]") {
    const TemporaryFolder folder;
    const ScannedPlants plants(drawn("[@M(0,1,0)&(90){.f(1).+(90)f(1).+(90)f(1).}]"), 8, 0);
    FlyingScanner scanner{{-1, 20, 0}, {1, 20, 0}, 25, 8};
    ScanOptions options;
    options.pulse_rate = 1000;
    options.divergence = 1, options.rays = 9, options.resolution = 2;  // at the edge leaf and ground are one return
    const std::vector<Beam> beams = scanner.beams();
    const std::vector<ScanPoint> points = scan(plants, beams, options);
    PointFileOptions file;
    file.columns = {"helios++"};
    file.up = 'z';
    write_points(points, plants, {{"leaf"}, {"F"}, 0}, file, folder.path() / "points.xyz");
    std::istringstream lines(text_of(folder.path() / "points.xyz"));
    std::size_t row = 0, mixed = 0;
    for (std::string line; std::getline(lines, line); ++row) {
        std::istringstream cells(line);
        std::vector<double> numbers{std::istream_iterator<double>(cells), {}};
        REQUIRE(numbers.size() == 11);
        REQUIRE(numbers[2] == Approx(points[row].place.y));
        // A metre between leaf and ground is 6.67 ns to and fro.
        const double width = numbers[4] * 0.299792458 / 2;
        REQUIRE(width < 1.02);
        mixed += width > 0.98;
        REQUIRE(numbers[5] == 1);
        REQUIRE(numbers[6] == 1);
        REQUIRE(numbers[10] == Approx(numbers[7] / 1000));
    }
    CHECK(row == points.size());
    CHECK(mixed > 0);
    file = {{"zenith", "azimuth"}, 'y'};
    write_points(points, plants, {{"leaf"}, {"F"}, 0}, file, folder.path() / "angles.xyz");
    std::istringstream angles(text_of(folder.path() / "angles.xyz"));
    row = 0;
    for (double zenith = 0, azimuth = 0; angles >> zenith >> azimuth; ++row) {
        const glm::dvec3& beam = beams[points[row].beam].direction;
        REQUIRE(std::cos(zenith * std::numbers::pi / 180) == Approx(beam.y).margin(1e-6));
        REQUIRE(std::sin(zenith * std::numbers::pi / 180) * std::sin(azimuth * std::numbers::pi / 180) ==
                Approx(beam.x).margin(1e-5));
    }
    CHECK(row == points.size());
}
