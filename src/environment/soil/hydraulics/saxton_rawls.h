// Saxton & Rawls (2006): the water of a soil from its sand, clay and organic matter.
#pragma once

#include "environment/soil/hydraulics/soil_kind.h"

namespace espalier::environment {

/// Of one soil, by the equations of table 1 of Saxton & Rawls 2006 (Soil Science Society of America Journal 70,
/// 1569-1578), fitted to 1,722 soils of the USDA of at most 8 % organic matter and 60 % clay. Contents are m3/m3.
class SaxtonRawls final : public SoilCurves {
public:
    /// Percentages of mass.
    SaxtonRawls(double sand, double clay, double organic_matter);

    double saturated() const { return saturated_; }             ///< theta_S, eq. 5
    double at_33_kpa() const { return at_33_; }                 ///< field capacity, eq. 2
    double at_1500_kpa() const { return at_1500_; }             ///< wilting point, eq. 1
    double air_entry() const { return air_entry_; }             ///< kPa, above 0, eq. 4
    double full_conductivity() const { return conductivity_; }  ///< K_S, cm/d, eq. 16

    /// Full up to the air entry; straight from there to 33 kPa, eq. 12; a power of the tension beyond, eq. 11.
    double content(double head) const override;
    /// Campbell (1974), eq. 17.
    double conductivity(double head) const override;

private:
    double at_1500_, at_33_, saturated_, air_entry_;
    double b_;  ///< of tension = A content^-B, eq. 15
    double conductivity_;
};

}  // namespace espalier::environment
