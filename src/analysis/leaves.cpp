#include "analysis/leaves.h"

#include "archive/facet_areas.h"

#include <unordered_map>

namespace espalier::analysis {
namespace {

/// Facets that follow each other in the file and belong to one module are one leaf.
class LeafBuilder {
public:
    void add(std::uint64_t identity, const FrameGeometry& geometry, std::span<const std::int32_t> facet, double area) {
        if (identity != identity_ || identity == 0) end();
        identity_ = identity;
        const auto corner = [&](std::size_t i) {
            return glm::dvec3(geometry.points[static_cast<std::size_t>(facet[i])]);
        };
        for (std::size_t i = 0; i < facet.size(); ++i) {
            const glm::dvec3 here = corner(i);
            leaves.corners.push_back(here);
            sum_ += here;
            ++corners_;
        }
        area_ += area;
    }
    void end() {
        if (corners_ > 0) leaves.leaves.push_back({sum_ / static_cast<double>(corners_), area_});
        sum_ = {0, 0, 0};
        area_ = 0;
        corners_ = 0;
    }

    Leaves leaves;

private:
    std::uint64_t identity_ = 0;
    glm::dvec3 sum_{0};
    double area_ = 0;
    std::size_t corners_ = 0;
};

}  // namespace

std::vector<Leaves> leaves_of(const FrameGeometry& geometry, std::span<const std::uint32_t> plants,
                              const std::set<std::string>& symbols, const std::filesystem::path& run) {
    std::unordered_map<std::uint32_t, std::size_t> place;
    for (const std::uint32_t plant : plants) place.emplace(plant, place.size());
    std::vector<bool> wanted(geometry.symbol_names.size(), symbols.empty());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (symbols.contains(geometry.symbol_names[i])) wanted[i] = true;
    }
    const archive::FacetAreas areas(geometry, run);
    std::vector<LeafBuilder> builders(place.size());
    const FrameAttributes& of = geometry.of_cells;
    for (std::size_t i = 0; i < geometry.polygons.size(); ++i) {
        const std::size_t cell = geometry.polygons.first + i;
        const Kind kind = of.kinds[cell];
        if (kind != Kind::polygon && kind != Kind::organ && kind != Kind::patch) continue;
        const auto known = place.find(of.plants[cell]);
        if (known == place.end() || of.symbols[cell] >= wanted.size() || !wanted[of.symbols[cell]]) continue;
        builders[known->second].add(of.identities[cell], geometry, geometry.polygons[i], areas.of(i));
    }
    std::vector<Leaves> result;
    for (LeafBuilder& builder : builders) {
        builder.end();
        result.push_back(std::move(builder.leaves));
    }
    return result;
}

double total_area(const Leaves& leaves) {
    double sum = 0;
    for (const Leaf& leaf : leaves.leaves) sum += leaf.area;
    return sum;
}

}  // namespace espalier::analysis
