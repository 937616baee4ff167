#include "environment/light/optics/optics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

constexpr std::uint16_t first_leaf = 0, first_stem = 1;

/// What is known of a band without a word of the scene.
struct DefaultOptics {
    SideOptics leaf;
    double stem, soil;
};

DefaultOptics defaults_of(const std::string& band) {
    // Leaves: Goudriaan 1977. Stems and soil: Oleson et al. 2010, tables 3.1 (trees) and 3.3 (class 14, wet).
    if (band == "nir") return {{0.4, 0.4}, 0.39, 0.2};
    return {{0.1, 0.1}, 0.16, 0.1};
}

SideOptics read_side(const Settings& table, const std::string& key, const SideOptics& fallback) {
    const std::vector<double> side = table.numbers_or(key, {fallback.reflectance, fallback.transmittance});
    if (side.size() != 2 || !(side[0] >= 0 && side[1] >= 0)) {
        throw UserError(table.place(key),
                        fmt::format("'{}' must be [reflectance, transmittance], two shares from 0 on", key));
    }
    if (side[0] + side[1] > 1) {
        throw UserError(table.place(key), fmt::format("'{}' reflects and transmits {:g} of the light: [reflectance, "
                                                      "transmittance] must be 1 together at most",
                                                      key, side[0] + side[1]));
    }
    return {side[0], side[1]};
}

/// A light that passes must come out with the same numbers from either side, unless the back has its own.
TwoSides read_sides(const Settings& table, const std::string& key, const SideOptics& fallback) {
    const SideOptics front = read_side(table, key, fallback);
    return {front, read_side(table, key + "_back", front)};
}

}  // namespace

Optics::Optics(const Settings& settings) : map_(settings.table("soil_map")) {
    const Settings bands = settings.table("bands");
    const std::vector<std::string> names = bands.keys();
    if (names.size() > most_bands) {
        throw UserError(bands.place(), fmt::format("there are {} bands, of at most {}", names.size(), most_bands));
    }
    for (const std::string& name : names) read_band(name, bands.table(name));
    if (names.empty()) read_band("par", bands);
    for (const Settings& table : settings.tables("materials")) read_material(table);
}

void Optics::read_band(const std::string& name, const Settings& table) {
    if (name != "par" && name != "nir" && !table.has("leaf")) {
        throw UserError(table.place(), fmt::format("the band '{}' needs leaf = [reflectance, transmittance]: only par "
                                                   "and nir have defaults",
                                                   name));
    }
    const std::size_t band = bands_.size();
    bands_.push_back(read_light_band(name, table));
    const DefaultOptics known = defaults_of(name);
    const Range share = Range::between(0, 1);
    const double of_stem = table.number_or("stem", known.stem, share);
    materials_[first_leaf][band] = read_sides(table, "leaf", known.leaf);
    materials_[first_stem][band] = {{of_stem, 0}, {of_stem, 0}};
    soil_dark_[band] = table.number_or("soil", known.soil, share);
    soil_bright_[band] = map_.empty() ? soil_dark_[band] : table.number_or("soil_bright", soil_dark_[band], share);
    solids_[band] = table.number_or("solid", 0, share);
}

void Optics::read_material(const Settings& table) {
    const auto number = static_cast<std::uint16_t>(materials_.size());
    lists_materials_ = true;
    names_.push_back(table.text("name"));
    materials_.push_back(materials_[first_leaf]);
    for (std::size_t band = 0; band < bands_.size(); ++band) {
        TwoSides& optics = materials_.back()[band];
        if (table.has(bands_[band].name)) optics = read_sides(table, bands_[band].name, optics.front);
    }
    if (!table.has("colours")) {
        if (others_)
            throw UserError(table.place(), "two materials name no 'colours': only one can be that of all others");
        others_ = number;
        return;
    }
    for (const double colour : table.numbers("colours")) {
        const auto index = static_cast<std::uint16_t>(std::clamp(colour, 0.0, 65535.0));
        if (index != colour) throw UserError(table.place("colours"), "'colours' must be whole numbers from 0 on");
        for (const auto& [known, material] : by_colour_) {
            if (known != index) continue;
            throw UserError(table.place("colours"),
                            fmt::format("the colour {} is already that of the material '{}'", index, names_[material]));
        }
        by_colour_.emplace_back(index, number);
    }
}

std::optional<std::uint16_t> Optics::material_of(LitKind kind, std::uint16_t colour) const {
    for (const auto& [known, material] : by_colour_) {
        if (known == colour) return material;
    }
    if (kind != LitKind::leaf) return first_stem;
    return lists_materials_ ? others_ : std::optional(first_leaf);
}

std::uint16_t Optics::require_material(LitKind kind, std::uint16_t colour, std::uint32_t plant) const {
    if (const auto material = material_of(kind, colour)) return *material;
    throw RunError(
        fmt::format("plant {} draws a leaf in colour {}, which no material names: add it to the 'colours' of one, "
                    "or leave 'colours' out of the material of all others",
                    plant, colour));
}

TwoSides Optics::of(LitKind kind, std::uint16_t material, std::size_t band) const {
    const TwoSides& sides = materials_[material][band];
    if (kind == LitKind::leaf) return sides;
    const SideOptics outside{sides.front.reflectance, 0};
    return {outside, outside};
}

double Optics::soil(const glm::dvec3& place, std::size_t band) const {
    const double bright = map_.brightness(place);
    return (1 - bright) * soil_dark_[band] + bright * soil_bright_[band];
}

bool Optics::scatters(std::size_t band) const {
    const auto of_side = [](const SideOptics& side) { return side.reflectance + side.transmittance > 0; };
    return soil_dark_[band] > 0 || soil_bright_[band] > 0 || solids_[band] > 0 ||
           std::any_of(materials_.begin(), materials_.end(), [&](const Material& material) {
               return of_side(material[band].front) || of_side(material[band].back);
           });
}

const std::string& optics_help() {
    static const std::string text =
        R"(bands         the tables of the bands, as in bands.par = { leaf = [0.1, 0.1] }; default: par alone
)" + bands_help() +
        R"(  leaf        [reflectance, transmittance]; par [0.1, 0.1], nir [0.4, 0.4] (Goudriaan 1977)
  leaf_back   the same for light that falls on the back; default: as the front. The front of a leaf is the side that
              its corners run round counter-clockwise
  stem        reflectance of stems and spheres; par 0.16, nir 0.39 (trees; Oleson et al. 2010, table 3.1)
  soil        reflectance of the soil; par 0.1, nir 0.2 (the same, table 3.3: class 14, wet)
  soil_bright where soil_map is white; default: as soil
  solid       0: reflectance of solids
materials     [[materials]] tables: leaves (and stems) of some colours have optical numbers of their own
  name        what messages call it
  colours     [4, 5]: the turtle's colours that it is drawn in; without, it is the material of all other leaves. A leaf
              whose colour no material names is refused, unless there are no materials at all
  par, nir    reflectance and transmittance in the band of this name, as in par = [0.1, 0.05]; par_back and nir_back are for
              light that falls on the back
soil_map      { picture = "soil.png", corner = [0, 0], size = [1, 1] }: between black and white the soil goes from `soil`
              to `soil_bright`; the picture covers size metres along x and z from its corner on, and is repeated
)";
    return text;
}

SoilMap::SoilMap(const Settings& table) {
    if (table.keys().empty()) return;
    picture_ = read_picture(table.path("picture"));
    const std::vector<double> corner = table.numbers_or("corner", {0, 0}), size = table.numbers_or("size", {1, 1});
    if (corner.size() != 2) throw UserError(table.place("corner"), "'corner' must be [x, z]");
    if (size.size() != 2 || !(size[0] > 0 && size[1] > 0)) {
        throw UserError(table.place("size"), "'size' must be [x, z], both above 0");
    }
    x_ = corner[0];
    z_ = corner[1];
    width_ = size[0];
    depth_ = size[1];
}

double SoilMap::brightness(const glm::dvec3& place) const {
    if (picture_.empty()) return 0;
    const double u = (place.x - x_) / width_, v = (place.z - z_) / depth_;
    const Picture::Colour& pixel = picture_.at(u - std::floor(u), v - std::floor(v));
    return (0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2]) / 255;
}

}  // namespace espalier::environment
