#include "formats/landscape_file.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace espalier::formats {

std::string name_of(const LandscapeFile& file, const LandscapeShape& shape) {
    const std::string& species = file.landscape.species[shape.species].name;
    return shape.is_card() ? fmt::format("{}_card_{}", species, shape.turn)
                           : fmt::format("{}_level_{}", species, shape.level);
}

std::string texture_name_of(const LandscapeFile& file, const LandscapeShape& card) {
    return fmt::format("{}-{}", file.landscape.species[card.species].name, card.turn);
}

FrameMesh mesh_of(const LandscapeFile& file, const LandscapeShape& shape) {
    if (!shape.is_card()) return file.landscape.species[shape.species].levels[shape.level];
    return card_mesh(file.cards[shape.species][shape.turn].frame, texture_name_of(file, shape));
}

std::map<LandscapeShape, ShapePlaces> places_by_shape(const LandscapeFile& file) {
    std::map<LandscapeShape, ShapePlaces> result;
    const auto add = [&](const LandscapeShape& shape, const glm::dvec3& place, const glm::dquat& turn, float scale) {
        ShapePlaces& places = result[shape];
        places.translations.emplace_back(place);
        places.rotations.emplace_back(turn);
        places.scales.push_back(scale);
    };
    for (const PlantedPlant& plant : file.landscape.plants) {
        if (plant.level != PlantedPlant::card_level) {
            const glm::dquat turn = glm::angleAxis(glm::radians(degrees_of_turn(plant.turn)), glm::dvec3(0, 1, 0));
            add({plant.species, plant.level, 0}, plant.position, turn, plant.scale);
            continue;
        }
        const CardFrame& frame = file.cards[plant.species][plant.turn].frame;
        const glm::dvec3 middle = plant.position + double(plant.scale) * frame.middle;
        add({plant.species, plant.level, plant.turn}, middle, towards_eye(middle, file.eye), plant.scale);
    }
    return result;
}

bool is_landscape_file(const std::filesystem::path& path) {
    return path.extension() == ".glb" || path.extension() == ".usda";
}

ExportedFile write_landscape(const LandscapeFile& file, const std::filesystem::path& path) {
    return path.extension() == ".usda" ? write_landscape_usd(file, path) : write_landscape_glb(file, path);
}

}  // namespace espalier::formats
