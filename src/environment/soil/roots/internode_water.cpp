#include "environment/soil/roots/internode_water.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace espalier::environment {
namespace {

struct RootQuantity {
    OrganQuantity told;
    bool is_sum;  ///< over the pieces; else the mean over their length
    std::function<double(const PlantUptake&, std::size_t piece)> of;
};

const std::vector<RootQuantity>& known() {
    const auto water = [](std::vector<double> PlantWater::*column) {
        return [column](const PlantUptake& plant, std::size_t piece) { return (plant.water().*column)[piece]; };
    };
    static const std::vector<RootQuantity> all{
        {{"head", "cm", "pressure head in the root"}, false, water(&PlantWater::xylem)},
        {{"uptake", "cm3/d", "water that the root takes from the soil"}, true, water(&PlantWater::uptake)},
        {{"mean_uptake", "cm3/d", "the same, as the mean of the step"},
         true,
         [](const PlantUptake& plant, std::size_t piece) { return plant.mean_uptake(piece); }},
        {{"soil", "cm", "pressure head of the soil at the root's surface"}, false, water(&PlantWater::surface)},
        {{"fraction", "", "of the uptake from uniform soil (SUF)"}, true, water(&PlantWater::fractions)},
        {{"radial", "1/d", "conductivity of the root's surface"},
         false,
         [](const PlantUptake& plant, std::size_t piece) { return plant.radial()[piece]; }},
        {{"axial", "cm3/d", "conductance along the root times its length"},
         false,
         [](const PlantUptake& plant, std::size_t piece) { return plant.roots().pieces[piece].axial; }},
    };
    return all;
}

}  // namespace

InternodeWater water_in(const PlantUptake& plant, std::uint32_t internode) {
    const PlantRoots& roots = plant.roots();
    const PlantWater& water = plant.water();
    const auto [first, end] = std::equal_range(roots.internodes.begin(), roots.internodes.end(), internode);
    InternodeWater sum;
    double length = 0;
    for (auto at = first; at != end; ++at) {
        const auto i = static_cast<std::size_t>(at - roots.internodes.begin());
        length += roots.pieces[i].length;
        sum.xylem += roots.pieces[i].length * water.xylem[i];
        sum.surface += roots.pieces[i].length * water.surface[i];
        sum.uptake += water.uptake[i];
        sum.fraction += water.fractions[i];
    }
    if (length > 0) {
        sum.xylem /= length;
        sum.surface /= length;
    }
    return sum;
}

std::vector<OrganQuantity> root_quantities() {
    std::vector<OrganQuantity> all;
    for (const RootQuantity& quantity : known()) all.push_back(quantity.told);
    return all;
}

std::shared_ptr<const std::vector<float>> root_values(const PlantUptake& plant, const std::string& name) {
    const auto quantity =
        std::find_if(known().begin(), known().end(), [&](const RootQuantity& one) { return one.told.name == name; });
    if (quantity == known().end()) return nullptr;
    const PlantRoots& roots = plant.roots();
    std::vector<double> sums(roots.modules_in_string, 0), lengths(roots.modules_in_string, 0);
    for (std::size_t i = 0; i < roots.pieces.size(); ++i) {
        const double length = roots.pieces[i].length;
        sums[roots.modules[i]] += (quantity->is_sum ? 1 : length) * quantity->of(plant, i);
        lengths[roots.modules[i]] += length;
    }
    auto values = std::make_shared<std::vector<float>>();
    for (std::size_t m = 0; m < sums.size(); ++m) {
        const double divisor = lengths[m] > 0 ? (quantity->is_sum ? 1 : lengths[m]) : 0;
        values->push_back(static_cast<float>(divisor > 0 ? sums[m] / divisor : std::nan("")));
    }
    return values;
}

}  // namespace espalier::environment
