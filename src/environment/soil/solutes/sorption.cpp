#include "environment/soil/solutes/sorption.h"

#include "espalier/base/math.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {

double Sorption::amount(double content, double concentration) const {
    if (coefficient == 0 || !(concentration > 0)) return content * concentration;
    return content * concentration + density * coefficient * math::pow(concentration, exponent);
}

double Sorption::capacity(double content, double concentration) const {
    if (coefficient == 0) return content;
    if (exponent == 1) return content + density * coefficient;
    const double dilute = std::max(concentration, 1e-12);
    return content + density * coefficient * exponent * math::pow(dilute, exponent - 1);
}

double Sorption::least_capacity(double content) const {
    return exponent == 1 ? content + density * coefficient : content;
}

double Sorption::concentration(double content, double amount) const {
    if (coefficient == 0 || exponent == 1) return amount / (content + density * coefficient);
    if (!(amount > 0)) return 0;
    // Newton's method between what it would be without solids, or without water, and 0.
    double low = 0, high = std::min(amount / content, math::pow(amount / (density * coefficient), 1 / exponent));
    double guess = high;
    for (int i = 0; i < 200; ++i) {
        const double excess = this->amount(content, guess) - amount;
        (excess > 0 ? high : low) = guess;
        double next = guess - excess / capacity(content, guess);
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        const bool done = std::abs(next - guess) <= 1e-14 * guess;
        guess = next;
        if (done) break;
    }
    return guess;
}

}  // namespace espalier::environment
