// What leaves, stems, soil and solids do with light, band by band.
#pragma once

#include "espalier/base/settings.h"

#include "base/picture_file.h"
#include "environment/light/sky/bands.h"
#include "geometry/drawn/faces.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace espalier::environment {

/// Of the table `soil_map`: a picture that is repeated over the ground; without one, the soil is dark everywhere.
class SoilMap {
public:
    SoilMap() = default;
    /// Throws UserError for a picture that cannot be read.
    explicit SoilMap(const Settings& table);

    bool empty() const { return picture_.empty(); }
    /// 0 (black) to 1 (white); 0 without a picture.
    double brightness(const glm::dvec3& place) const;

private:
    Picture picture_;
    double x_ = 0, z_ = 0, width_ = 1, depth_ = 1;  ///< lower corner and size on the ground, m
};

constexpr std::size_t most_bands = 8;

/// A body is closed, as a fruit: like stems, it has the optical numbers of stems and lets nothing through.
enum class LitKind : std::uint8_t { leaf, stem, body, solid };

constexpr LitKind lit_kind(FaceOf of) {
    return of == FaceOf::leaf ? LitKind::leaf : of == FaceOf::stem ? LitKind::stem : LitKind::body;
}

/// Shares of the light that falls on a side; Lambert's law says where they go. What is left is absorbed.
struct SideOptics {
    double reflectance = 0, transmittance = 0;
};

/// Of light that falls on the front, the side that a polygon's corners run round counter-clockwise, and on the back.
struct TwoSides {
    SideOptics front, back;
    const SideOptics& operator[](bool of_back) const { return of_back ? back : front; }
};

/// The bands of a process and its materials, from its tables `bands` and `materials` (help in `optics_help`).
class Optics {
public:
    /// Throws UserError for shares that are more than 1 together, unknown bands, and colours with two materials.
    explicit Optics(const Settings& settings);

    const std::vector<LightBand>& bands() const { return bands_; }
    /// Of leaves, stems or bodies drawn in a colour; none if the scene's materials leave it out.
    std::optional<std::uint16_t> material_of(LitKind kind, std::uint16_t colour) const;
    /// The same, or a RunError that names the plant's number.
    std::uint16_t require_material(LitKind kind, std::uint16_t colour, std::uint32_t plant) const;
    /// "leaf", "stem", or what the scene calls it.
    const std::string& material_name(std::uint16_t material) const { return names_[material]; }
    /// What is closed has one side, and lets no light through.
    TwoSides of(LitKind kind, std::uint16_t material, std::size_t band) const;
    /// Soil at a place, and solids.
    double soil(const glm::dvec3& place, std::size_t band) const;
    double solid(std::size_t band) const { return solids_[band]; }
    /// Whether anything but black reflects or transmits in a band.
    bool scatters(std::size_t band) const;

private:
    using Material = std::array<TwoSides, most_bands>;

    void read_band(const std::string& name, const Settings& table);
    void read_material(const Settings& table);

    std::vector<LightBand> bands_;
    std::vector<std::string> names_{"leaf", "stem"};
    std::vector<Material> materials_{2};
    std::array<double, most_bands> soil_dark_{}, soil_bright_{}, solids_{};
    SoilMap map_;
    std::vector<std::pair<std::uint16_t, std::uint16_t>> by_colour_;  ///< colours and their materials
    std::optional<std::uint16_t> others_;                             ///< the material of all other colours
    bool lists_materials_ = false;
};

/// What users read of the tables.
const std::string& optics_help();

}  // namespace espalier::environment
