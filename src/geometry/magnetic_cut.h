// Cross-sections that a ring of magnets pulls out and pushes in.
#pragma once

#include "espalier/geometry/contour.h"

#include <vector>

namespace espalier::geometry {

/// An ellipse, `thickness` along x and 1 along y, whose outline goes out or in by its strength, in radii, at each of
/// the magnets. These stand at equal angles, the first on the +x axis, the next towards +y. Between two magnets the
/// outline stays between their strengths; -1 draws it to the middle, and nothing draws it beyond. Without magnets it is
/// the ellipse. A flat cut is the line half-way between the upper and the lower outline.
struct MagneticCut {
    double thickness = 1;
    std::vector<double> strengths;
    bool flat = false;

    /// `sides` + 1 vertices: at equal angles; of a flat cut at equal distances of its ellipse, from -y to +y.
    std::vector<Contour::Vertex> sample(int sides) const;
};

}  // namespace espalier::geometry
