// Control points of side files as pages see and move them.
#pragma once

#include "studio/protocol/declaration.h"

namespace espalier::studio {

struct CurvePoint {
    static constexpr TypeName type{"CurvePoint", "a control point"};
    double x = 0, y = 0, z = 0;
    int times = 1;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("x", self.x, "coordinate");
        field("y", self.y, "coordinate");
        field("z", self.z, "coordinate; 0 where its file has none");
        field("times", self.times, "how often the point counts: three times make a corner", at_least(1));
    }
};

struct PointCurve {
    static constexpr TypeName type{"PointCurve", "the control points of a function, a curve or a patch of a surface"};
    std::string path, name, kind, spline;
    std::vector<CurvePoint> points;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("path", self.path, "path of its text; several may stand in one");
        field("name", self.name, "as the file names it; may be empty");
        field("kind", self.kind, "x of a `function` grows from 0 to 1; a `patch` has 16 points in rows",
              one_of("function contour patch"));
        field("spline", self.spline, "cubic B-spline, of which `clamped` reaches its ends; `other` is none",
              one_of("open closed clamped other"));
        field("points", self.points, "in the order of the text");
    }
};

}  // namespace espalier::studio
