// smooth: axes that curve through their nodes.
// A cubic Hermite curve with the tangents of Catmull & Rom 1974, in the chordal parametrisation of Barry & Goldman
// 1988, which makes no loops where a short internode follows a long one.
#include "espalier/turtle/geometry_stage.h"

#include <glm/geometric.hpp>

namespace espalier::turtle {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFF;

/// The internodes before and behind each one on its axis, where one begins at the other's tip.
struct AxisNeighbours {
    explicit AxisNeighbours(const PlantGeometry& geometry)
        : before(geometry.internodes.size(), none), behind(geometry.internodes.size(), none) {
        std::vector<std::uint32_t> last(geometry.axes, none);
        for (std::uint32_t i = 0; i < geometry.internodes.size(); ++i) {
            const Internode& internode = geometry.internodes[i];
            if (internode.axis >= last.size()) last.resize(internode.axis + 1, none);
            const std::uint32_t other = last[internode.axis];
            last[internode.axis] = i;
            if (other == none || geometry.internodes[other].tip != internode.base) continue;
            before[i] = other;
            behind[other] = i;
        }
    }

    std::vector<std::uint32_t> before, behind;
};

/// Displacement by length along the axis, at both ends of an internode.
struct Tangents {
    glm::dvec3 base, tip;
};

class Smooth final : public GeometryStage {
public:
    explicit Smooth(Settings& settings)
        : pieces_(static_cast<std::uint32_t>(settings.integer_or("pieces", 4, Range::between(2, 16)))) {}

    void apply(StagedPlant& plant) const override {
        PlantGeometry& geometry = plant.geometry;
        const AxisNeighbours neighbours(geometry);
        Column<Internode> pieces;
        pieces.reserve(geometry.internodes.size() * pieces_);
        for (std::uint32_t i = 0; i < geometry.internodes.size(); ++i) {
            add_pieces(geometry.internodes[i], tangents_of(geometry.internodes, neighbours, i), pieces);
        }
        std::vector<std::uint16_t> textures;
        for (const std::uint16_t texture : geometry.textures) textures.insert(textures.end(), pieces_, texture);
        geometry.internodes = std::move(pieces);
        geometry.textures = std::move(textures);
    }

private:
    static Tangents tangents_of(const Column<Internode>& internodes, const AxisNeighbours& neighbours,
                                std::uint32_t at) {
        const auto chord = [&](std::uint32_t i) { return internodes[i].tip - internodes[i].base; };
        const double length = glm::length(chord(at));
        const auto slope = [&](std::uint32_t i) { return chord(i) / glm::length(chord(i)); };
        const auto bends = [&](std::uint32_t other) { return other != none && glm::length(chord(other)) > 0; };
        if (length == 0) return {{0, 0, 0}, {0, 0, 0}};
        const auto shared = [&](std::uint32_t other) {
            const double its_length = glm::length(chord(other));
            return (its_length * slope(at) + length * slope(other)) / (length + its_length);
        };
        const std::uint32_t before = neighbours.before[at], behind = neighbours.behind[at];
        const bool bends_before = bends(before), bends_behind = bends(behind);
        Tangents tangents{bends_before ? shared(before) : slope(at), bends_behind ? shared(behind) : slope(at)};
        // The ends of an axis have no curvature.
        if (!bends_before && bends_behind) tangents.base = 1.5 * slope(at) - 0.5 * tangents.tip;
        if (bends_before && !bends_behind) tangents.tip = 1.5 * slope(at) - 0.5 * tangents.base;
        return tangents;
    }

    void add_pieces(const Internode& whole, const Tangents& tangents, Column<Internode>& pieces) const {
        const double length = glm::distance(whole.base, whole.tip);
        const auto point = [&](double t) {
            const double u = 1 - t;
            return (1 + 2 * t) * u * u * whole.base + t * t * (3 - 2 * t) * whole.tip +
                   length * (t * u * u * tangents.base - t * t * u * tangents.tip);
        };
        Internode piece = whole;
        for (std::uint32_t k = 1; k <= pieces_; ++k) {
            const double t = double(k) / pieces_;
            piece.tip = k == pieces_ ? whole.tip : point(t);
            piece.tip_radius =
                k == pieces_ ? whole.tip_radius : whole.base_radius + t * (whole.tip_radius - whole.base_radius);
            pieces.push_back(piece);
            piece.base = piece.tip;
            piece.base_radius = piece.tip_radius;
        }
    }

    std::uint32_t pieces_;
};

const Registered<GeometryStageType> entry{
    {"smooth", "axes curve through their nodes: Catmull-Rom splines (Catmull & Rom 1974, Barry & Goldman 1988)",
     R"(pieces  4, 2 to 16; pieces of each internode
Nodes stay where they are, and so do branches; radii change evenly along each internode. The curve has one tangent at
each node of an axis; a straight axis stays straight. Put stages that attach something to internodes behind this one.
)",
     construct<Smooth>}};

}  // namespace
}  // namespace espalier::turtle
