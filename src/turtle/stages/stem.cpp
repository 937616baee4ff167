// stem: a straight stem below the plant, which stands on it as it grew.
// Brzoska 2019, sections 5.1 and 5.2.1: another length moves the crown by one vector and grows nothing again.
#include "espalier/turtle/geometry_stage.h"

#include "geometry/drawn/rigid_motion.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <optional>

namespace espalier::turtle {
namespace {

class Stem final : public GeometryStage {
public:
    explicit Stem(Settings& settings)
        : length_(settings.number("length", Range::not_negative())),
          pieces_(static_cast<std::uint32_t>(settings.integer_or("pieces", 1, Range::between(1, 1000)))) {
        if (!settings.has("direction")) return;
        direction_ = settings.vector("direction");
        const double size = glm::length(*direction_);
        if (!(size > 0) || !std::isfinite(size)) {
            throw UserError(settings.place("direction"), "'direction' of a stem must be finite and not zero");
        }
        *direction_ /= size;
    }

    void apply(StagedPlant& plant) const override {
        PlantGeometry& geometry = plant.geometry;
        if (length_ == 0 || geometry.internodes.empty()) return;
        const Internode first = geometry.internodes[0];
        const glm::dvec3 along = length_ * direction_.value_or(plant.heading);
        const RigidMotion up{{1, 0, 0, 0}, {0, 0, 0}, along};
        for (Internode& internode : geometry.internodes) {
            internode.base = up.point(internode.base);
            internode.tip = up.point(internode.tip);
        }
        move_organs(geometry, [&](std::uint32_t, const glm::dvec3&) { return &up; });
        put_below(geometry, first, along);
    }

private:
    /// A plant that begins with a branch gets an axis for its stem, which the first module draws and all branches see.
    void put_below(PlantGeometry& geometry, const Internode& first, const glm::dvec3& along) const {
        Internode piece = first;
        piece.tip_radius = first.base_radius;
        if (first.order > 0) {
            for (Internode& internode : geometry.internodes) ++internode.axis;
            ++geometry.axes;
            piece.module = 0;
            piece.order = 0;
        }
        std::vector<Internode> pieces(pieces_, piece);
        for (std::uint32_t i = 0; i < pieces_; ++i) {
            pieces[i].base = i == 0 ? first.base : pieces[i - 1].tip;
            pieces[i].tip = first.base + along * (double(i + 1) / pieces_);
        }
        pieces.back().tip = geometry.internodes[0].base;  // to the last bit, because places tell what bears what
        geometry.internodes.insert(geometry.internodes.begin(), pieces.begin(), pieces.end());
        if (!geometry.textures.empty()) {
            const std::uint16_t texture = geometry.textures.front();
            geometry.textures.insert(geometry.textures.begin(), pieces_, texture);
        }
    }

    double length_;
    std::uint32_t pieces_;
    std::optional<glm::dvec3> direction_;
};

const Registered<GeometryStageType> entry{
    {"stem", "a straight stem below the plant, which moves up by one vector (Brzoska 2019)",
     R"(length     required, m, >= 0; length of the stem; 0: no stem
pieces     1, 1 to 1000; internodes of equal length
direction  the heading with which the plant begins; [x, y, z] of any length: another direction
The stem begins where the plant did and is as thick as the base of its first internode: put pipe-radii behind it to make
it as thick as the crown asks for. The environment sees the plant without it. A plant without internodes gets none.
)",
     construct<Stem>}};

}  // namespace
}  // namespace espalier::turtle
