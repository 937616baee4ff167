#include "environment/soil/richards/time_steps.h"

#include "base/bytes.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {

SoilTimeSteps::SoilTimeSteps(const SoilLayout& layout) : layout_(layout), next_(1e-5) {
    for (WaterBrick* brick : {&rate_, &theta_0_}) brick->assign(layout.grid().cells(), 0.0);
}

double SoilTimeSteps::next(double longest) const {
    const double days = std::min(next_, longest);
    return days > 0.6 * longest && days < longest ? 0.5 * longest : days;
}

double SoilTimeSteps::begin(const WaterBrick& content, double days) {
    theta_0_ = content;
    if (!has_rate_ || !smooth_ || last_ <= 0) return 1;
    const double ratio = days / last_;
    const double onward = ratio * ratio / (1 + 2 * ratio) * last_;
    bool is_in_range = true;
    layout_.for_each_free([&](std::size_t c) {
        theta_0_[c] = content[c] + onward * rate_[c];
        const SoilKind& soil = layout_.kind(c).soil();
        is_in_range = is_in_range && theta_0_[c] <= soil.saturated &&
                      theta_0_[c] > soil.residual + 0.5 * (content[c] - soil.residual);
    });
    if (is_in_range) return (1 + ratio) / (1 + 2 * ratio);
    theta_0_ = content;
    return 1;
}

double SoilTimeSteps::error(std::span<const SoilPoint> points, const WaterBrick& content, double days) const {
    double error = 0;
    if (!has_rate_) return error;
    layout_.for_each_free([&](std::size_t c) {
        const double rate = (points[c].content - content[c]) / days;
        error = std::max(error, 0.5 * days * std::abs(rate - rate_[c]));
    });
    return error;
}

void SoilTimeSteps::accept(double days, bool smooth) {
    has_rate_ = true;
    smooth_ = smooth;
    last_ = days;
}

void SoilTimeSteps::lengthen(double days, double fitting) {
    next_ = std::max(next_ > days && fitting >= 1 ? next_ : 0, days * fitting);
}

void SoilTimeSteps::save(std::ostream& out) const {
    for (const double number : {next_, last_, has_rate_ ? 1.0 : 0.0, smooth_ ? 1.0 : 0.0}) put(out, number);
}

void SoilTimeSteps::restore(std::istream& in) {
    next_ = get<double>(in);
    last_ = get<double>(in);
    has_rate_ = get<double>(in) != 0;
    smooth_ = get<double>(in) != 0;
}

}  // namespace espalier::environment
