// What is known of one module of a growth: who it is, where it comes from, what it was told.
#pragma once

#include "espalier/simulation/scene.h"

#include "studio/growth/kept_steps.h"
#include "studio/growth/organ_columns.h"
#include "studio/protocol/picked.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::studio {

/// The answer to `pick`. `module` is counted through all plants; the course of its day is told in `organs`. Throws
/// UserError if there is no such step or module.
Picked module_info(const Scene& scene, const KeptSteps& steps, std::span<const OrganColumn> organs, int step,
                   std::uint32_t module);

/// The steps whose light is that of one day.
struct StepsOfDay {
    int first = 0, last = 0, stride = 1;  ///< at most a hundred are looked at
    double hours = 0;                     ///< of a step

    double hour_at_end_of(int step) const { return (step - first + 1) * hours + before; }
    double before = 0;  ///< hours of the day before the first of its steps begins
};
/// Where a day has at least four steps of `dt` units; step 0 has the light of step 1.
std::optional<StepsOfDay> steps_of_day(double dt, const std::string& unit, int step);

/// What modules can be coloured by.
std::vector<std::string> column_names(const Scene& scene);
/// The message `ESC1` with one number a module. Throws UserError if there is no such step or column.
std::string column(const Scene& scene, const KeptSteps& steps, std::uint32_t growth, int step, const std::string& name);

}  // namespace espalier::studio
