// The form of a plant in numbers that do not depend on how finely its axes are divided into internodes.
#pragma once

#include "study/fit/growth.h"

#include <string>
#include <vector>

namespace espalier::study {

/// height, depth, width (m, above and below the foot, and the mean extent along x and z); length (m), surface (m2),
/// volume (m3) of all axes; leaves, leaf_area (m2); and of the orders 0 to 3 axes.K (their number), axis_length.K (m,
/// mean), axis_angle.K (degrees between an axis and what bears it, mean; of orders from 1 on).
const std::vector<std::string>& form_names();
/// The unit of one; "" for plain numbers. Throws UserError for a name that is none.
const char* unit_of_form(const std::string& name);
/// A row for each measured plant of the world. NaN for what a plant lacks.
std::vector<std::vector<double>> forms_of(const Grown& world);

}  // namespace espalier::study
