// Control points of functions, curves, contours and surfaces as the studio's page moves them: the text stays what its
// author wrote, but for the lines of the points that an edit is about.
#pragma once

#include "studio/protocol/points.h"

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::studio {

/// The curves of a side file in the order of its text; none of a file that has mistakes, has none, or has more points
/// than a person would move.
std::vector<PointCurve> read_curves(const std::filesystem::path& file, const std::string& text);

/// The text with other points of its curve `number`, from 0 on. Throws UserError if there is no such curve or if it
/// cannot have such points.
std::string with_curve_points(const std::filesystem::path& file, const std::string& text, int number,
                              const std::vector<CurvePoint>& points);

}  // namespace espalier::studio
