#include "environment/soil/hydraulics/saxton_rawls.h"

#include "espalier/base/math.h"

#include <algorithm>

namespace espalier::environment {
namespace {

constexpr double kpa_per_cm = 0.0980665;

}  // namespace

SaxtonRawls::SaxtonRawls(double sand_percent, double clay_percent, double organic) {
    const double sand = sand_percent / 100, clay = clay_percent / 100;
    const double first_1500 = -0.024 * sand + 0.487 * clay + 0.006 * organic + 0.005 * sand * organic -
                              0.013 * clay * organic + 0.068 * sand * clay + 0.031;
    at_1500_ = first_1500 + (0.14 * first_1500 - 0.02);
    const double first_33 = -0.251 * sand + 0.195 * clay + 0.011 * organic + 0.006 * sand * organic -
                            0.027 * clay * organic + 0.452 * sand * clay + 0.299;
    at_33_ = first_33 + (1.283 * first_33 * first_33 - 0.374 * first_33 - 0.015);
    const double first_drained = 0.278 * sand + 0.034 * clay + 0.022 * organic - 0.018 * sand * organic -
                                 0.027 * clay * organic - 0.584 * sand * clay + 0.078;
    const double drained = first_drained + (0.636 * first_drained - 0.107);  // between full and 33 kPa
    const double first_entry = -21.67 * sand - 27.93 * clay - 81.97 * drained + 71.12 * sand * drained +
                               8.29 * clay * drained + 14.05 * sand * clay + 27.16;
    // In some sands the fit is below 0, where a soil drains at once.
    air_entry_ = std::max(first_entry + (0.02 * first_entry * first_entry - 0.113 * first_entry - 0.70), 0.1);
    saturated_ = at_33_ + drained - 0.097 * sand + 0.043;
    b_ = (math::log(1500) - math::log(33)) / (math::log(at_33_) - math::log(at_1500_));
    constexpr double mm_per_hour = 2.4;  // cm/d
    conductivity_ = mm_per_hour * 1930 * math::any_power(saturated_ - at_33_, 3 - 1 / b_);
}

double SaxtonRawls::content(double head) const {
    const double tension = -head * kpa_per_cm;
    if (tension <= air_entry_) return saturated_;
    if (tension < 33) return at_33_ + (saturated_ - at_33_) * (33 - tension) / (33 - air_entry_);
    return at_33_ * math::any_power(tension / 33, -1 / b_);
}

double SaxtonRawls::conductivity(double head) const {
    return conductivity_ * math::any_power(content(head) / saturated_, 3 + 2 * b_);
}

}  // namespace espalier::environment
