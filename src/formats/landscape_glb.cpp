#include "formats/landscape_glb.h"

#include "espalier/base/file.h"

#include "formats/glb.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include <map>
#include <tuple>

namespace espalier::formats {
namespace {

struct Places {
    std::vector<glm::vec3> translations, scales;
    std::vector<glm::vec4> rotations;

    void add(const glm::dvec3& translation, const glm::dquat& rotation, double scale) {
        translations.emplace_back(translation);
        rotations.emplace_back(rotation.x, rotation.y, rotation.z, rotation.w);
        scales.emplace_back(scale);
    }
};

class LandscapeWriter {
public:
    explicit LandscapeWriter(const LandscapeFile& file) : file_(file), glb_(file.run) {}

    ExportedFile write(const std::filesystem::path& path) {
        const std::size_t ground = add_mesh(file_.landscape.terrain.mesh(file_.ground));
        roots_.push_back(glb_.add_node({{"name", "terrain"}, {"mesh", ground}}));
        for (const auto& [key, places] : places_by_shape()) {
            const auto [species, level, turn] = key;
            const std::string& name = file_.landscape.species[species].name;
            const bool is_card = level == PlantedPlant::card_level;
            const std::size_t mesh =
                is_card ? add_card(species, turn) : add_mesh(file_.landscape.species[species].levels[level]);
            roots_.push_back(glb_.add_instances(
                {{"name", is_card ? fmt::format("{}_card_{}", name, turn) : fmt::format("{}_level_{}", name, level)},
                 {"mesh", mesh}},
                places.translations, places.rotations, places.scales));
        }
        write_text(path, glb_.bytes(roots_));
        return {path, vertices_, triangles_, file_.landscape.plants.size(), "plants", glb_.hint()};
    }

private:
    std::size_t add_mesh(const FrameMesh& mesh) {
        vertices_ += mesh.points.size();
        triangles_ += mesh.triangles.size();
        return glb_.add_mesh(mesh.points, mesh.normals, mesh.uvs, mesh.triangles, mesh.material_of, mesh.materials);
    }

    std::size_t add_card(std::uint16_t species, std::uint16_t turn) {
        const CardImage& card = file_.cards[species][turn];
        const std::string name = fmt::format("{}-{}", file_.landscape.species[species].name, turn);
        glb_.add_texture(name, card.png);
        return add_mesh(card_mesh(card.frame, name));
    }

    /// By species, level and turn of cards.
    std::map<std::tuple<std::uint16_t, std::uint16_t, std::uint16_t>, Places> places_by_shape() const {
        std::map<std::tuple<std::uint16_t, std::uint16_t, std::uint16_t>, Places> result;
        for (const PlantedPlant& plant : file_.landscape.plants) {
            if (plant.level != PlantedPlant::card_level) {
                const glm::dquat turn = glm::angleAxis(glm::radians(degrees_of_turn(plant.turn)), glm::dvec3(0, 1, 0));
                result[{plant.species, plant.level, 0}].add(plant.position, turn, plant.scale);
                continue;
            }
            const CardFrame& frame = file_.cards[plant.species][plant.turn].frame;
            const glm::dvec3 middle = plant.position + double(plant.scale) * frame.middle;
            result[{plant.species, plant.level, plant.turn}].add(middle, towards_eye(middle, file_.eye), plant.scale);
        }
        return result;
    }

    const LandscapeFile& file_;
    Glb glb_;
    std::vector<std::size_t> roots_;
    std::size_t vertices_ = 0, triangles_ = 0;
};

}  // namespace

ExportedFile write_landscape(const LandscapeFile& file, const std::filesystem::path& path) {
    return LandscapeWriter(file).write(path);
}

}  // namespace espalier::formats
