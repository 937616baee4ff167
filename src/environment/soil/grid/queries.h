// What the queries of a step sense in a soil, and what they obtain of its water.
#pragma once

#include "espalier/environment/environment_process.h"

#include "environment/soil/grid/direction.h"
#include "environment/soil/grid/grid.h"
#include "environment/soil/grid/parameters.h"
#include "environment/soil/grid/uptake.h"

#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace espalier::environment {

/// The soil that is sensed.
struct SensedSoil {
    const WaterGrid& grid;
    const WaterFaces& faces;
    const WaterSolids& solids;
    const WaterBrick& contents;
    bool joined_x = false, joined_z = false;                     ///< sides with those across
    std::function<glm::dvec3(double height)> down_at = nullptr;  ///< null: straight down everywhere
};

/// Answers queries, and keeps what each plant wished and obtained in the step.
class SoilQueries {
public:
    /// `querying` lives as long as this.
    SoilQueries(const SoilQuerying& querying, const EnvironmentContext& context);

    /// Writes what each query senses and obtains into its answer. `soil.drink(take)` is to call take(stock), which
    /// takes from a brick of what may be taken and returns the sum, in content times voxels. Throws RunError for a
    /// parameter that is not finite.
    template <class Soil>
    void answer(const SensedSoil& sensed, Queries queries, std::span<Answer> answers, Soil& soil) {
        const std::vector<WaterWish> wishes = sense(sensed, queries, answers);
        if (wishes.empty()) return;
        soil.drink([&](WaterBrick& stock) { return obtain(sensed.grid, wishes, queries, answers, stock); });
    }

    /// Uptake and wish of a plant, and then `others`.
    std::vector<Quantity> statistics(std::uint32_t plant, std::vector<Quantity> others) const;
    void save(std::ostream& out) const;
    void restore(std::istream& in);

private:
    std::vector<WaterWish> sense(const SensedSoil& soil, Queries queries, std::span<Answer> answers);
    double obtain(const WaterGrid& grid, std::span<const WaterWish> wishes, Queries queries, std::span<Answer> answers,
                  WaterBrick& stock);
    void warn_of_wishes_beyond_voxels(Queries queries);

    const SoilQuerying& querying_;
    std::string name_;
    std::vector<Diagnostic>* warnings_;  ///< null as soon as there was one
    std::vector<double> uptake_, wish_;  ///< per plant, this step
};

/// The settings of `querying` that keyframes change.
std::vector<ChangingSetting> changing_settings_of(SoilQuerying& querying);

}  // namespace espalier::environment
