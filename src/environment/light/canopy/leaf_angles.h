// How leaves that are not drawn are inclined.
#pragma once

#include <string>
#include <vector>

namespace espalier::environment {

/// A distribution of the inclination of leaves, the angle between their normal and the vertical, evenly turned about
/// the vertical.
class LeafAngles {
public:
    /// "spherical", or one of de Wit 1965 and Goel & Strebel 1984: "planophile", "erectophile", "plagiophile",
    /// "extremophile", "uniform", "horizontal", "vertical".
    explicit LeafAngles(const std::string& name);
    /// As on the surface of a spheroid whose horizontal axis is `ratio` (> 0) times its vertical one. Campbell 1986,
    /// Extinction coefficients for radiation in plant canopies calculated using an ellipsoidal inclination angle
    /// distribution, Agricultural and Forest Meteorology 36:317-321, with the exact normalisation.
    explicit LeafAngles(double ratio);

    static const std::vector<std::string>& names();

    /// Mean area that unit leaf area hides from a direction at that cosine (0 to 1) from the vertical: G.
    double projection(double cosine) const;
    /// The part of it that shows its upper side; the cosine, from -1 to 1, is negative for directions from below. From
    /// there, as much is seen of the lower sides.
    double seen_from_above(double cosine) const;

private:
    double density(double inclination) const;

    std::string name_;
    double ratio_ = 1;
};

}  // namespace espalier::environment
