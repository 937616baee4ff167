// Plants from components: where components place what follows them, what they draw, and the library's p-graphs.
#include "espalier/base/file.h"
#include "espalier/language/notation.h"
#include "espalier/simulation/world.h"

#include "catch.h"
#include "experiments/growth.h"
#include "geometry/mesh_checks.h"
#include "language/pgraph/curve.h"
#include "language/pgraph/graph.h"
#include "language/pgraph/translation.h"
#include "models/measure.h"

#include <fmt/format.h>
#include <glm/matrix.hpp>

#include <array>
#include <map>
#include <set>

using namespace espalier;

namespace {

constexpr double golden_divergence = 137.50776405003785;
const glm::dvec3 heading{0, 1, 0};

/// What a graph of a few lines draws at the end.
PlantGeometry drawn(const std::string& lines) {
    const auto text = registered<NotationType>().at("pgraph")->translate("pgraph 1\n" + lines, "plant.pgraph").text;
    const std::shared_ptr<const Model> model = read_model_text(text, "plant");
    Derivation derivation(compile(model), {});
    ModuleString string, next;
    derivation.start(string);
    for (int k = 0; k < static_cast<int>(derivation.length()); ++k) {
        derivation.step(string, next);
        std::swap(string, next);
    }
    return interpret(*model, string, {}, &derivation).geometry;
}

/// The poses of small spheres that a component places.
std::vector<Pose> placed(const std::string& component) {
    std::vector<Pose> poses;
    const PlantGeometry geometry =
        drawn(component + "Simple dot\n  shape sphere\n  radius 0.01\ncamera -> many -> dot\n");
    for (const Organ& organ : geometry.organs) poses.push_back(organ.pose);
    return poses;
}

double azimuth(const glm::dvec3& direction) {
    return std::atan2(direction.z, direction.x) * 180 / std::numbers::pi;
}

/// Degrees from one azimuth on to the next, 0 to 360.
double onward(double from, double to) {
    return std::fmod(to - from + 720, 360);
}

/// The volume inside closed triangles.
double volume_of(const DrawnMesh& mesh) {
    double volume = 0;
    for (std::size_t k = 0; k + 2 < mesh.triangles.size(); k += 3) {
        const auto corner = [&](std::size_t i) { return mesh.vertices[mesh.triangles[k + i]].position; };
        volume += glm::dot(corner(0), glm::cross(corner(1), corner(2))) / 6;
    }
    return volume;
}

double volume_of_polygons(const PlantGeometry& geometry) {
    double volume = 0;
    for (const Polygon& polygon : geometry.polygons) {
        for (std::uint32_t k = 1; k + 1 < polygon.count; ++k) {
            const auto corner = [&](std::uint32_t i) { return geometry.vertices[polygon.first + i]; };
            volume += glm::dot(corner(0), glm::cross(corner(k), corner(k + 1))) / 6;
        }
    }
    return volume;
}

/// Vertices less edges plus faces, where vertices in one place are one.
int euler_characteristic(const DrawnMesh& mesh) {
    using Place = std::array<long, 3>;
    const auto place = [&](std::uint32_t vertex) {
        const glm::dvec3 at = mesh.vertices[vertex].position * 1e7;
        return Place{std::lround(at.x), std::lround(at.y), std::lround(at.z)};
    };
    std::set<Place> corners;
    std::set<std::pair<Place, Place>> edges;
    int faces = 0;
    for (std::size_t k = 0; k + 2 < mesh.triangles.size(); k += 3) {
        const Place a = place(mesh.triangles[k]), b = place(mesh.triangles[k + 1]), c = place(mesh.triangles[k + 2]);
        if (a == b || b == c || c == a) continue;
        ++faces;
        for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
            corners.insert(from);
            edges.insert(std::minmax(from, to));
        }
    }
    return static_cast<int>(corners.size()) - static_cast<int>(edges.size()) + faces;
}

LonePlant grown_model(const std::string& name, Defines defines = {}) {
    LonePlant plant(fmt::format("models/pgraph/{}.pgraph", name), std::move(defines));
    plant.grow(static_cast<int>(plant.derivation.length()));
    return plant;
}

}  // namespace

TEST_CASE("Hydra: directions at equal angles about the axis", "[pgraph]") {
    const std::vector<Pose> poses = placed("Hydra many\n  count 18\n  angle 70\n");
    REQUIRE(poses.size() == 18);
    for (std::size_t i = 0; i < 18; ++i) {
        CHECK(degrees_between(poses[i].heading, heading) == Approx(70));
        const double step = onward(azimuth(poses[i].heading), azimuth(poses[(i + 1) % 18].heading));
        CHECK(std::min(step, 360 - step) == Approx(20));
    }
}

TEST_CASE("Ring: places on a circle about the axis, which they look along", "[pgraph]") {
    const std::vector<Pose> poses = placed("Ring many\n  count 12\n  radius 3\n");
    REQUIRE(poses.size() == 12);
    for (std::size_t i = 0; i < 12; ++i) {
        CHECK(glm::length(poses[i].position) == Approx(3));
        CHECK(std::abs(poses[i].position.y) < 1e-9);
        CHECK(glm::distance(poses[i].heading, heading) < 1e-9);
        CHECK(degrees_between(poses[i].position, poses[(i + 1) % 12].position) == Approx(30));
    }
}

TEST_CASE("Phiball: the golden angle from one to the next, as many in every band of equal area, none near another",
          "[pgraph]") {
    const std::vector<Pose> poses = placed("Phiball many\n  count 400\n  radius 2\n");
    REQUIRE(poses.size() == 400);
    std::map<int, int> bands;
    double nearest_sum = 0, smallest = 9;
    for (std::size_t i = 0; i < 400; ++i) {
        CHECK(glm::length(poses[i].position) == Approx(2));
        CHECK(glm::distance(poses[i].position, poses[i].heading * 2.0) < 1e-9);
        ++bands[static_cast<int>((poses[i].position.y / 2 + 1) * 5)];
        double nearest = 9;
        for (std::size_t j = 0; j < 400; ++j) {
            if (j != i) nearest = std::min(nearest, glm::distance(poses[i].heading, poses[j].heading));
        }
        nearest_sum += nearest;
        smallest = std::min(smallest, nearest);
    }
    CHECK(bands.size() == 10);
    for (const auto& [band, count] : bands) CHECK(count == 40);
    for (std::size_t i = 0; i + 1 < 400; ++i) {
        const double step = onward(azimuth(poses[i].position), azimuth(poses[i + 1].position));
        CHECK(std::min(step, 360 - step) == Approx(golden_divergence).margin(1e-6));
    }
    CHECK(smallest / (nearest_sum / 400) > 0.9);
}

TEST_CASE("Phiball: a section of the sphere has all its children there", "[pgraph]") {
    for (const Pose& pose : placed("Phiball many\n  count 50\n  from 20\n  to 60\n")) {
        const double angle = degrees_between(pose.heading, heading);
        CHECK(angle > 20);
        CHECK(angle < 60);
    }
}

TEST_CASE("Every child has a frame of its own, orthonormal and with the sense of its parent's", "[pgraph]") {
    for (const char* type : {"Hydra", "Ring", "Phiball"}) {
        std::set<double> headings;
        for (const Pose& pose : placed(fmt::format("{} many\n  count 30\n  angle 10 .. 80\n  roll 33\n", type))) {
            const glm::dmat3 frame(pose.left, pose.heading, pose.up);
            const glm::dmat3 product = glm::transpose(frame) * frame;
            for (int k = 0; k < 3; ++k) {
                for (int l = 0; l < 3; ++l) CHECK(std::abs(product[k][l] - (k == l)) < 1e-9);
            }
            CHECK(glm::determinant(frame) == Approx(1).epsilon(1e-9));
            headings.insert(pose.heading.x);
        }
        CHECK(headings.size() == 30);
    }
}

TEST_CASE("Simple: the volumes of a cylinder and a box, and the diameter of a sphere", "[pgraph]") {
    const double pi = std::numbers::pi;
    const Organ sphere = drawn("Simple core\n  shape sphere\n  radius 1.5\ncamera -> core\n").organs.at(0);
    CHECK(sphere.size.x == Approx(3));
    CHECK(sphere.sides == 36);
    CHECK(drawn("Simple core\n  shape sphere\n  sides 64\ncamera -> core\n").organs.at(0).sides == 64);
    const PlantGeometry cylinder = drawn("Simple core\n  shape cylinder\n  radius 0.7\n  length 2\ncamera -> core\n");
    CHECK(volume_of(cylinder.mesh) == Approx(pi * 0.49 * 2).epsilon(0.02));
    const PlantGeometry box = drawn("Simple core\n  shape box\n  length 2\n  width 3\n  depth 0.5\ncamera -> core\n");
    CHECK(box.polygons.size() == 6);
    CHECK(volume_of_polygons(box) == Approx(3));
    const PlantGeometry higher = drawn("Simple core\n  shape box\n  move 5\ncamera -> core\n");
    CHECK(volume_of_polygons(higher) == Approx(1));  // so the lower end looks outwards too
}

TEST_CASE("Horn: the axis turns by the sum of the rotations between pieces, interpolated from end to end", "[pgraph]") {
    const PlantGeometry horn = drawn(
        "Horn stem\n  length 3\n  pieces 5\n  bend 10 .. 20\n  radius 0.3 .. 0.1 then "
        "x\ncamera -> stem\n");
    REQUIRE(horn.internodes.size() == 5);
    const std::array<double, 4> between{10, 10 + 10. / 3, 10 + 20. / 3, 20};
    for (std::size_t k = 0; k + 1 < 5; ++k) {
        CHECK(degrees_between(direction_of(horn.internodes[k]), direction_of(horn.internodes[k + 1])) ==
              Approx(between[k]));
    }
    CHECK(degrees_between(direction_of(horn.internodes[0]), direction_of(horn.internodes[4])) == Approx(60));
    CHECK(length_of(horn.internodes[2]) == Approx(0.6));
    CHECK(horn.internodes[4].tip_radius == Approx(0.1));
}

TEST_CASE("Horn: with sides it is one closed surface", "[pgraph]") {
    const PlantGeometry horn =
        drawn("Horn stem\n  length 3\n  pieces 6\n  bend 5 .. 15\n  radius 0.3 .. 0.05\n  sides 12\ncamera -> stem\n");
    CHECK(euler_characteristic(horn.mesh) == 2);
    CHECK(volume_of(horn.mesh) > 0);
}

TEST_CASE("Tree: straight without tropism, and turned towards the ground the more, the stronger it is", "[pgraph]") {
    const auto end_of = [](double strength) {
        const PlantGeometry tree =
            drawn(fmt::format("Tree stem\n  pitch 60\n  pieces 10\n  gravitropism {}\ncamera -> stem\n", strength));
        return direction_of(tree.internodes.back());
    };
    const glm::dvec3 straight = end_of(0);
    CHECK(degrees_between(straight, heading) == Approx(60));
    double before = straight.y;
    for (const double strength : {0.05, 0.1, 0.2, 0.4}) {
        const double height = end_of(strength).y;
        CHECK(height < before);
        before = height;
    }
    CHECK(end_of(-0.2).y > straight.y);
}

TEST_CASE("Tree: branches stand one above the other along the axis, where the function says", "[pgraph]") {
    const PlantGeometry tree = drawn(
        "Tree stem\n  length 10\n  branches 5\n  at 0.2 .. 1 then x ^ 2\n  angle 90 .. 30\n"
        "  pieces 7\nSimple dot\n  shape sphere\ncamera -> stem -B-> dot\n");
    REQUIRE(tree.organs.size() == 5);
    const std::array<double, 5> parts{0.2, 0.4, 0.6, 0.8, 1};
    for (std::size_t k = 0; k < 5; ++k) {
        CHECK(tree.organs[k].pose.position.y == Approx(10 * parts[k] * parts[k]));
        CHECK(degrees_between(tree.organs[k].pose.heading, heading) == Approx(90 - 15 * double(k)));
    }
    double length = 0;
    for (const Internode& internode : tree.internodes) length += length_of(internode);
    CHECK(length == Approx(10));
}

TEST_CASE("World: tropisms turn to its directions instead", "[pgraph]") {
    const auto end_of = [](const std::string& gravity) {
        const PlantGeometry tree =
            drawn(fmt::format("World wind\n  gravity {}\nTree stem\n  pieces 20\n  gravitropism "
                              "0.3\ncamera -> wind -> stem\n",
                              gravity));
        return direction_of(tree.internodes.back());
    };
    CHECK(glm::dot(end_of("1, 0, 0"), glm::dvec3(1, 0, 0)) > 0.95);
    CHECK(glm::dot(end_of("0, 0, -2"), glm::dvec3(0, 0, -1)) > 0.95);
}

TEST_CASE("World: a field that is the same everywhere gives what the usual gravity gives", "[pgraph]") {
    const std::string stem = "Tree stem\n  pitch 50\n  pieces 12\n  gravitropism 0.2\n  phototropism 0.05\n";
    const PlantGeometry usual = drawn(stem + "camera -> stem\n");
    const PlantGeometry same =
        drawn("World world\n  gravity 0 * x, -1, 0\n  light 0, 1 + 0 * y, 0\n" + stem + "camera -> world -> stem\n");
    for (std::size_t k = 0; k < usual.internodes.size(); ++k) {
        CHECK(glm::distance(usual.internodes[k].tip, same.internodes[k].tip) < 1e-12);
    }
}

TEST_CASE("World: a field that turns about the axis curls what grows in it, in its own sense", "[pgraph]") {
    const auto winding = [](const std::string& gravity) {
        const PlantGeometry tree =
            drawn("World whirl\n  gravity " + gravity +
                  "\nTree stem\n  move 1\n  turn -90\n  pieces 60\n  length 6\n  gravitropism 0.3\n"
                  "Simple aside\n  turn -90\n  move 1\ncamera -> whirl -> aside -> stem\n");
        double angle = 0;
        for (const Internode& internode : tree.internodes) {
            angle += glm::cross(internode.base, internode.tip).y > 0 ? 1 : -1;
        }
        return angle / double(tree.internodes.size());
    };
    CHECK(winding("z, 0, -x") > 0.8);
    CHECK(winding("-z, 0, x") < -0.8);
}

TEST_CASE("FFD: what follows it bends, and its leaves only if they shall", "[pgraph]") {
    const std::string plant = "Tree stem\n  length 2\n  branches 4\nLeaf leaf\n  pieces 2\n";
    const auto bent = [&](const std::string& leaves, const std::string& move) {
        std::string moves;
        for (int k = 0; k < 8; ++k) moves += (k ? ", " : "") + ((k / 2) % 2 ? move : std::string("0, 0, 0"));
        return drawn("FFD space\n  moves " + moves + "\n  leaves " + leaves + "\n" + plant +
                     "camera -> space -> stem -B-> leaf\n");
    };
    const PlantGeometry straight = drawn(plant + "camera -> stem -B-> leaf\n");
    const auto tip = [](const PlantGeometry& geometry) { return geometry.internodes.back().tip; };
    CHECK(glm::distance(tip(bent("bent", "0, 0, 0")), tip(straight)) < 1e-12);
    CHECK(glm::distance(tip(bent("bent", "1, 0, 0")), tip(straight) + glm::dvec3(1, 0, 0)) < 1e-12);
    const auto largest_move = [&](const std::string& leaves) {
        const PlantGeometry moved = bent(leaves, "1, 0, 0");
        double largest = 0;
        for (std::size_t k = 0; k < moved.mesh.vertices.size(); ++k) {
            largest =
                std::max(largest, glm::distance(moved.mesh.vertices[k].position, straight.mesh.vertices[k].position));
        }
        return largest;
    };
    CHECK(largest_move("left") == 0);
    CHECK(largest_move("bent") > 0.5);
    CHECK(largest_move("carried") == Approx(1));  // as the stem's tip
}

TEST_CASE("Leaf: flat in one plane, its outline through the control points, and as many waves as it says", "[pgraph]") {
    const std::string leaf = "Leaf leaf\n  length 4\n  width 2\n  outline 0.2, 1, 0.5\n  pieces 8\n";
    const PlantGeometry flat = drawn(leaf + "camera -> leaf\n");
    CHECK(flat.mesh.triangles.size() == 3 * 2 * 16);
    std::map<double, double> half_widths;
    for (const SurfaceVertex& vertex : flat.mesh.vertices) {
        CHECK(std::abs(vertex.position.z) < 1e-9);
        double& width = half_widths[std::round(vertex.position.y * 1e6) / 1e6];
        width = std::max(width, std::abs(vertex.position.x));
    }
    CHECK(half_widths.at(0) == Approx(0.2));
    CHECK(half_widths.at(2) == Approx(1));
    CHECK(half_widths.at(4) == Approx(0.5));

    // The height of the left edge crosses the plane twice a wave.
    const PlantGeometry wavy =
        drawn("Leaf leaf\n  outline 1, 1\n  pieces 40\n  waves 3\n  wave_height 0.1\ncamera -> leaf\n");
    int crossings = 0;
    double before = 0, highest = 0;
    for (std::size_t k = 0; k < wavy.mesh.vertices.size(); k += 3) {
        const double height = wavy.mesh.vertices[k].position.z;
        if (std::abs(height) < 1e-9) continue;
        crossings += before * height < 0;
        before = height;
        highest = std::max(highest, std::abs(height));
    }
    CHECK(crossings == 5);
    CHECK(highest == Approx(0.1).epsilon(0.02));
}

TEST_CASE("Leaf: texture coordinates run across and along the blade, from 0 to 1", "[pgraph]") {
    const PlantGeometry leaf =
        drawn("Leaf leaf\n  length 4\n  pieces 8\n  bend 10\n  fold 20\n  texture 2\ncamera -> leaf\n");
    REQUIRE(leaf.mesh.vertices.size() == 27);
    CHECK(leaf.mesh.pieces.at(0).look.texture == 2);
    for (std::size_t k = 0; k < 27; ++k) {
        CHECK(leaf.mesh.vertices[k].uv.x == Approx(0.5 * double(k % 3)));
        CHECK(leaf.mesh.vertices[k].uv.y == Approx(double(k / 3) / 8));
    }
}

TEST_CASE("Horns that follow one another are one closed surface, without an edge open at the joint", "[pgraph]") {
    const std::string horns =
        "Horn lower\n  length 2\n  sides 9\n  radius 0.3 .. 0.2\nHorn upper\n  pitch 30\n  sides 9\n  radius 0.2 .. "
        "0.05\n";
    const PlantGeometry joined = drawn(horns + "camera -> lower -> upper\n");
    CHECK(EdgeCount(joined.mesh).closed);
    CHECK(euler_characteristic(joined.mesh) == 2);
    CHECK(volume_of(joined.mesh) > 0);
    // At the joint stands one ring of vertices, and no cap.
    std::size_t at_joint = 0;
    for (const SurfaceVertex& vertex : joined.mesh.vertices)
        at_joint += glm::distance(vertex.position, {0, 2, 0}) < 0.21;
    CHECK(at_joint <= 10);
    const PlantGeometry again = drawn("Horn piece\n  sides 7\n  recursion 5\n  pitch 12\ncamera -> piece -> piece\n");
    CHECK(EdgeCount(again.mesh).closed);
    CHECK(euler_characteristic(again.mesh) == 2);
    // One that also stands alone begins a surface of its own there.
    const PlantGeometry two =
        drawn(horns + "Simple aside\n  move 5\ncamera -> lower -> upper\ncamera -> aside -> upper\n");
    CHECK(euler_characteristic(two.mesh) == 4);
}

TEST_CASE("A branch with a closed surface begins within that of its tree", "[pgraph]") {
    const PlantGeometry tree = drawn(
        "Tree stem\n  sides 8\n  branches 3\n  at 0.2 .. 0.8\n  length 3\nHorn twig\n  sides 6\n  radius 0.02 .. 0.01\n"
        "camera -> stem -B-> twig\n");
    CHECK(EdgeCount(tree.mesh).closed);
    CHECK(euler_characteristic(tree.mesh) == 8);  // four closed surfaces
}

TEST_CASE("A horn along a curve passes through its points, with the curve's length", "[pgraph]") {
    const std::string curve = "  curve 0, 0, 0, 0.5, 1, 0, 0, 2, 0.5, 0, 3, 0\n";
    const PlantGeometry horn = drawn("Horn stem\n" + curve + "  pieces 400\ncamera -> stem\n");
    double length = 0;
    for (const Internode& internode : horn.internodes) length += length_of(internode);
    const language::pgraph::CurveThrough through({{0, 0, 0}, {0.5, 1, 0}, {0, 2, 0.5}, {0, 3, 0}});
    CHECK(length == Approx(through.length()).epsilon(1e-4));
    for (const glm::dvec3& point : {glm::dvec3(0, 0, 0), {0.5, 1, 0}, {0, 2, 0.5}, {0, 3, 0}}) {
        double nearest = 9;
        for (const Internode& internode : horn.internodes) {
            nearest = std::min({nearest, glm::distance(internode.base, point), glm::distance(internode.tip, point)});
        }
        CHECK(nearest < length / 400);
    }
    CHECK(glm::distance(horn.internodes.back().tip, glm::dvec3(0, 3, 0)) < 1e-9);
}

TEST_CASE("Every p-graph of the library survives printing", "[pgraph]") {
    int count = 0;
    for (const auto& file : std::filesystem::directory_iterator(source_path("models/pgraph"))) {
        if (file.path().extension() != ".pgraph") continue;
        INFO(file.path());
        const language::pgraph::Graph graph = language::pgraph::parse(read_text(file.path()), "library");
        const language::pgraph::Graph again = language::pgraph::parse(print(graph), "printed");
        CHECK(again == graph);
        CHECK(translate(again).text == translate(graph).text);
        ++count;
    }
    CHECK(count >= 6);
}

TEST_CASE("The dandelion: 18 hairs on each parachute, one stalk each, one stem", "[pgraph]") {
    for (const int parachutes : {100, 400}) {
        const LonePlant plant = grown_model("dandelion", {{"PARACHUTES", std::to_string(parachutes)}});
        auto counts = plant.counts();
        CHECK(counts["Hair"] == 18 * parachutes);
        CHECK(counts["Stalk"] == parachutes);
        CHECK(counts["Stem"] == 1);
    }
}

TEST_CASE("The bush: three branches, five times over", "[pgraph]") {
    auto counts = grown_model("bush").counts();
    CHECK(counts["Branch"] == 363);
    CHECK(counts["Fork"] == 121);
    CHECK(counts["Leaf"] == 5 * 363);
}

TEST_CASE("The weeping willow: twigs end downwards, and do not without gravitropism", "[pgraph]") {
    const auto mean_end = [](const std::string& weeping) {
        const LonePlant plant = grown_model("weeping-willow", {{"WEEPING", weeping}, {"LEAVES", "0"}});
        const Alphabet& alphabet = plant.model->alphabet;
        double sum = 0;
        int ends = 0;
        const auto& internodes = plant.interpretation.geometry.internodes;
        for (std::size_t k = 0; k < internodes.size(); ++k) {
            const bool is_twig = alphabet.name(plant.string.letters[internodes[k].module]) == "TwigAxis";
            const bool is_last = k + 1 == internodes.size() || internodes[k + 1].axis != internodes[k].axis;
            if (!is_twig || !is_last) continue;
            sum += direction_of(internodes[k]).y;
            ++ends;
        }
        CHECK(ends == 24 * 48);
        return sum / ends;
    };
    CHECK(mean_end("1") < -0.5);
    CHECK(mean_end("0") > 0);
}

TEST_CASE("The mountain pine: its crown lies downwind", "[pgraph]") {
    const auto vertices = [](const std::string& wind) {
        std::vector<glm::dvec3> places;
        const LonePlant pine = grown_model("wind-pine", {{"WIND", wind}});
        for (const SurfaceVertex& vertex : pine.interpretation.geometry.mesh.vertices)
            places.push_back(vertex.position);
        return places;
    };
    const auto centre_of = [](const std::vector<glm::dvec3>& points) {
        glm::dvec3 sum(0);
        for (const glm::dvec3& point : points) sum += point;
        return sum / double(points.size());
    };
    const std::vector<glm::dvec3> calm = vertices("0"), blown = vertices("1");
    const glm::dvec3 calm_centre = centre_of(calm);
    double radius = 0;
    for (const glm::dvec3& point : calm) {
        radius = std::max(radius, std::hypot(point.x - calm_centre.x, point.z - calm_centre.z));
    }
    CHECK(centre_of(blown).x - calm_centre.x > 0.1 * radius);
}

TEST_CASE("The sunflower and the pineapple: organs a golden angle apart", "[pgraph]") {
    const LonePlant sunflower = grown_model("sunflower", {{"RAYS", "0"}});
    CHECK(sunflower.counts().at("Floret") == 420);
    const LonePlant pineapple = grown_model("pineapple", {{"TUFT", "0"}});
    std::vector<glm::dvec3> eyes;
    for (const Organ& organ : pineapple.interpretation.geometry.organs) eyes.push_back(organ.pose.position);
    REQUIRE(eyes.size() == 130);
    for (std::size_t k = 0; k + 1 < eyes.size(); ++k) {
        const double step = onward(azimuth(eyes[k]), azimuth(eyes[k + 1]));
        CHECK(std::min(step, 360 - step) == Approx(golden_divergence).margin(1e-6));
    }
    std::set<int> differences;
    for (int k = 55; k < 75; ++k) {
        std::vector<std::pair<double, int>> others;
        for (int j = 0; j < 130; ++j) {
            if (j != k) others.emplace_back(glm::distance(eyes[std::size_t(k)], eyes[std::size_t(j)]), std::abs(j - k));
        }
        std::sort(others.begin(), others.end());
        for (std::size_t nearest = 0; nearest < 4; ++nearest) differences.insert(others[nearest].second);
    }
    for (const int difference : differences) CHECK(std::set<int>{5, 8, 13}.contains(difference));
}

TEST_CASE("The palm: one trunk, and leaflets on every frond", "[pgraph]") {
    auto counts = grown_model("palm").counts();
    CHECK(counts["Trunk"] == 1);
    CHECK(counts["Frond"] == 26);
    CHECK(counts["Leaflet"] == 26 * 70);
}

TEST_CASE("The ivy: its vines wind around the pole, outside it and never far from it", "[pgraph]") {
    const LonePlant ivy = grown_model("ivy", {{"LEAVES", "0"}});
    const auto& internodes = ivy.interpretation.geometry.internodes;
    REQUIRE(internodes.size() > 400);
    double wound = 0;
    for (const Internode& internode : internodes) {
        const double distance = std::hypot(internode.tip.x, internode.tip.z);
        CHECK(distance - internode.tip_radius > 0.25);
        CHECK(distance < 0.25 + 0.15);
        const double turn = onward(azimuth(internode.base), azimuth(internode.tip));
        wound += turn < 180 ? turn : turn - 360;
    }
    CHECK(std::abs(wound) > 4 * 360);
}

TEST_CASE("The broadleaved tree: the higher, the more branches", "[pgraph]") {
    std::size_t before = 0;
    for (const char* height : {"1", "3", "6", "9"}) {
        auto counts = grown_model("broadleaf", {{"HEIGHT", height}}).counts();
        CHECK(counts["Branch"] > static_cast<int>(before));
        before = static_cast<std::size_t>(counts["Branch"]);
    }
}

TEST_CASE("A tree that grows and dies has more and more segments, and then fewer and fewer", "[pgraph]") {
    World world(read_scene(source_path("environments/life-of-a-tree.toml")));
    world.start();
    std::vector<std::size_t> segments;
    for (int year = 0; year <= 100; ++year) {
        if (year > 0) world.step();
        if (year % 10 == 0) segments.push_back(world.interpretation(0).geometry.internodes.size());
    }
    const auto most = std::max_element(segments.begin(), segments.end());
    CHECK(std::is_sorted(segments.begin(), most + 1));
    CHECK(std::is_sorted(std::make_reverse_iterator(segments.end()), std::make_reverse_iterator(most)));
    CHECK(*most > 10 * segments.front());
    CHECK(*most > 10 * segments.back());
}

TEST_CASE("Species by age: the older, the higher, and the same tree again for the same age", "[pgraph]") {
    const auto grown = [](const std::string& species, int age) {
        World world(read_scene(source_path("environments/species/" + species + ".toml"),
                               {{{"plant.0.age", std::to_string(age)}}, {}, {}}));
        world.start();
        for (int step = 0; step < 4; ++step) world.step();
        return to_text(world.string(0), world.model(0).alphabet) +
               fmt::format("\n{}", world.interpretation(0).geometry.bounds.upper.y);
    };
    const auto height = [](const std::string& plant) { return std::stod(plant.substr(plant.rfind('\n') + 1)); };
    for (const char* species : {"broadleaf", "willow", "palm"}) {
        INFO(species);
        double before = 0;
        for (const int age : {1, 3, 8, 15, 30, 50}) {
            const std::string plant = grown(species, age);
            CHECK(height(plant) >= before);
            before = height(plant);
        }
        CHECK(grown(species, 15) == grown(species, 15));
    }
}
