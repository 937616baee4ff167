// What expressions of a model may ask of the files that stand beside it: functions, curves, the view volume.
#pragma once

#include "espalier/base/stations.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace espalier::lsystem {

/// func(id, x): a plane cubic B-spline through whose ends the curve goes, drawn so that it is a function on [0, 1].
class FunctionCurve {
public:
    /// The constant 0.
    FunctionCurve() = default;
    /// Control points, each as often as its multiplicity says, at least four; throws UserError for fewer.
    /// More than two samples: tabulated at so many places and interpolated linearly between them.
    FunctionCurve(std::vector<glm::dvec2> points, int samples);

    /// `x` outside [0, 1] is moved to its nearer end.
    double operator()(double x) const;

private:
    glm::dvec2 at_parameter(double d) const;
    double exact(double x) const;

    std::vector<glm::dvec2> points_;
    std::vector<double> samples_;
};

/// curveX(id, t), curveY, curveZ, curveGAL: a curve in space, t in [0, 1] along its length.
class SpaceCurve {
public:
    enum class Type { b_spline, closed, end_point, phantom, bezier };

    /// Control points, each as often as its multiplicity says, at least four; `samples` chords measure the length.
    /// Throws UserError for fewer.
    SpaceCurve(std::vector<glm::dvec3> points, Type type, int samples = 100);

    glm::dvec3 operator()(double t) const;
    double length() const { return length_; }

private:
    glm::dvec3 at_parameter(double t) const;

    std::vector<glm::dvec3> points_;
    Type type_;
    std::vector<double> lengths_;  // cumulative, divided by their sum
    double length_ = 0;
};

/// Numbered from 1 in the language: func(1, x) asks functions[0].
struct Resources {
    std::vector<FunctionCurve> functions;
    std::vector<SpaceCurve> curves;
    // The view volume: vvXmin and its like. Without a window, x and y are 0.
    double x_min = 0, x_max = 0, y_min = 0, y_max = 0;
    double z_min = -100000, z_max = 100000;
    double view_scale = 1;
};

}  // namespace espalier::lsystem
