#include "archive/meshes/limb_level_set.h"

#include "espalier/base/random.h"
#include "espalier/geometry/openvdb_grid.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <openvdb/tools/LevelSetMeasure.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <utility>

namespace espalier::archive {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;
using BlockPlace = std::array<int, 3>;

constexpr double half_band = 3;                         // voxels
constexpr int block_width = 8;                          // voxels of a leaf
const double block_radius = 5.5 * std::numbers::sqrt3;  // voxels around its centre, with those between two blocks

struct PlaceHash {
    std::size_t operator()(const BlockPlace& place) const {
        const auto part = [](int i) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(i)); };
        return mix(mix(part(place[0]), part(place[1])), part(place[2]));
    }
};

/// A leaf of the level set and the pieces that matter in it.
struct VoxelBlock {
    BlockPlace place;
    std::vector<std::uint32_t> pieces;
    std::vector<double> distances;  ///< distances of its centre from them
    std::uint32_t limb = 0;         ///< limb of the last pieces, from `first` on
    std::size_t first = 0;
    double least = 0;  ///< distance of these

    /// Pieces of one limb follow each other. Those that cannot be the nearest of their limb anywhere in the block stay
    /// out.
    void add(std::uint32_t piece, std::uint32_t of_limb, double distance, double slack) {
        if (pieces.empty() || of_limb != limb) {
            limb = of_limb;
            first = pieces.size();
            least = distance;
        }
        if (distance > least + 2 * slack) return;
        pieces.push_back(piece);
        distances.push_back(distance);
        if (distance >= least) return;
        least = distance;
        std::size_t kept = first;
        for (std::size_t i = first; i < pieces.size(); ++i) {
            if (distances[i] > least + 2 * slack) continue;
            pieces[kept] = pieces[i];
            distances[kept++] = distances[i];
        }
        pieces.resize(kept);
        distances.resize(kept);
    }
};

/// What is known of a place before it becomes a block.
struct Surroundings {
    std::uint32_t limb;
    bool is_near = false;    ///< the surface of a limb may be in it
    bool is_shared = false;  ///< what fills a joint may be in it
    bool is_inside = false;
};

}  // namespace

struct LimbLevelSet::Body {
    Body(const LimbUnion& union_of, double width) : limbs(union_of), voxel(width) {
        initialize_openvdb();
        find_blocks();
        fill_grid();
    }

    const LimbUnion& limbs;
    double voxel;
    glm::dvec3 origin{std::numeric_limits<double>::infinity()};
    std::vector<VoxelBlock> blocks;
    std::unordered_map<BlockPlace, std::size_t, PlaceHash> number_at;
    openvdb::FloatGrid::Ptr grid;

    BlockPlace place_of(const glm::dvec3& point) const {
        const glm::dvec3 index = (point - origin) / voxel / double(block_width);
        const auto whole = [](double value) { return static_cast<int>(std::floor(value)); };
        return {whole(index.x), whole(index.y), whole(index.z)};
    }

    glm::dvec3 centre_of(const BlockPlace& place) const {
        const glm::dvec3 first(place[0], place[1], place[2]);
        return origin + voxel * (double(block_width) * first + 0.5 * (block_width - 1));
    }

    void find_blocks() {
        const std::vector<LimbPiece>& pieces = limbs.pieces();
        for (const LimbPiece& piece : pieces) origin = glm::min(origin, glm::min(piece.base, piece.tip));
        // A flat base must not lie on voxels' centres, where the mesh would have triangles without area.
        origin -= voxel * glm::dvec3(0.37, 0.41, 0.43);
        const double slack = block_radius * voxel, near = half_band * voxel + slack;
        std::unordered_map<BlockPlace, Surroundings, PlaceHash> places;
        for (const LimbPiece& piece : pieces) {
            each_place(piece, near + limbs.deepest_fill(piece), [&](const BlockPlace& place, double distance) {
                Surroundings& here = places.try_emplace(place, Surroundings{piece.limb}).first->second;
                here.is_shared = here.is_shared || here.limb != piece.limb;
                here.is_near = here.is_near || distance <= near;
                here.is_inside = here.is_inside || distance < -near;
            });
        }
        for (const auto& [place, here] : places) {
            if (here.is_inside || !(here.is_near || here.is_shared)) continue;
            number_at.emplace(place, blocks.size());
            blocks.push_back({place, {}, {}});
        }
        for (std::uint32_t i = 0; i < pieces.size(); ++i) {
            each_place(pieces[i], near + limbs.reach(pieces[i]), [&](const BlockPlace& place, double distance) {
                const auto at = number_at.find(place);
                if (at != number_at.end()) blocks[at->second].add(i, pieces[i].limb, distance, slack);
            });
        }
    }

    /// The blocks whose centres lie no farther than `most` from a piece.
    template <class Visit>
    void each_place(const LimbPiece& piece, double most, const Visit& visit) const {
        const double around = std::max(piece.base_radius, piece.tip_radius) + most;
        const BlockPlace lower = place_of(glm::min(piece.base, piece.tip) - around);
        const BlockPlace upper = place_of(glm::max(piece.base, piece.tip) + around);
        for (int x = lower[0]; x <= upper[0]; ++x) {
            for (int y = lower[1]; y <= upper[1]; ++y) {
                for (int z = lower[2]; z <= upper[2]; ++z) {
                    const BlockPlace place{x, y, z};
                    const double distance = distance_to(piece, centre_of(place));
                    if (distance <= most) visit(place, distance);
                }
            }
        }
    }

    void fill_grid() {
        const auto background = static_cast<float>(half_band * voxel);
        grid = openvdb::FloatGrid::create(background);
        grid->setTransform(voxel_transform(voxel));
        grid->setGridClass(openvdb::GRID_LEVEL_SET);
        std::vector<std::unique_ptr<Leaf>> leaves(blocks.size());
        tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) { leaves[i] = leaf_of(blocks[i]); });
        for (auto& leaf : leaves) grid->tree().addLeaf(leaf.release());
        openvdb::tools::signedFloodFill(grid->tree());
    }

    std::unique_ptr<Leaf> leaf_of(const VoxelBlock& block) const {
        const auto background = static_cast<float>(half_band * voxel);
        const openvdb::Coord first(block_width * block.place[0], block_width * block.place[1],
                                   block_width * block.place[2]);
        auto leaf = std::make_unique<Leaf>(first, background);
        std::vector<LimbUnion::Nearest> found;
        for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
            const openvdb::Coord at = leaf->offsetToGlobalCoord(i);
            const glm::dvec3 point = origin + voxel * glm::dvec3(at.x(), at.y(), at.z());
            limbs.nearest(point, block.pieces, found);
            const auto distance = static_cast<float>(limbs.distance(point, found));
            if (std::abs(distance) < background) {
                leaf->setValueOn(i, distance);
            } else {
                leaf->setValueOff(i, distance < 0 ? -background : background);
            }
        }
        return leaf;
    }

    std::span<const std::uint32_t> near(const glm::dvec3& point) const {
        // A point between the last voxel of a block and the first of the next belongs to either.
        const BlockPlace place = place_of(point);
        for (const int x : {0, 1}) {
            for (const int y : {0, 1}) {
                for (const int z : {0, 1}) {
                    const auto at = number_at.find({place[0] + x, place[1] + y, place[2] + z});
                    if (at != number_at.end()) return blocks[at->second].pieces;
                }
            }
        }
        return {};
    }

    /// The union's distance and its gradient by central differences.
    std::pair<double, glm::dvec3> sample(const glm::dvec3& point, std::span<const std::uint32_t> pieces,
                                         std::vector<LimbUnion::Nearest>& found) const {
        const auto distance = [&](const glm::dvec3& at) {
            limbs.nearest(at, pieces, found);
            return limbs.distance(at, found);
        };
        const double step = 0.2 * voxel;
        glm::dvec3 gradient(0);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 off(0);
            off[axis] = step;
            gradient[axis] = (distance(point + off) - distance(point - off)) / (2 * step);
        }
        return {distance(point), gradient};
    }

    /// Newton's method along the gradient.
    void project(glm::dvec3& point, glm::dvec3& normal) const {
        const std::span<const std::uint32_t> pieces = near(point);
        std::vector<LimbUnion::Nearest> found;
        const glm::dvec3 start = point;
        for (int i = 0; i < 3; ++i) {
            const auto [distance, gradient] = sample(point, pieces, found);
            const double square = glm::dot(gradient, gradient);
            if (square < 1e-6) break;
            normal = gradient / std::sqrt(square);
            glm::dvec3 moved = point - distance / square * gradient - start;
            const double far = glm::length(moved), most = 0.5 * voxel;
            if (far > most) moved *= most / far;
            point = start + moved;
        }
    }
};

LimbLevelSet::LimbLevelSet(const LimbUnion& limbs, double voxel) : body_(std::make_unique<Body>(limbs, voxel)) {}

LimbLevelSet::~LimbLevelSet() = default;

double LimbLevelSet::volume() const {
    return openvdb::tools::levelSetVolume(*body_->grid);
}

std::span<const std::uint32_t> LimbLevelSet::near(const glm::dvec3& point) const {
    return body_->near(point);
}

LimbMesh LimbLevelSet::mesh() const {
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec4I> quads;
    openvdb::tools::volumeToMesh(*body_->grid, points, quads, 0.0);
    LimbMesh mesh;
    mesh.points.resize(points.size());
    mesh.normals.assign(points.size(), glm::dvec3(0, 1, 0));
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
        mesh.points[i] = body_->origin + glm::dvec3(points[i].x(), points[i].y(), points[i].z());
        body_->project(mesh.points[i], mesh.normals[i]);
    });
    for (const openvdb::Vec4I& quad : quads) {
        // OpenVDB counts corners clockwise. The shorter diagonal folds a curved quad less.
        const std::uint32_t a = quad[3], b = quad[2], c = quad[1], d = quad[0];
        const auto length = [&](std::uint32_t i, std::uint32_t k) {
            return glm::distance(mesh.points[i], mesh.points[k]);
        };
        if (length(a, c) <= length(b, d)) {
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
        } else {
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
        }
    }
    return mesh;
}

}  // namespace espalier::archive
