// Lamps of growth chambers: points, spots, areas, and the light distributions that makers publish (IES files).
#pragma once

#include "espalier/base/settings.h"

#include "environment/light/optics/optics.h"

#include <glm/vec3.hpp>

#include <array>
#include <memory>
#include <vector>

namespace espalier::environment {

/// How much light goes where, as a table over the angle from the axis and round it.
class IntensityTable {
public:
    /// `angle` runs from the axis, 0 to pi, `round` from 0 to 2 pi; `intensity` in any unit. Cells of equal steps.
    template <class Intensity>
    static IntensityTable of(const Intensity& intensity);
    /// A file of IES LM-63, photometric type C. Throws UserError naming the file; warns of what it says without effect.
    static IntensityTable read_ies(const std::filesystem::path& path, std::vector<Diagnostic>* warnings = nullptr);

    /// Share of all light per steradian.
    double per_steradian(double angle, double round) const;
    /// An angle and a turn whose chances are the light's shares, from two numbers in [0, 1).
    std::array<double, 2> sample(double u, double v) const;

private:
    static constexpr int angles = 180, rounds = 72;

    void add_up();

    std::vector<double> shares_ = std::vector<double>(angles * rounds);  ///< of each cell, angle by angle
    std::vector<double> sums_;                                           ///< before each cell, and all
};

struct Lamp {
    enum class Kind : std::uint8_t { point, spot, area, ies };

    Kind kind = Kind::point;
    glm::dvec3 place{0, 2, 0};
    glm::dvec3 axis{0, -1, 0}, x{1, 0, 0}, y{0, 0, 1};  ///< orthonormal; x is the direction of angle 0 round the axis
    double cosine = -1;                                 ///< of a spot's half-angle
    std::array<double, 2> size{0, 0};                   ///< of an area, along x and y, m
    std::array<double, most_bands> photons{};           ///< umol/s by band
    std::shared_ptr<const IntensityTable> table;

    struct Ray {
        glm::dvec3 origin, direction;
    };
    /// A ray of the lamp's light, from four numbers in [0, 1).
    Ray ray(const std::array<double, 4>& u) const;
    /// A place of it that shines, from two numbers in [0, 1).
    glm::dvec3 place_of_light(double u, double v) const;
    /// Share of its light per steradian in a direction.
    double per_steradian(const glm::dvec3& direction) const;
    /// Share of its light that falls per m2 on level ground at a place, from above.
    double on_level_ground(const glm::dvec3& at) const;

private:
    double from_point(const glm::dvec3& source, const glm::dvec3& at) const;
};

/// Reads `[[lamps]]` tables; see `lamps_help`. Throws UserError.
std::vector<Lamp> read_lamps(const Settings& settings, const std::vector<LightBand>& bands,
                             std::vector<Diagnostic>* warnings);

const std::string& lamps_help();

}  // namespace espalier::environment
