#include "analysis/line_fit.h"

#include <cmath>
#include <limits>

namespace espalier::analysis {

LineFit fit_line(std::span<const double> x, std::span<const double> y) {
    const auto n = static_cast<double>(x.size());
    double mean_x = 0, mean_y = 0;
    for (std::size_t i = 0; i < x.size(); ++i) mean_x += x[i] / n, mean_y += y[i] / n;
    double xx = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (!(xx > 0)) return {nan, nan, nan};
    LineFit fit{xy / xx, mean_y - xy / xx * mean_x, nan};
    double squares = 0;
    for (std::size_t i = 0; i < x.size(); ++i) squares += std::pow(y[i] - fit.intercept - fit.slope * x[i], 2);
    if (x.size() > 2) fit.error = std::sqrt(squares / (n - 2) / xx);
    return fit;
}

}  // namespace espalier::analysis
