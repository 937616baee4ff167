// root-flare: the foot of a stem widens, and roots run out of it into the ground.
// What Brzoska 2019 (section 2.3, requirement FAF1) asks for: roots of old trees that can be seen where they begin.
#include "espalier/base/math.h"
#include "espalier/turtle/geometry_stage.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <numbers>
#include <vector>

namespace espalier::turtle {
namespace {

constexpr int pieces_of_root = 10, pieces_of_foot = 4;
constexpr double foot_height = 3.5;  ///< in radii of the stem, as all other measures are

class RootFlare final : public GeometryStage {
public:
    explicit RootFlare(Settings& settings)
        : roots_(static_cast<std::uint32_t>(settings.integer("roots", Range::between(0, 100)))),
          length_(settings.number_or("length", 6, Range::positive())),
          flare_(settings.number_or("flare", 1.5, Range::between(1, 4))) {}

    void apply(StagedPlant& plant) const override {
        PlantGeometry& geometry = plant.geometry;
        if (roots_ == 0 || geometry.internodes.empty() || !(geometry.internodes[0].base_radius > 0)) return;
        const Internode stem = geometry.internodes[0];
        for (std::uint32_t number = 0; number < roots_; ++number) add_root(plant, stem, number);
        widen_foot(geometry, stem);
    }

private:
    /// Each sinks the faster the farther it is, and so its back leaves the ground's surface at some distance.
    void add_root(StagedPlant& plant, const Internode& stem, std::uint32_t number) const {
        RandomSamples samples(plant.key, number, 0x726f6f74);
        const double radius = stem.base_radius, length = radius * length_ * (0.7 + 0.6 * samples.uniform());
        const double thickness = radius * (0.5 + 0.25 * samples.uniform());
        double angle = 2 * std::numbers::pi * (number + 0.5 * samples.uniform()) / roots_;
        Internode piece = stem;
        piece.axis = plant.geometry.axes++;
        piece.order = static_cast<std::uint16_t>(stem.order + 1);
        piece.tip = stem.base - glm::dvec3(0, 0.2 * thickness, 0);
        piece.tip_radius = thickness;
        for (int k = 1; k <= pieces_of_root; ++k) {
            const double share = double(k) / pieces_of_root, step = length / pieces_of_root;
            const double slope = 0.1 + 0.6 * share * share;
            angle += 0.35 * (samples.uniform() - 0.5);
            piece.base = piece.tip;
            piece.base_radius = piece.tip_radius;
            piece.tip += step * glm::dvec3(math::cos(angle), -slope, math::sin(angle));
            piece.tip_radius = thickness * math::pow(1 - 0.9 * share, 0.8);
            plant.geometry.internodes.push_back(piece);
            if (plant.geometry.textures.empty()) continue;
            plant.geometry.textures.resize(plant.geometry.internodes.size() - 1, 0);
            plant.geometry.textures.push_back(plant.geometry.textures.front());
        }
    }

    /// The lowest part of the stem, in pieces whose radius grows towards the ground.
    void widen_foot(PlantGeometry& geometry, const Internode& stem) const {
        const glm::dvec3 along = stem.tip - stem.base;
        const double height = std::min(0.9, foot_height * stem.base_radius / glm::length(along));
        const auto radius = [&](double share) {
            const double plain = stem.base_radius + share * height * (stem.tip_radius - stem.base_radius);
            return plain * (1 + (flare_ - 1) * math::pow(1 - share, 2.5));
        };
        std::vector<Internode> foot(pieces_of_foot, stem);
        for (int k = 0; k < pieces_of_foot; ++k) {
            const double from = double(k) / pieces_of_foot, to = double(k + 1) / pieces_of_foot;
            foot[k].base = stem.base + from * height * along;
            foot[k].tip = stem.base + to * height * along;
            foot[k].base_radius = radius(from);
            foot[k].tip_radius = radius(to);
        }
        geometry.internodes[0].base = foot.back().tip;
        geometry.internodes[0].base_radius = foot.back().tip_radius;
        geometry.internodes.insert(geometry.internodes.begin(), foot.begin(), foot.end());
        if (geometry.textures.empty()) return;
        geometry.textures.insert(geometry.textures.begin(), foot.size(), geometry.textures.front());
    }

    std::uint32_t roots_;
    double length_, flare_;
};

const Registered<GeometryStageType> entry{
    {"root-flare", "the foot of the stem widens, and roots run from it into the ground (Brzoska 2019)",
     R"(roots   required, 0 to 100; how many roots; 0 changes nothing
length  6, > 0; length of a root, in radii of the stem
flare   1.5, 1 to 4; how many times as wide as the stem its foot is
All nodes of the roots lie below the place where the plant begins; near the stem their backs are above the ground. Put it
behind pipe-radii, which gives the stem its radius, and behind the stages that bend axes or put leaves on them.
)",
     construct<RootFlare>}};

}  // namespace
}  // namespace espalier::turtle
