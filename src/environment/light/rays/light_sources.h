// Where paths of light begin: at beams of sun and sky, and at lamps.
#pragma once

#include "environment/light/rays/lamp.h"
#include "environment/light/rays/light_path.h"
#include "environment/light/sky/daylight.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace espalier::environment {

class LightSources {
public:
    /// Light that falls on a ball: beams through a square across it or, with a period, through its level top.
    struct Target {
        glm::dvec3 centre;
        double radius;
        std::optional<Box> period;
    };

    /// Lamps shine for `lamp_seconds`, and are kept by reference; `factors` are the photons of each band for one of
    /// PAR.
    void set(const Daylight& light, std::span<const Lamp> lamps, double lamp_seconds, std::span<const double> factors,
             const Target& target);

    /// What they give together: mol of PAR, or of other bands over their factor.
    double light() const { return light_; }
    bool empty() const { return powers_.empty(); }
    /// A path by four numbers in [0, 1): a source is chosen by its share of the light.
    LightPath path(const std::array<double, 4>& sample) const;

    /// Calls visit(beam) for those of sun and sky.
    template <class Visit>
    void for_beams(const Visit& visit) const {
        for (const Beam& beam : beams_) visit(beam.light);
    }

private:
    /// Light of one direction, and two unit vectors across it.
    struct Beam {
        LightBeam light;
        glm::dvec3 x, y;
    };

    LightPath from_beam(const Beam& beam, const std::array<double, 4>& sample) const;
    LightPath from_lamp(std::size_t lamp, const std::array<double, 4>& sample) const;

    Target target_{};
    std::vector<Beam> beams_;
    std::span<const Lamp> lamps_;
    std::vector<BandWeights> lamp_weights_;
    std::vector<double> powers_;  ///< sums up to each beam, then lamp; the last is 1
    double light_ = 0;
};

}  // namespace espalier::environment
