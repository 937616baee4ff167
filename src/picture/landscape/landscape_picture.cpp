#include "picture/landscape/landscape_picture.h"

#include "espalier/base/error.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace espalier::picture {
namespace {

constexpr int rows_of_band = 8;
constexpr int samples_of_card = 3;
constexpr int most_pixels = 8192;
constexpr std::size_t bytes_of_place = 600;  // mostly Embree's instance

glm::quat turned(double degrees) {
    return glm::angleAxis(static_cast<float>(glm::radians(degrees)), glm::vec3(0, 1, 0));
}

std::uint8_t byte_of(float part) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.0F, 1.0F)));
}

glm::vec3 sky_at(const glm::vec3& direction) {
    const glm::vec3 horizon(0.86F, 0.90F, 0.93F), zenith(0.42F, 0.62F, 0.86F);
    return glm::mix(zenith, horizon, std::exp(-5 * std::max(direction.y, 0.0F)));
}

/// The mean of what rays through a pixel see; opaque as far as they see anything.
OpacityPicture::Pixel mean_of(const std::vector<std::optional<glm::vec3>>& seen) {
    glm::vec3 sum(0);
    int opaque = 0;
    for (const auto& colour : seen) {
        if (!colour) continue;
        sum += *colour;
        ++opaque;
    }
    const glm::vec3 mean = opaque > 0 ? sum / static_cast<float>(opaque) : sum;
    return {byte_of(mean.x), byte_of(mean.y), byte_of(mean.z),
            byte_of(static_cast<float>(opaque) / static_cast<float>(seen.size()))};
}

/// Calls `see` with places in the picture from (0, 0) at the upper left to its width and height.
template <class See>
void fill_rows(OpacityPicture& picture, std::size_t first, std::size_t last, int samples, const See& see) {
    tbb::parallel_for(first * picture.width, last * picture.width, [&](std::size_t i) {
        std::vector<std::optional<glm::vec3>> seen;
        for (int k = 0; k < samples * samples; ++k) {
            const glm::dvec2 within = (glm::dvec2(k % samples, k / samples) + 0.5) / double(samples);
            seen.push_back(see(glm::dvec2(double(i % picture.width), double(i / picture.width)) + within));
        }
        picture.pixels[i] = mean_of(seen);
    });
}

/// Transparent pixels take the colour of the opaque ones around them, so that filtered edges keep their colour.
void bleed(OpacityPicture& picture) {
    glm::dvec3 sum(0);
    double weight = 0;
    for (const auto& pixel : picture.pixels) {
        sum += double(pixel[3]) * glm::dvec3(pixel[0], pixel[1], pixel[2]);
        weight += pixel[3];
    }
    if (weight == 0) return;
    for (auto& pixel : picture.pixels) {
        if (pixel[3] > 0) continue;
        for (int k = 0; k < 3; ++k) {
            pixel[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::lround(sum[k] / weight));
        }
    }
}

std::size_t bytes_of(const FrameMesh& mesh) {
    constexpr std::size_t of_vertex = 2 * sizeof(glm::vec3) + sizeof(glm::vec2) + sizeof(Rgb);
    constexpr std::size_t of_triangle = 4 * sizeof(std::uint32_t);
    return mesh.points.size() * of_vertex + mesh.triangles.size() * of_triangle;
}

/// Draws a plant alone, from afar.
class CardPainter {
public:
    CardPainter(const LandscapeSpecies& species, const glm::dvec3& towards, const TextureOf& texture_of)
        : mesh_(species.levels.front()),
          rays_(mesh_, texture_of),
          scene_({&rays_}),
          middle_(0, species.height / 2, 0),
          towards_(towards) {
        const glm::dquat view = towards_eye(glm::dvec3(0), towards);
        right_ = view * glm::dvec3(1, 0, 0);
        up_ = view * glm::dvec3(0, 1, 0);
        for (const glm::vec3& point : mesh_.points) {
            reach_ = std::max(reach_, 1.1 * glm::distance(glm::dvec3(point), middle_));
        }
    }

    CardPicture card(double degrees, const RayLight& light, std::size_t pixels) {
        CardFrame frame = frame_at(degrees);
        const glm::dvec2 size = frame.upper - frame.lower;
        const double pixel = std::max(size.x, size.y) / double(pixels);
        const auto count = [&](double metres) {
            return static_cast<std::size_t>(std::max(1.0, std::ceil(metres / pixel - 1e-9)));
        };
        OpacityPicture picture{count(size.x), count(size.y), {}};
        picture.pixels.resize(picture.width * picture.height);
        frame.upper = frame.lower + pixel * glm::dvec2(double(picture.width), double(picture.height));
        scene_.place({{0, 1, glm::vec3(0), turned(degrees)}});
        const auto see = [&](const glm::dvec2& place) -> std::optional<glm::vec3> {
            const double x = frame.lower.x + pixel * place.x, y = frame.upper.y - pixel * place.y;
            const glm::dvec3 from = middle_ + x * right_ + y * up_ + reach_ * towards_;
            const auto seen = scene_.seen(glm::vec3(from), glm::vec3(-towards_), light);
            return seen ? std::optional(seen->colour) : std::nullopt;
        };
        fill_rows(picture, 0, picture.height, samples_of_card, see);
        bleed(picture);
        return {std::make_shared<const OpacityPicture>(std::move(picture)), frame};
    }

private:
    CardFrame frame_at(double degrees) const {
        CardFrame frame{middle_, glm::dvec2(std::numeric_limits<double>::max()),
                        glm::dvec2(std::numeric_limits<double>::lowest())};
        const glm::quat turn = turned(degrees);
        for (const glm::vec3& point : mesh_.points) {
            const glm::dvec3 off = glm::dvec3(turn * point) - middle_;
            const glm::dvec2 here(glm::dot(off, right_), glm::dot(off, up_));
            frame.lower = glm::min(frame.lower, here);
            frame.upper = glm::max(frame.upper, here);
        }
        return frame;
    }

    const FrameMesh& mesh_;
    RayMesh rays_;
    PlacedMeshes scene_;
    glm::dvec3 middle_, towards_, right_{0}, up_{0};
    double reach_ = 0;
};

class LandscapeRays {
public:
    LandscapeRays(const PlantedLandscape& landscape, const std::vector<std::vector<CardPicture>>& cards,
                  const LandscapeView& view, const LandscapeLook& look)
        : landscape_(landscape), cards_(cards), look_(look), eye_(view.eye) {
        for (const LandscapeSpecies& species : landscape.species) {
            for (const FrameMesh& mesh : species.levels) bytes_ += bytes_of(mesh);
        }
        add_mesh(landscape.terrain.mesh(look.ground));
        std::vector<RayPlace> places{{0, 1, glm::vec3(0), glm::quat(1, 0, 0, 0)}};
        for (const PlantedPlant& plant : landscape.plants) places.push_back(place_of(plant));
        std::vector<const RayMesh*> meshes;
        for (const auto& mesh : meshes_) meshes.push_back(mesh.get());
        bytes_ += places.size() * bytes_of_place;
        require_memory();
        scene_.emplace(std::move(meshes)).place(std::move(places));
    }

    const PlacedMeshes& scene() const { return *scene_; }

private:
    std::uint32_t add_mesh(const FrameMesh& mesh, const TextureOf& texture_of) {
        meshes_.push_back(std::make_unique<RayMesh>(mesh, texture_of));
        bytes_ += meshes_.back()->bytes();
        require_memory();
        return static_cast<std::uint32_t>(meshes_.size() - 1);
    }
    std::uint32_t add_mesh(const FrameMesh& mesh) { return add_mesh(mesh, look_.texture_of); }

    void require_memory() const {
        if (look_.memory == 0 || bytes_ <= look_.memory) return;
        throw RunError(fmt::format(
            "--memory {}: the meshes of the landscape need more; coarser `levels`, nearer `cards` or smaller plants "
            "need less",
            look_.memory));
    }

    RayPlace place_of(const PlantedPlant& plant) {
        const LandscapeSpecies& species = landscape_.species[plant.species];
        const glm::vec3 foot(plant.position);
        if (plant.level != PlantedPlant::card_level) {
            const auto [at, is_new] = mesh_of_.try_emplace({plant.species, plant.level, 0}, 0);
            if (is_new) at->second = add_mesh(species.levels[plant.level]);
            return {at->second, plant.scale, foot, turned(degrees_of_turn(plant.turn))};
        }
        const CardPicture& card = cards_[plant.species][plant.turn];
        const auto [at, is_new] = mesh_of_.try_emplace({plant.species, plant.level, plant.turn}, 0);
        if (is_new) at->second = add_mesh(card_mesh(card.frame, "card"), [&](const auto&) { return card.picture; });
        const glm::dvec3 middle = plant.position + double(plant.scale) * card.frame.middle;
        return {at->second, plant.scale, glm::vec3(middle), glm::quat(towards_eye(middle, eye_)), true};
    }

    const PlantedLandscape& landscape_;
    const std::vector<std::vector<CardPicture>>& cards_;
    const LandscapeLook& look_;
    glm::dvec3 eye_;
    std::vector<std::unique_ptr<RayMesh>> meshes_;
    std::map<std::array<std::uint16_t, 3>, std::uint32_t> mesh_of_;  ///< by species, level and turn
    std::optional<PlacedMeshes> scene_;
    std::size_t bytes_ = 0;
};

/// Directions of rays through places of a picture.
class LandscapeCamera {
public:
    LandscapeCamera(const LandscapeView& view, const PictureSize& size) : width_(size.width), height_(size.height) {
        const glm::dquat turn = towards_eye(view.target, view.eye);
        right_ = turn * glm::dvec3(1, 0, 0);
        up_ = turn * glm::dvec3(0, 1, 0);
        ahead_ = turn * glm::dvec3(0, 0, -1);
        slope_ = std::tan(glm::radians(view.angle / 2));
    }

    glm::vec3 direction(const glm::dvec2& place) const {
        const double x = (2 * place.x - width_) / height_, y = 1 - 2 * place.y / height_;
        return glm::vec3(glm::normalize(ahead_ + slope_ * (x * right_ + y * up_)));
    }

private:
    double width_, height_, slope_;
    glm::dvec3 right_, up_, ahead_;
};

}  // namespace

std::vector<CardPicture> card_pictures(const LandscapeSpecies& species, const glm::dvec3& towards,
                                       const RayLight& light, std::size_t pixels, const TextureOf& texture_of) {
    CardPainter painter(species, glm::normalize(towards), texture_of);
    std::vector<CardPicture> cards;
    for (std::uint16_t turn = 0; turn < card_turns; ++turn) {
        cards.push_back(painter.card(degrees_of_turn(turn), light, pixels));
    }
    return cards;
}

CardPicture card_picture(const LandscapeSpecies& species, const glm::dvec3& towards, const RayLight& light,
                         std::size_t pixels, const TextureOf& texture_of) {
    return CardPainter(species, glm::normalize(towards), texture_of).card(0, light, pixels);
}

OpacityPicture landscape_picture(const PlantedLandscape& landscape, const std::vector<std::vector<CardPicture>>& cards,
                                 const LandscapeView& view, const RayLight& light, const LandscapeLook& look,
                                 const std::function<void(double share)>& progress) {
    const auto [width, height] = look.size;
    if (width < 1 || height < 1 || width > most_pixels || height > most_pixels) {
        throw UserError(fmt::format("a landscape's picture has 1 to {} pixels along a side, not {}x{}", most_pixels,
                                    width, height));
    }
    const LandscapeRays rays(landscape, cards, view, look);
    const LandscapeCamera camera(view, look.size);
    OpacityPicture picture{static_cast<std::size_t>(look.size.width), static_cast<std::size_t>(look.size.height), {}};
    picture.pixels.resize(picture.width * picture.height);
    const auto see = [&](const glm::dvec2& place) -> std::optional<glm::vec3> {
        const glm::vec3 direction = camera.direction(place);
        const auto seen = rays.scene().seen(glm::vec3(view.eye), direction, light);
        if (!seen) return sky_at(direction);
        const float clear = std::exp(-seen->distance / static_cast<float>(look.visibility));
        return glm::mix(sky_at(glm::vec3(0)), seen->colour, clear);
    };
    for (std::size_t row = 0; row < picture.height; row += rows_of_band) {
        fill_rows(picture, row, std::min(picture.height, row + rows_of_band), look.samples, see);
        progress(static_cast<double>(std::min(picture.height, row + rows_of_band)) / double(picture.height));
    }
    return picture;
}

}  // namespace espalier::picture
