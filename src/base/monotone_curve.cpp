// M. Steffen 1990: A simple method for monotonic interpolation in one dimension. Astron. Astrophys. 239, 443-450.
#include "base/monotone_curve.h"

#include <algorithm>
#include <cmath>

namespace espalier {
namespace {

class Curve {
public:
    Curve(std::span<const double> values, bool closed) : values_(values), closed_(closed) {}

    double at(double x) const {
        const long last = long(values_.size()) - (closed_ ? 0 : 1);
        if (!closed_) x = std::clamp(x, 0.0, double(last));
        const long k = closed_ ? long(std::floor(x)) : std::min(long(x), last - 1);
        const double t = x - double(k), a = slope(k), b = slope(k + 1), s = rise(k);
        return value(k) + t * (a + t * (3 * s - 2 * a - b + t * (a + b - 2 * s)));
    }

private:
    double value(long k) const {
        const auto count = long(values_.size());
        return values_[std::size_t(closed_ ? ((k % count) + count) % count : std::clamp(k, 0L, count - 1))];
    }
    double rise(long k) const { return value(k + 1) - value(k); }

    double slope(long k) const {
        const auto last = long(values_.size()) - 1;
        if (!closed_ && last > 1 && k == 0) return end_slope(rise(0), rise(1));
        if (!closed_ && last > 1 && k == last) return end_slope(rise(last - 1), rise(last - 2));
        if (!closed_ && last == 1) return rise(0);
        return monotone_slope(rise(k - 1), rise(k));
    }

    /// Returns the end slope of the parabola through three values, kept from overshooting.
    static double end_slope(double near, double far) {
        const double parabola = 1.5 * near - 0.5 * far;
        if (parabola * near <= 0) return 0;
        return std::abs(parabola) > 2 * std::abs(near) ? 2 * near : parabola;
    }

    std::span<const double> values_;
    bool closed_;
};

}  // namespace

double monotone_slope(double before, double after, double span_before, double span_after) {
    if (before * after <= 0) return 0;
    const double parabola = (before * span_after + after * span_before) / (span_before + span_after);
    return 2 * std::copysign(std::min({std::abs(before), std::abs(after), std::abs(parabola) / 2}), after);
}

double monotone_curve(std::span<const double> values, double x, bool closed) {
    if (values.empty()) return 0;
    return values.size() == 1 ? values[0] : Curve(values, closed).at(x);
}

}  // namespace espalier
