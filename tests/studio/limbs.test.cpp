// What a step wears: bark, skin and labels.
#include "session_fixture.h"

#include <glm/common.hpp>

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <utility>

using namespace studio_test;

namespace {

const char* const scene_of_limbs = "[[plant]]\nmodel = \"tree.l\"\nview = \"tree.v\"\n";

// A trunk with bark and two limbs.
const char* const tree_of_limbs = R"(lsystem: 1
derivation length: 1
axiom: @Tx(1) !(0.2) F(2) [ +(40) !(0.14) F(1) ] [ -(40) !(0.14) F(1) ] @L("%d limbs", 3)
endlsystem
)";

/// The message ESM1 as its numbers.
struct Limbs {
    struct Range {
        std::uint32_t texture, first, count;
    };
    std::uint32_t step, smooth;
    std::vector<Range> ranges;
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> modules, indices;

    explicit Limbs(const std::string& bytes)
        : step(number_at<std::uint32_t>(bytes, 8)), smooth(number_at<std::uint32_t>(bytes, 12)) {
        const auto vertices = number_at<std::uint32_t>(bytes, 16), corners = number_at<std::uint32_t>(bytes, 20);
        std::size_t at = 28;
        for (std::uint32_t i = 0; i < number_at<std::uint32_t>(bytes, 24); ++i, at += 12) {
            ranges.push_back(number_at<Range>(bytes, at));
        }
        for (std::uint32_t i = 0; i < vertices; ++i) {
            positions.push_back(number_at<glm::vec3>(bytes, at + 12 * std::size_t{i}));
            modules.push_back(number_at<std::uint32_t>(bytes, at + 20 * std::size_t{vertices} + 4 * std::size_t{i}));
        }
        at += 32 * std::size_t{vertices};
        for (std::uint32_t i = 0; i < corners; ++i) {
            indices.push_back(number_at<std::uint32_t>(bytes, at + 4 * std::size_t{i}));
        }
        CHECK(at + 4 * std::size_t{corners} == bytes.size());
    }

    double volume() const {
        double six = 0;
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            const glm::dvec3 a(positions[indices[i]]), b(positions[indices[i + 1]]), c(positions[indices[i + 2]]);
            six += a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) + a.z * (b.x * c.y - b.y * c.x);
        }
        return std::abs(six) / 6;
    }
};

Limbs limbs_of(OpenStudio& studio, const std::string& skin) {
    const Json growth = studio.page.last("growth");
    const Json reply =
        studio.ask({{"do", "limbs"}, {"growth", growth["growth"]}, {"step", growth["step"]}, {"skin", skin}});
    REQUIRE_FALSE(reply.contains("error"));
    studio.wait([&] { return studio.page.packets.back().substr(0, 4) == "ESM1"; });
    return Limbs(studio.page.packets.back());
}

}  // namespace

TEST_CASE("limbs are tubes as pictures have them, with the modules that drew them", "[studio]") {
    OpenStudio studio("lsystem: 1\nderivation length: 1\naxiom: !(0.2) F(2) F(1)\nendlsystem\n");
    studio.begin();
    studio.wait_until_grown();
    const Limbs limbs = limbs_of(studio, "tubes");
    CHECK(limbs.smooth == 0);
    CHECK(limbs.volume() == Approx(3 * 0.1 * 0.1 * 3).epsilon(0.001));  // a regular polygon of 12 sides has 3 r^2
    CHECK(limbs.modules.front() == 1);
    CHECK(limbs.modules.back() == 2);
}

TEST_CASE("thin limbs of a large plant are where they were drawn, and as thick", "[studio]") {
    OpenStudio studio(
        "lsystem: 1\nderivation length: 1\n"
        "axiom: !(9) F(1000) f(1.003) [ +(90) !(0.002) F(0.5) ] [ -(90) f(0.001) !(0.002) F(0.5) ]\nendlsystem\n");
    studio.begin();
    studio.wait_until_grown();
    const Limbs limbs = limbs_of(studio, "tubes");
    glm::vec3 lower(1e9F), upper(-1e9F);
    for (const glm::vec3& position : limbs.positions) {
        if (position.y < 1001) continue;
        lower = glm::min(lower, position);
        upper = glm::max(upper, position);
    }
    CHECK(lower.x == Approx(-0.5).margin(1e-6));
    CHECK(upper.x == Approx(0.501).margin(1e-6));
    CHECK(upper.y - lower.y == Approx(0.002).epsilon(0.1));
}

TEST_CASE("an axis that begins where another of its order ended is another", "[studio]") {
    OpenStudio studio(
        "lsystem: 1\nderivation length: 1\naxiom: !(0.1) [ +(30) F(1) ] [ +(30) f(1) +(120) F(1) ]\nendlsystem\n");
    studio.begin();
    studio.wait_until_grown();
    const Limbs limbs = limbs_of(studio, "tubes");
    // Two tubes with two caps each: vertices of an axis of two internodes would be fewer.
    CHECK(limbs.indices.size() / 3 == 2 * (2 * 2 * 12));
}

TEST_CASE("a smooth skin is closed, and as large as the limbs below it", "[studio]") {
    OpenStudio studio(
        "lsystem: 1\nderivation length: 1\naxiom: !(0.2) F(2) [ +(40) !(0.14) F(1) ] [ -(40) !(0.14) F(1) ]\n"
        "endlsystem\n");
    studio.begin();
    studio.wait_until_grown();
    const Limbs limbs = limbs_of(studio, "smooth");
    CHECK(limbs.smooth == 1);
    std::map<std::pair<std::tuple<float, float, float>, std::tuple<float, float, float>>, int> edges;
    const auto key = [&](std::uint32_t i) {
        const glm::vec3& p = limbs.positions[i];
        return std::tuple(p.x, p.y, p.z);
    };
    for (std::size_t i = 0; i < limbs.indices.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = key(limbs.indices[i + k]), b = key(limbs.indices[i + (k + 1) % 3]);
            ++edges[std::minmax(a, b)];
        }
    }
    for (const auto& [edge, triangles] : edges) REQUIRE(triangles == 2);
    const double limb_volume = std::numbers::pi * (0.01 * 2 + 2 * 0.0049 * 1);
    CHECK(limbs.volume() == Approx(limb_volume).epsilon(0.1));
}

TEST_CASE("limbs that wear bark name the pictures of its colours and its relief", "[studio]") {
    OpenStudio studio(scene_of_limbs, "scene.toml");
    studio.folder.write("tree.l", tree_of_limbs);
    studio.folder.write("tree.v", "texture: F: rough.bark\nline style: cylinder\n");
    studio.folder.write("rough.bark", "size = 32\n");
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    const Json textures = page.last("textures");
    REQUIRE(textures["files"].size() == 1);
    for (const char* kind : {"files", "reliefs"}) {
        const auto file = studio.session->file(textures[kind][0].get<std::uint32_t>());
        REQUIRE(file);
        CHECK(file->extension() == ".png");
        CHECK(std::filesystem::file_size(*file) > 100);
    }
    const Limbs limbs = limbs_of(studio, "tubes");
    REQUIRE(limbs.ranges.size() == 1);
    CHECK(limbs.ranges[0].texture == 1);
    CHECK(limbs.ranges[0].count == limbs.indices.size());
}

TEST_CASE("labels travel with their places and texts", "[studio]") {
    OpenStudio studio(tree_of_limbs);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    const std::string& packet = page.packets.back();
    const std::size_t begin = packet.find("3 limbs");
    REQUIRE(begin != std::string::npos);
    CHECK(number_at<float>(packet, begin - 24 + 4) == Approx(2));  // the top of the trunk
    CHECK(number_at<std::uint32_t>(packet, begin - 4) == 7);
}

TEST_CASE("of several wishes the last one counts", "[studio]") {
    OpenStudio studio(tree_of_limbs);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    const Json growth = page.last("growth")["growth"];
    for (const char* skin : {"smooth", "smooth", "tubes"}) {
        studio.ask({{"do", "limbs"}, {"growth", growth}, {"step", 0}, {"skin", skin}});
    }
    studio.wait([&] { return page.packets.back().substr(0, 4) == "ESM1"; });
    CHECK(Limbs(page.packets.back()).smooth == 0);
}

TEST_CASE("limbs of a step that has not been grown, or of another growth, are refused", "[studio]") {
    OpenStudio studio(tree_of_limbs);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    const Json growth = page.last("growth")["growth"];
    CHECK(studio.ask({{"do", "limbs"}, {"growth", growth}, {"step", 7}, {"skin", "tubes"}}).contains("error"));
    CHECK(studio.ask({{"do", "limbs"}, {"growth", 99}, {"step", 0}, {"skin", "tubes"}}).contains("error"));
    CHECK_FALSE(studio.ask({{"do", "limbs"}, {"skin", nullptr}}).contains("error"));
}
