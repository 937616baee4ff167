// What a soil does with water: how much it holds and how well it conducts at a pressure head, as published.
#pragma once

#include <memory>

namespace espalier::environment {

/// Curves that are no formula of a few parameters.
class SoilCurves {
public:
    virtual ~SoilCurves() = default;
    /// For heads below 0, cm.
    virtual double content(double head) const = 0;
    virtual double conductivity(double head) const = 0;
};

/// Heads in cm of water, negative in unsaturated soil; conductivities in cm/d; contents in m3/m3.
struct SoilKind {
    enum class Model {
        van_genuchten,  ///< van Genuchten (1980) with Mualem (1976): m = 1 - 1/n
        brooks_corey,   ///< Brooks & Corey (1964) with Burdine (1953): K = Ks Se^(3 + 2/lambda)
        gardner,        ///< Gardner (1958): K = Ks exp(alpha h); the content is linear in K
        curves          ///< as `curves` has them
    };
    Model model = Model::van_genuchten;
    double residual = 0;      ///< content of dry soil
    double saturated = 0.4;   ///< content of full soil
    double alpha = 0.04;      ///< 1/cm; of Brooks & Corey 1 / air-entry head
    double n = 1.6;           ///< of Brooks & Corey lambda
    double conductivity = 0;  ///< of full soil
    double l = 0.5;           ///< van Genuchten's exponent of Se in K
    std::shared_ptr<const SoilCurves> curves = nullptr;

    friend bool operator==(const SoilKind&, const SoilKind&) = default;
};

/// (content - residual) / (saturated - residual), 0 to 1.
double effective_saturation(const SoilKind& soil, double head);
double conductivity(const SoilKind& soil, double head);

}  // namespace espalier::environment
