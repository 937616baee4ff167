// A soil as it was measured: contents and conductivities at pressure heads.
#pragma once

#include "environment/soil/hydraulics/soil_kind.h"

#include <vector>

namespace espalier::environment {

/// Between the rows, contents are a smooth curve over log |head| that stays between them (Steffen 1990), and so are the
/// logarithms of the conductivities. The wettest row is full soil: nearer to 0 nothing changes, or, if it is the row of
/// head 0, both are straight in the head up to the next row. Beyond the driest row the content falls to 0 in soil as
/// dry as an oven leaves it, at 10^6.8 cm (Schofield 1935), evenly in log |head|, and the conductivity by the power of
/// the last two rows.
class SoilTable final : public SoilCurves {
public:
    struct Row {
        double head, content, conductivity;  ///< cm, m3/m3, cm/d
    };
    /// Rows in the order of falling heads from 0 on, contents that do not rise, conductivities above 0 that fall. Two
    /// rows below 0 or more.
    explicit SoilTable(std::vector<Row> rows);

    double content(double head) const override;
    double conductivity(double head) const override;

private:
    struct Point {
        double log_suction, content, content_slope, log_conductivity, conductivity_slope;
    };
    double wet(double head, double Row::*column) const;
    static double hermite(const Point& a, const Point& b, double at, double Point::*value, double Point::*slope);
    const Point& point_before(double log_suction) const;

    std::vector<Row> rows_;      ///< the wettest first
    std::vector<Point> points_;  ///< of the rows below 0
};

}  // namespace espalier::environment
