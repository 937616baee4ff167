// The parameters of cpfg's programs that follow rays through a model: QuasiMC (Cieslak, Lemieux, Hanan & Prusinkiewicz
// 2008, Quasi-Monte Carlo simulation of the light environment of plants), and the older MonteCarlo and radiosity.
#pragma once

#include "espalier/environment/environment_process.h"

#include "environment/light/optics/optics.h"
#include "environment/light/sky/daylight.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace espalier::environment {

class ParameterFile;

/// What a parameter file of these programs asks for, in the terms of LightPaths.
class RayProgram {
public:
    /// Reads the file that `parameters` names, as the program that `program` names reads it. Throws UserError for what
    /// changes the answers and cannot be followed; warns of what has no effect.
    RayProgram(const Settings& settings, const EnvironmentContext& context);

    std::size_t bands() const { return weights_.size(); }
    /// The light of a band across a ray's direction: its weight of the source spectrum.
    double weight(std::size_t band) const { return weights_[band]; }
    /// 'F' absorbed flux, 'D' absorbed per area, 'U' and 'L' incident per area on the upper and the lower side.
    char returned(std::size_t band) const { return returned_[band]; }
    const Optics& optics() const { return *optics_; }
    /// Of the optics, for a leaf whose sides have these numbers of the file; throws RunError for one that it lacks.
    std::uint16_t material(double top, double bottom) const;
    double default_top() const { return 0; }
    double default_bottom() const { return has_bottom_ ? 1 : 0; }
    /// Which parameter of an organ, from 1, is the number of its top's material; that of the bottom stands behind it.
    std::size_t material_parameter() const { return material_parameter_; }

    /// Light 1 across all directions together.
    const Daylight& light() const { return light_; }
    std::uint32_t paths(double square) const;  ///< for a square of so many m2 across the light
    std::uint32_t depth() const { return depth_; }
    bool evenly() const { return evenly_; }
    bool only_scattered() const { return only_scattered_; }
    int cylinder_sides() const { return cylinder_sides_; }
    /// Objects outside are lost; it repeats along x and z if `periodic`.
    const std::optional<Box>& domain() const { return domain_; }
    bool periodic() const { return periodic_; }

private:
    void read_quasi(ParameterFile& file);
    void read_older(ParameterFile& file, bool is_radiosity);
    void read_common(ParameterFile& file);
    void read_spectrum(ParameterFile& file);
    void read_materials(ParameterFile& file, const std::vector<double>& usual);
    void read_lights(ParameterFile& file, double sense);
    void read_sky(ParameterFile& file);
    void note(const ParameterFile& file, const std::string& key, const std::string& message) const;

    std::vector<Diagnostic>* warnings_;
    std::vector<double> weights_{1};
    std::vector<char> returned_;
    std::optional<Optics> optics_;
    std::size_t materials_ = 0;
    bool has_bottom_ = false;
    std::size_t material_parameter_ = 0;
    Daylight light_;
    double rays_ = 1, density_ = 0, runs_ = 1;
    std::uint32_t depth_ = 5;
    bool evenly_ = false, only_scattered_ = false, periodic_ = false;
    int cylinder_sides_ = 4;
    std::optional<Box> domain_;
};

/// The light of a sky as QuasiMC takes it: 32 x 32 directions that are even in azimuth and altitude, drawn by their
/// intensity, which a ray carries once more. Hours of solar time from `from` to `to`.
struct QuasiSky {
    double latitude = 0, longitude = 0, day = 172, from = 0, to = 24;
    bool is_clear = true;
    double turbidity = 2.45;

    std::vector<LightBeam> beams() const;
};

}  // namespace espalier::environment
