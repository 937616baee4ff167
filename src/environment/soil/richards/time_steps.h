// How a soil goes on in time: second-order steps, as long as their error allows.
#pragma once

#include "environment/soil/richards/cells.h"

#include <iosfwd>
#include <span>

namespace espalier::environment {

/// The second-order backward difference (BDF2), written as an implicit Euler step of a part of the substep, the
/// `weight`, from contents that are moved on with the rate before. The weight is 1, implicit Euler, at first, after a
/// jump, and where a content would leave its range.
class SoilTimeSteps {
public:
    explicit SoilTimeSteps(const SoilLayout& layout);

    /// Days of the next substep, at most `longest`; no crumb is left.
    double next(double longest) const;
    /// Begins a substep from these contents: sets theta_0 and returns the weight.
    double begin(const WaterBrick& content, double days);
    const WaterBrick& theta_0() const { return theta_0_; }
    /// Half the change of the rate, over the substep; 0 where no rate is known.
    double error(std::span<const SoilPoint> points, const WaterBrick& content, double days) const;
    /// The rate of the past tells nothing about the time to come.
    void jump() { smooth_ = false; }

    /// A substep with this rate holds; `smooth`: the next one is to go on from it.
    void accept(double days, bool smooth);

    // The next substep is as long as fits the error of that which was tried.
    void lengthen(double days, double fitting);
    void shorten(double days, double part) { next_ = days * part; }

    WaterBrick& rate() { return rate_; }  ///< of the last substep, content per day
    const WaterBrick& rate() const { return rate_; }
    /// What else checkpoints keep.
    void save(std::ostream& out) const;
    void restore(std::istream& in);

private:
    const SoilLayout& layout_;
    WaterBrick rate_, theta_0_;
    double next_, last_ = 0;  ///< days
    bool has_rate_ = false, smooth_ = false;
};

}  // namespace espalier::environment
