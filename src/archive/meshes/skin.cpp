#include "archive/meshes/skin.h"

#include "espalier/base/error.h"

#include "archive/meshes/limb_level_set.h"
#include "archive/meshes/texture_file.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <utility>

namespace espalier::archive {
namespace {

constexpr double thinnest_in_voxels = 1.5;                         // a limb's radius
constexpr double voxels_of_thinnest = 4, voxels_of_thickest = 40;  // at most
constexpr double wanted_quads = 150'000, most_quads = 8'000'000;

/// How many nodes of a line, from its first on, are thick enough for the level set; 0 if fewer than 2.
std::size_t thick_nodes(const TubeLine& line, double voxel) {
    std::size_t count = 0;
    while (count < line.nodes.size() && line.nodes[count].radius >= thinnest_in_voxels * voxel) ++count;
    return count < 2 ? 0 : count;
}

double quads_at(std::span<const AxisLine> lines, double voxel) {
    double area = 0;
    for (const AxisLine& axis : lines) {
        const std::vector<TubeNode>& nodes = axis.line.nodes;
        for (std::size_t i = 1; i < thick_nodes(axis.line, voxel); ++i) {
            area += std::numbers::pi * (double(nodes[i - 1].radius) + nodes[i].radius) *
                    glm::distance(nodes[i - 1].position, nodes[i].position);
        }
    }
    return area / (voxel * voxel);
}

/// The first of `voxel` and what is coarser that gives no more than so many.
double coarse_enough(std::span<const AxisLine> lines, double voxel, double quads) {
    while (quads_at(lines, voxel) > quads) voxel *= 1.1;
    return voxel;
}

/// The thick part of a line as a smooth curve through its nodes.
struct Limb {
    TubeLine curve;
    std::vector<std::uint32_t> node_of;  ///< the line's node that ends the piece in which a node of the curve lies
    std::vector<TubeFrame> frames;       ///< frames of the curve
};

/// Between two nodes: a cubic with their tangents (Hermite).
glm::dvec3 on_curve(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& tangent_a, const glm::dvec3& tangent_b,
                    double t) {
    const double length = glm::distance(a, b), u = 1 - t;
    return u * u * (1 + 2 * t) * a + t * t * (3 - 2 * t) * b + length * t * u * (u * tangent_a - t * tangent_b);
}

/// The first nodes of a line without those that follow another too closely for anything to be seen of it: many short
/// pieces of a thick limb would all matter at the same places.
std::vector<std::uint32_t> distant_nodes(const TubeLine& line, std::size_t count, double voxel) {
    std::vector<std::uint32_t> kept{0};
    for (std::uint32_t i = 1; i < count; ++i) {
        const TubeNode &before = line.nodes[kept.back()], &here = line.nodes[i];
        const double least = std::max(2 * voxel, 0.25 * here.radius);
        const bool is_close = glm::distance(before.position, here.position) < least;
        if (i + 1 < count && is_close) continue;
        if (is_close && kept.size() > 1) kept.pop_back();  // the last node stays where it is
        kept.push_back(i);
    }
    return kept;
}

Limb limb_of(const TubeLine& whole, double voxel) {
    constexpr double bend_of_piece = 0.1;  // radians
    const std::size_t count = thick_nodes(whole, voxel);
    Limb limb{whole, {}, {}};
    limb.curve.nodes.clear();
    if (count == 0) return limb;
    const std::vector<std::uint32_t> number = distant_nodes(whole, count, voxel);
    TubeLine line = whole;
    line.nodes.clear();
    for (const std::uint32_t node : number) line.nodes.push_back(whole.nodes[node]);
    if (count < whole.nodes.size()) line.nodes.push_back(whole.nodes[count]);  // for the tangent at the end
    const std::vector<TubeNode>& nodes = line.nodes;
    const std::vector<TubeFrame> frames = frames_along(line);
    const auto bend = [](const glm::dvec3& a, const glm::dvec3& b) {
        return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
    };
    limb.curve.nodes.push_back(nodes.front());
    limb.node_of.push_back(number[1]);
    for (std::uint32_t i = 1; i < number.size(); ++i) {
        const glm::dvec3 a = nodes[i - 1].position, b = nodes[i].position, along = glm::normalize(b - a);
        const glm::dvec3 &before = frames[i - 1].tangent, &behind = frames[i].tangent;
        const double turns = bend(before, along) + bend(along, behind);
        const int pieces = std::clamp(static_cast<int>(std::ceil(turns / bend_of_piece)), 1, 32);
        for (int k = 1; k <= pieces; ++k) {
            const double t = static_cast<double>(k) / pieces;
            const double radius = nodes[i - 1].radius + t * (double(nodes[i].radius) - nodes[i - 1].radius);
            const glm::vec3 place = k == pieces ? nodes[i].position : glm::vec3(on_curve(a, b, before, behind, t));
            limb.curve.nodes.push_back({place, static_cast<float>(radius), nodes[i].point});
            limb.node_of.push_back(number[i]);
        }
    }
    limb.frames = frames_along(limb.curve);
    return limb;
}

/// The relief of each texture that lines wear.
using Reliefs = std::map<std::string, std::optional<BarkRelief>>;

Reliefs reliefs_of(std::span<const AxisLine> lines, const AxisSkin& skin) {
    Reliefs reliefs;
    for (const AxisLine& line : lines) {
        if (!skin.displaced || line.texture.empty() || reliefs.contains(line.texture)) continue;
        reliefs[line.texture] = bark_relief(skin.folder, line.texture);
    }
    return reliefs;
}

/// A plant's lines, their pieces and its surface.
class Skin {
public:
    Skin(std::span<const AxisLine> lines, const std::vector<std::size_t>& members, const Reliefs& reliefs, double blend,
         double voxel)
        : members_(members), voxel_(voxel), curves_(curves(lines)), limbs_(pieces(), blend) {
        for (const std::size_t member : members) {
            const auto relief = reliefs.find(lines[member].texture);
            reliefs_.push_back(relief == reliefs.end() || !relief->second ? nullptr : &*relief->second);
        }
    }

    /// Adds a patch to each of the plant's tubes.
    void cover(std::vector<Tube>& tubes) {
        if (limbs_.pieces().empty()) return;
        patches_.resize(members_.size());
        set_.emplace(limbs_, voxel_);
        mesh_ = set_->mesh();
        for (const glm::dvec3& point : mesh_.points) owners_.push_back(limb_nearest_to(point));
        for (const auto& triangle : std::exchange(mesh_.triangles, {})) cut(triangle);
        displace();
        for (std::uint32_t limb = 0; limb < members_.size(); ++limb) add_patch(limb, tubes[members_[limb]]);
    }

private:
    using Triangle = std::array<std::uint32_t, 3>;
    using Nearest = LimbUnion::Nearest;

    std::vector<Limb> curves(std::span<const AxisLine> lines) const {
        std::vector<Limb> all;
        for (const std::size_t member : members_) all.push_back(limb_of(lines[member].line, voxel_));
        return all;
    }

    std::vector<LimbPiece> pieces() const {
        std::vector<LimbPiece> all;
        for (std::uint32_t limb = 0; limb < curves_.size(); ++limb) {
            const std::vector<TubeNode>& nodes = curves_[limb].curve.nodes;
            for (std::uint32_t i = 1; i < nodes.size(); ++i) {
                const std::vector<TubeFrame>& frames = curves_[limb].frames;
                all.push_back({nodes[i - 1].position, nodes[i].position, nodes[i - 1].radius, nodes[i].radius, limb, i,
                               frames[i - 1].tangent, frames[i].tangent, i == 1, i + 1 == nodes.size(),
                               i == 1 && curves_[limb].curve.stands_free});
            }
        }
        return all;
    }

    std::uint32_t limb_nearest_to(const glm::dvec3& point) {
        limbs_.nearest(point, set_->near(point), found_);
        const auto closer = [](const Nearest& a, const Nearest& b) { return a.distance < b.distance; };
        const auto best = std::min_element(found_.begin(), found_.end(), closer);
        return best == found_.end() ? 0 : limbs_.pieces()[best->piece].limb;
    }

    /// The nearest piece of a limb, which need not matter there.
    Nearest nearest_of(std::uint32_t limb, const glm::dvec3& point) {
        limbs_.nearest(point, set_->near(point), found_);
        for (const Nearest& here : found_) {
            if (limbs_.pieces()[here.piece].limb == limb) return here;
        }
        std::vector<std::uint32_t> own;
        for (std::uint32_t i = 0; i < limbs_.pieces().size(); ++i) {
            if (limbs_.pieces()[i].limb == limb) own.push_back(i);
        }
        limbs_.nearest(point, own, found_);
        return found_.front();
    }

    std::uint32_t add_point(const glm::dvec3& position, const glm::dvec3& normal) {
        mesh_.points.push_back(position);
        mesh_.normals.push_back(glm::normalize(normal));
        return static_cast<std::uint32_t>(mesh_.points.size() - 1);
    }

    /// Where an edge between two limbs is as far from one as from the other; the same for both its triangles.
    std::uint32_t cut_of(std::uint32_t a, std::uint32_t b) {
        if (a > b) std::swap(a, b);
        const auto [at, is_new] = cuts_.emplace(std::uint64_t{a} << 32 | b, 0);
        if (!is_new) return at->second;
        const auto lead = [&](std::uint32_t vertex) {
            const glm::dvec3 point = mesh_.points[vertex];
            return nearest_of(owners_[b], point).distance - nearest_of(owners_[a], point).distance;
        };
        const double here = std::max(0.0, lead(a)), there = std::max(0.0, -lead(b));
        const double share = here + there > 0 ? std::clamp(here / (here + there), 0.05, 0.95) : 0.5;
        return at->second = add_point(mesh_.points[a] + share * (mesh_.points[b] - mesh_.points[a]),
                                      mesh_.normals[a] + share * (mesh_.normals[b] - mesh_.normals[a]));
    }

    // Between limbs, so that the textures of two meet in a line.
    void cut(const Triangle& t) {
        const auto owner = [&](std::size_t k) { return owners_[t[k % 3]]; };
        if (owner(0) == owner(1) && owner(1) == owner(2)) return keep(owner(0), t);
        if (owner(0) != owner(1) && owner(1) != owner(2) && owner(2) != owner(0)) return cut_in_three(t);
        std::size_t lone = 0;
        while (owner(lone + 1) != owner(lone + 2)) ++lone;
        const std::uint32_t a = t[lone], b = t[(lone + 1) % 3], c = t[(lone + 2) % 3];
        const std::uint32_t ab = cut_of(a, b), ac = cut_of(a, c);
        keep(owners_[a], {a, ab, ac});
        keep(owners_[b], {ab, b, c});
        keep(owners_[b], {ab, c, ac});
    }

    void cut_in_three(const Triangle& t) {
        glm::dvec3 middle(0), normal(0);
        for (const std::uint32_t corner : t) {
            middle += mesh_.points[corner] / 3.0;
            normal += mesh_.normals[corner];
        }
        const std::uint32_t centre = add_point(middle, normal);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t here = t[k], ahead = cut_of(here, t[(k + 1) % 3]),
                                behind = cut_of(t[(k + 2) % 3], here);
            keep(owners_[here], {here, ahead, centre});
            keep(owners_[here], {here, centre, behind});
        }
    }

    void keep(std::uint32_t limb, const Triangle& triangle) { patches_[limb].push_back(triangle); }

    /// Where a point of the surface lies on a limb's texture, and the line's node whose attributes it has.
    struct Place {
        glm::dvec2 uv;
        std::uint32_t node;
        double picture;      ///< its width there, metres
        glm::dvec3 tangent;  ///< tangent of the limb
    };

    // Planes across the curve's nodes, not the nearest point, so that the texture stretches evenly in bends.
    Place place_on(const Limb& limb, std::uint32_t end, const glm::dvec3& point) const {
        const std::vector<TubeNode>& nodes = limb.curve.nodes;
        const auto ahead = [&](std::uint32_t node) {
            return glm::dot(point - glm::dvec3(nodes[node].position), limb.frames[node].tangent);
        };
        while (end > 1 && ahead(end - 1) < 0) --end;
        while (end + 1 < nodes.size() && ahead(end) > 0) ++end;
        const TubeFrame &from = limb.frames[end - 1], &to = limb.frames[end];
        const double passed = ahead(end - 1), left_over = -ahead(end);
        const double share = std::clamp(passed / std::max(1e-12, passed + left_over), 0.0, 1.0);
        const glm::dvec3 base = nodes[end - 1].position, tip = nodes[end].position;
        const glm::dvec3 off = point - (base + share * (tip - base));
        const glm::dvec3 across = from.across + share * (to.across - from.across);
        const glm::dvec3 tangent = from.tangent + share * (to.tangent - from.tangent);
        const glm::dvec3 left = glm::cross(tangent, across);
        const double turn = std::atan2(glm::dot(off, left), glm::dot(off, across)) / (2 * std::numbers::pi);
        const double beyond = passed < 0 ? passed : std::max(0.0, -left_over);  // on a rounded end
        const double picture =
            limb.curve.pictures_around == 0
                ? 1
                : 2 * std::numbers::pi * nodes[passed < 0 ? end - 1 : end].radius / limb.curve.pictures_around;
        const double around = std::max(1, limb.curve.pictures_around);
        return {
            {around * (turn < 0 ? turn + 1 : turn), from.along + share * (to.along - from.along) + beyond / picture},
            limb.node_of[end],
            picture,
            glm::normalize(tangent)};
    }

    /// Moves points into the furrows of the bark. Points are moved once, whatever patches share them, so that the
    /// surface stays closed; where limbs meet, which wear other pictures, and on flat ends they stay.
    void displace() {
        placed_ = mesh_.points;
        for (std::uint32_t i = 0; i < owners_.size(); ++i) {
            const BarkRelief* const relief = reliefs_[owners_[i]];
            if (!relief) continue;
            const glm::dvec3 &point = mesh_.points[i], &normal = mesh_.normals[i];
            const Nearest own = nearest_of(owners_[i], point);
            double lead = std::numeric_limits<double>::infinity();
            limbs_.nearest(point, set_->near(point), found_);
            for (const Nearest& other : found_) {
                if (limbs_.pieces()[other.piece].limb != owners_[i])
                    lead = std::min(lead, other.distance - own.distance);
            }
            const Place at = place_on(curves_[owners_[i]], limbs_.pieces()[own.piece].node, point);
            const double fade = 2 * (voxel_ + relief->depth * at.picture);
            const double share = std::clamp(lead / fade, 0.0, 1.0), along = glm::dot(normal, at.tangent);
            const double weight = share * share * (3 - 2 * share) * (1 - along * along);
            placed_[i] -= weight * at.picture * relief->furrow(at.uv.x, at.uv.y) * normal;
        }
    }

    void add_patch(std::uint32_t limb, Tube& tube) {
        if (patches_[limb].empty()) return;
        const Limb& curve = curves_[limb];
        const double around = std::max(1, curve.curve.pictures_around);
        std::unordered_map<std::uint32_t, Place> places;
        std::map<std::pair<std::uint32_t, bool>, std::uint32_t> numbers;  // with those beyond the texture's seam
        for (const Triangle& triangle : patches_[limb]) {
            std::array<Place, 3> at{};
            double farthest = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [known, is_new] = places.try_emplace(triangle[k]);
                if (is_new) {
                    const glm::dvec3& point = mesh_.points[triangle[k]];
                    known->second = place_on(curve, limbs_.pieces()[nearest_of(limb, point).piece].node, point);
                }
                at[k] = known->second;
                farthest = std::max(farthest, at[k].uv.x);
            }
            TubeTriangle made{{}, at[0].node};
            for (std::size_t k = 0; k < 3; ++k) {
                const bool is_beyond = farthest - at[k].uv.x > around / 2;
                const auto next = static_cast<std::uint32_t>(tube.vertices.size());
                const auto [number, is_new] = numbers.try_emplace({triangle[k], is_beyond}, next);
                made.corners[k] = number->second;
                if (!is_new) continue;
                const glm::dvec2 uv(at[k].uv.x + (is_beyond ? around : 0), at[k].uv.y);
                tube.vertices.push_back({glm::vec3(placed_[triangle[k]]), glm::vec3(mesh_.normals[triangle[k]]),
                                         glm::vec2(uv), at[k].node});
            }
            tube.triangles.push_back(made);
        }
    }

    const std::vector<std::size_t>& members_;
    double voxel_;
    std::vector<Limb> curves_;  ///< curve of each member
    LimbUnion limbs_;
    std::optional<LimbLevelSet> set_;
    LimbMesh mesh_;
    std::vector<const BarkRelief*> reliefs_;  ///< relief of each member; null: none
    std::vector<glm::dvec3> placed_;          ///< where the points of the mesh are drawn
    std::vector<std::uint32_t> owners_;       ///< the limb nearest to each point of the level set
    std::unordered_map<std::uint64_t, std::uint32_t> cuts_;
    std::vector<std::vector<Triangle>> patches_;  ///< triangles of each limb
    std::vector<Nearest> found_;
};

/// What is too thin for the level set; it begins inside.
void add_thin_rest(const TubeLine& line, int sides, double voxel, Tube& tube) {
    const std::size_t thick = thick_nodes(line, voxel), first = thick == 0 ? 0 : thick - 1;
    if (first + 1 == line.nodes.size()) return;
    TubeLine rest = line;
    rest.nodes.erase(rest.nodes.begin(), rest.nodes.begin() + static_cast<std::ptrdiff_t>(first));
    Tube swept = sweep(rest, sides);
    const auto origin = static_cast<std::uint32_t>(tube.vertices.size());
    for (TubeVertex& vertex : swept.vertices) {
        vertex.node += static_cast<std::uint32_t>(first);
        tube.vertices.push_back(vertex);
    }
    for (TubeTriangle& triangle : swept.triangles) {
        for (std::uint32_t& corner : triangle.corners) corner += origin;
        triangle.node += static_cast<std::uint32_t>(first);
        tube.triangles.push_back(triangle);
    }
}

}  // namespace

double skin_voxel(std::span<const AxisLine> lines, const AxisSkin& skin) {
    if (skin.voxel > 0) {
        const double quads = quads_at(lines, skin.voxel);
        if (quads <= most_quads) return skin.voxel;
        throw UserError(fmt::format(
            "--voxel {:g}: the skin would have about {:.0f} million triangles; the smallest voxel is {:.3g} m",
            skin.voxel, 2e-6 * quads, coarse_enough(lines, skin.voxel, most_quads)));
    }
    if (lines.empty()) return 1;
    double thinnest = std::numeric_limits<double>::infinity(), thickest = 0;
    for (const AxisLine& axis : lines) {
        for (const TubeNode& node : axis.line.nodes) {
            thinnest = std::min(thinnest, double(node.radius));
            thickest = std::max(thickest, double(node.radius));
        }
    }
    return coarse_enough(lines, std::max(thinnest / voxels_of_thinnest, thickest / voxels_of_thickest), wanted_quads);
}

std::vector<Tube> skin_of(std::span<const AxisLine> lines, std::span<const int> sides, const AxisSkin& skin) {
    const double voxel = skin_voxel(lines, skin);
    std::map<std::uint32_t, std::vector<std::size_t>> members;
    for (std::size_t i = 0; i < lines.size(); ++i) members[lines[i].plant].push_back(i);
    std::vector<Tube> tubes(lines.size());
    const Reliefs reliefs = reliefs_of(lines, skin);
    for (const auto& [plant, own] : members) Skin(lines, own, reliefs, skin.blend, voxel).cover(tubes);
    for (std::size_t i = 0; i < lines.size(); ++i) add_thin_rest(lines[i].line, sides[i], voxel, tubes[i]);
    return tubes;
}

}  // namespace espalier::archive
