#include "lsystem/programs/side_values.h"

#include "lsystem/programs/functions.h"

#include <fmt/format.h>

#include <cmath>

namespace espalier::lsystem {
namespace {

/// An element counted from 1 by a number that is truncated; null if there is none.
template <class T>
const T* numbered(const std::vector<T>& all, double id) {
    const double whole = std::trunc(id);
    return whole >= 1 && whole <= static_cast<double>(all.size()) ? &all[static_cast<std::size_t>(whole) - 1] : nullptr;
}

}  // namespace

double extent_of_view(const Resources& resources, std::uint32_t which) {
    const double extents[] = {resources.x_min, resources.x_max, resources.y_min,     resources.y_max,
                              resources.z_min, resources.z_max, resources.view_scale};
    return extents[which];
}

double side_value(const Resources* resources, Function function, std::span<const double> values,
                  const std::function<void(const std::string&)>& warn) {
    static const Resources none;
    const Resources& known = resources ? *resources : none;
    const FunctionCurve* const plane = function == Function::func ? numbered(known.functions, values[0]) : nullptr;
    const SpaceCurve* const space = function != Function::func ? numbered(known.curves, values[0]) : nullptr;
    if (!plane && !space) {
        const char* const what = function == Function::func ? "function" : "curve";
        const std::size_t count = function == Function::func ? known.functions.size() : known.curves.size();
        const std::string hint = count == 0 ? "a view file names them: give it with --view"
                                            : fmt::format("there are {}, counted from 1", count);
        warn(fmt::format("{}: there is no {} {:g}, so its value is 0; {}", name_of(function), what, values[0], hint));
        return 0;
    }
    if (function == Function::curve_gal) return space->length();
    if (std::isnan(values[1])) return values[1];
    if (plane) return (*plane)(values[1]);
    const glm::dvec3 point = (*space)(values[1]);
    return function == Function::curve_x ? point.x : function == Function::curve_y ? point.y : point.z;
}

}  // namespace espalier::lsystem
