// Where light begins: beams of sun and sky, and lamps.
#pragma once

#include "environment/light/rays/lamp.h"
#include "environment/light/rays/light_path.h"
#include "environment/light/sky/daylight.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace espalier::environment {

/// Each kind of source lights a surface by rays of its own.
enum class SourceKind : std::uint8_t { sun, sky, lamp };
constexpr std::size_t source_kinds = 3;

/// A small flat surface.
struct LitPatch {
    glm::dvec3 middle, normal;  ///< a unit vector
    double area;
};

/// A ray from a place of a surface to a source.
struct SourceRay {
    glm::dvec3 towards;  ///< unit vector
    double length;       ///< to the source; infinite to sun and sky
    /// What comes along it if nothing is in the way, over `open_light`: 1 in the mean.
    BandWeights light;
};

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

    /// Whether surfaces can look for the sources of a kind. Of lamps in a stand without an edge they cannot: there are
    /// endlessly many.
    bool can_be_sought(SourceKind kind) const;
    /// About the mol that the sources of a kind bring to both sides of a surface where nothing shades it.
    double open_light(SourceKind kind, const LitPatch& patch) const;
    /// A ray from a place of that patch to one of the sources, by two numbers in [0, 1). Rays are chosen by what they
    /// bring. `open` is `open_light` of the patch, above 0.
    SourceRay seek(SourceKind kind, const LitPatch& patch, double open, const glm::dvec3& place, double u,
                   double v) const;

    /// Parallel light that stands for some of the sun or the sky.
    struct Parallel {
        glm::dvec3 towards;
        double on_ground;  ///< mol/m2
        double light;      ///< the same across the direction, where there is no period
    };
    /// All light of sun or sky as at most so many, each of which stands for an equal share of it: the one at the share
    /// `shift` of its own. Of those of all shifts together, each is turned within its part of the sky by the golden
    /// section more than the one before, the first by `turn`.
    std::vector<Parallel> parallels(SourceKind kind, std::uint32_t count, double shift, double turn) const;

    /// Whether light of sun and sky that paths bring to a place on the ground includes that of a direction.
    bool reaches(const glm::dvec3& place, const glm::dvec3& towards) const;

    /// Calls visit(towards, photons across them) for directions of sun and sky, of each part of the sky for so many;
    /// numbers(i) gives two in [0, 1).
    template <class Numbers, class Visit>
    void for_directions(std::uint32_t of_part, const Numbers& numbers, const Visit& visit) const {
        std::uint32_t i = 0;
        for (const auto& [light, x, y] : beams_) {
            const std::uint32_t count = light.window.is_point() ? 1 : of_part;
            for (std::uint32_t k = 0; k < count; ++k) {
                const auto sample = numbers(i++);
                visit(direction(light, sample[0], sample[1]), across(light) / count);
            }
        }
    }

private:
    /// Light of one direction, and two unit vectors across it.
    struct Beam {
        LightBeam light;
        glm::dvec3 x, y;
    };

    static glm::dvec3 direction(const LightBeam& beam, double u, double v);
    static double across(const LightBeam& beam);
    LightPath from_beam(const Beam& beam, double again, const std::array<double, 4>& sample) const;
    LightPath from_lamp(std::size_t lamp, double again, const std::array<double, 4>& sample) const;
    bool holds(SourceKind kind, const Beam& beam) const { return beam.light.is_sun == (kind == SourceKind::sun); }
    double chance_of(const Beam& beam, const LitPatch& patch) const;
    double chance_of(std::size_t lamp, const LitPatch& patch) const;
    SourceRay to_sky(const Beam& beam, const LitPatch& patch, double u, double v) const;
    SourceRay to_lamp(std::size_t lamp, const LitPatch& patch, const glm::dvec3& place, double u, double v) const;
    /// Calls visit(source, chance) for those of a kind until it returns true.
    template <class Visit>
    void visit(SourceKind kind, const LitPatch& patch, const Visit& visit) const;

    Target target_{};
    std::vector<Beam> beams_;
    std::span<const Lamp> lamps_;
    std::vector<double> lamp_light_;         ///< mol of the band that each gives most of
    std::vector<BandWeights> lamp_weights_;  ///< shares of that
    std::vector<double> powers_;             ///< sums up to each beam, then lamp; the last is 1
    double light_ = 0;
};

}  // namespace espalier::environment
