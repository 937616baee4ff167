#include "study/landscape/landscape_scene.h"

#include "archive/meshes/texture_picture.h"
#include "language/parser/vector_field.h"
#include "picture/palette.h"
#include "picture/stage/sky_visibility.h"
#include "study/landscape/landscape_species.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace espalier::study {
namespace {

namespace fs = std::filesystem;

picture::Rgb colour_setting(const Settings& settings, const char* key, const std::string& usual) {
    const std::string text = settings.text_or(key, usual);
    if (const auto rgb = picture::hex_colour(text)) return *rgb;
    throw UserError(settings.place(key), fmt::format("expected #rrggbb, not '{}'", text));
}

LevelDistances distances_of(const Settings& detail) {
    LevelDistances distances{detail.numbers_or("levels", {0, 30, 60, 90}),
                             detail.number_or("cards", 160, Range::positive())};
    const std::vector<double>& levels = distances.levels;
    const bool ascends = std::adjacent_find(levels.begin(), levels.end(), std::greater_equal<>()) == levels.end();
    if (levels.empty() || levels.front() != 0 || !ascends) {
        throw UserError(detail.place("levels"), "levels are distances that begin with 0 and rise: [0, 30, 60, 90]");
    }
    return distances;
}

/// An expression of x and z, which are metres.
std::function<double(double, double)> expression_of(const Settings& settings, const char* key,
                                                    const std::string& text) {
    const auto field = blamed_on(settings, key, [&] { return VectorField::parse(fmt::format("0, {}, 0", text)); });
    return [field](double x, double z) {
        const auto vector = field.at({x, 0, z});
        return vector ? vector->y : std::numeric_limits<double>::quiet_NaN();
    };
}

GroundColour ground_of(const Settings& terrain) {
    GroundColour ground{colour_setting(terrain, "colour", "#70744a")};
    const std::string share = terrain.text_or("second_share", "");
    if (!share.empty()) {
        ground.second = colour_setting(terrain, "second_colour", "#4f5f36");
        ground.share = expression_of(terrain, "second_share", share);
    }
    return ground;
}

/// By how much of its size the terrain goes on around a stand.
constexpr double margin_share = 0.5;

/// Two numbers, or the usual ones.
glm::dvec2 corner(const Settings& terrain, const char* key, const glm::dvec2& usual) {
    const std::vector<double> numbers = terrain.numbers_or(key, {usual.x, usual.y});
    if (numbers.size() != 2) throw UserError(terrain.place(key), "expected [x, z]");
    return {numbers[0], numbers[1]};
}

std::function<double(double, double)> heights_of(const Settings& terrain, const glm::dvec2& lower,
                                                 const glm::dvec2& upper) {
    if (const auto picture = terrain.path_if_any("picture")) {
        const double low = terrain.number("low"), high = terrain.number("high");
        return blamed_on(terrain, "picture", [&] { return heights_of_picture(*picture, lower, upper, low, high); });
    }
    return expression_of(terrain, "heights", terrain.text_or("heights", "0"));
}

Terrain terrain_of(const Settings& settings, const std::vector<StandPlant>& stand) {
    glm::dvec2 lower(std::numeric_limits<double>::max()), upper(-lower);
    for (const StandPlant& plant : stand) {
        lower = glm::min(lower, plant.place - plant.radius);
        upper = glm::max(upper, plant.place + plant.radius);
    }
    const glm::dvec2 margin = margin_share * (upper - lower);
    lower = corner(settings, "lower", lower - margin);
    upper = corner(settings, "upper", upper + margin);
    if (!(upper.x > lower.x && upper.y > lower.y)) {
        throw UserError(settings.place("upper"), "`upper` must lie above `lower` in x and z");
    }
    const auto places = static_cast<std::size_t>(settings.integer_or("places", 513, Range::between(2, 2048)));
    const auto height = heights_of(settings, lower, upper);
    return blamed_on(settings, "heights", [&] { return Terrain(lower, upper, {places, places}, height); });
}

LandscapeView view_of(const Settings& camera, const Terrain& terrain) {
    const glm::dvec2 middle = (terrain.lower() + terrain.upper()) / 2.0, size = terrain.upper() - terrain.lower();
    const auto over_ground = [&](const glm::dvec3& place) {
        return glm::dvec3(place.x, terrain.height(place.x, place.z) + place.y, place.z);
    };
    LandscapeView view;
    const double edge_of_stand = middle.y + size.y / (2 + 4 * margin_share);
    const glm::dvec3 eye(middle.x, 0.07 * size.y, edge_of_stand);
    view.eye = over_ground(camera.vector_or("eye", eye));
    view.target = over_ground(camera.vector_or("target", {middle.x, 0, middle.y}));
    view.angle = camera.number_or("angle", 40, Range::between(1, 150));
    if (view.eye == view.target) throw UserError(camera.place("target"), "`eye` and `target` are one place");
    return view;
}

LandscapeLook look_of(const Settings& settings) {
    const Settings light = settings.table("light"), detail = settings.table("detail");
    LandscapeLook look;
    look.ground = ground_of(settings.table("terrain"));
    look.visibility = light.number_or("visibility", 3000, Range::positive());
    look.samples = static_cast<int>(detail.integer_or("samples", 3, Range::between(1, 16)));
    look.texture_of = [](const std::string& file) { return texture_picture({}, file); };
    return look;
}

/// Two plants of one colour are individuals of one species.
SpeciesOfFile species_in(const Settings& settings, const LevelDistances& distances) {
    SpeciesOfFile of_file;
    for (const Settings& entry : settings.tables("species")) {
        of_file.read(entry, static_cast<int>(entry.integer("colour", Range::between(0, 65535))), distances);
    }
    if (of_file.first_run) return of_file;
    throw UserError(settings.place(), "a landscape needs at least one [[species]] with `colour` and `run`");
}

}  // namespace

LandscapeScene read_landscape(const fs::path& file, const LandscapeOverrides& overrides) {
    Settings settings = Settings::read_toml(file);
    for (const auto& [key, value] : overrides) settings.set(key, value);
    const Settings stand_settings = settings.table("stand"), light = settings.table("light"),
                   detail = settings.table("detail");
    const LevelDistances distances = distances_of(detail);
    std::vector<StandPlant> stand = [&] {
        const RunAndFrame frame = last_frame(stand_settings);
        return blamed_on(stand_settings, "run", [&] { return stand_of(frame.geometry); });
    }();
    Terrain terrain = terrain_of(settings.table("terrain"), stand);
    SpeciesOfFile of_file = species_in(settings, distances);
    const LandscapeView view = view_of(settings.table("camera"), terrain);
    const auto seed = static_cast<std::uint64_t>(settings.integer_or("seed", 0, Range::between(0, 1e15)));
    read_covers(settings, of_file, stand, view.eye, distances, seed);
    const glm::vec3 sun = picture::direction_at(light.number_or("azimuth", -60, Range::between(-360, 360)),
                                                light.number_or("elevation", 40, Range::between(1, 90)));
    LandscapeLook look = look_of(settings);
    const auto card_pixels = static_cast<std::size_t>(detail.integer_or("card_pixels", 192, Range::between(8, 4096)));
    settings.reject_unread();
    return {
        blamed_on(
            stand_settings, "run",
            [&] { return planted(std::move(terrain), std::move(of_file.species), stand, view.eye, distances, seed); }),
        view,
        {sun},
        std::move(look),
        card_pixels,
        std::move(*of_file.first_run)};
}

}  // namespace espalier::study
