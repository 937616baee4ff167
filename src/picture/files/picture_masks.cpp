#include "picture/files/picture_masks.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "base/json_text.h"
#include "base/npy_file.h"
#include "base/png_file.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::picture {
namespace {

namespace fs = std::filesystem;

/// Where a ray ends.
struct Met {
    float depth = 0;
    glm::vec3 normal{0};
    std::int32_t organ = PictureMasks::none;
    bool is_there = false;
};

class Masker {
public:
    Masker(const Stage& stage, const archive::FrameOrgans& organs, const LitScene& scene, const PictureSize& size)
        : stage_(stage),
          organs_(organs),
          scene_(scene),
          camera_(stage.view(), size),
          ahead_(glm::normalize(stage.view().focus - stage.view().position)) {}

    Met pixel(std::size_t x, std::size_t y) const {
        std::array<glm::vec3, 4> origins, directions;
        for (std::size_t k = 0; k < origins.size(); ++k) {
            const auto [origin, direction] = ray(x, y, k % 2 == 0 ? 0.25 : 0.75, k < 2 ? 0.25 : 0.75);
            origins[k] = origin, directions[k] = direction;
        }
        const LitScene::FourSurfaces surfaces = scene_.met(origins, directions);
        std::array<Met, 4> corners;
        for (std::size_t k = 0; k < origins.size(); ++k) {
            if (surfaces[k]) corners[k] = met(origins[k], directions[k], surfaces[k]);
        }
        const Met& most = most_frequent(corners);
        if (!most.is_there) return most;
        const auto [origin, direction] = ray(x, y, 0.5, 0.5);
        const Met middle = met(origin, direction, scene_.met(origin, direction, 0));
        return middle.is_there == most.is_there && middle.organ == most.organ ? middle : most;
    }

private:
    RayCamera::Ray ray(std::size_t x, std::size_t y, double right, double down) const {
        return camera_.through({static_cast<double>(x) + right, static_cast<double>(y) + down});
    }

    /// `first`: the first surface, opaque or not.
    Met met(const glm::vec3& origin, const glm::vec3& direction, const std::optional<LitSurface>& first) const {
        const auto surface = opaque(origin, direction, first);
        if (!surface || is_beyond_disc(*surface)) return {};
        Met met{0, surface->normal, PictureMasks::none, true};
        const glm::dvec3 way = static_cast<double>(surface->distance) * glm::dvec3(direction);
        met.depth = static_cast<float>(glm::dot(glm::dvec3(origin) + way - stage_.view().position, ahead_));
        if (surface->is_ground) return met;
        const auto row = stage_.row_of_lit(surface->part, surface->triangle);
        if (!row) return met;  // of the background
        const auto number = row->of_points ? organs_.of_point(row->row) : organs_.of_cell(row->row);
        if (number) met.organ = static_cast<std::int32_t>(*number);
        return met;
    }

    std::optional<LitSurface> opaque(const glm::vec3& origin, const glm::vec3& direction,
                                     std::optional<LitSurface> surface) const {
        constexpr int most_layers = 64;
        for (int layer = 0; layer < most_layers; ++layer) {
            if (!surface || surface->opacity >= 0.5F) return surface;
            surface = scene_.met(origin, direction, surface->distance + scene_.gap(surface->point));
        }
        return std::nullopt;
    }

    bool is_beyond_disc(const LitSurface& surface) const {
        if (!surface.is_ground || !scene_.ground()->is_disc) return false;
        const glm::dvec3 off = glm::dvec3(surface.point) - scene_.ground()->middle;
        return glm::length(glm::dvec2(off.x, off.z)) > scene_.ground()->radius / 2;  // it fades away; here half is left
    }

    /// Of plants, if half of them are; then of what is there; of two as frequent the nearer.
    static const Met& most_frequent(const std::array<Met, 4>& all) {
        const auto organs = std::count_if(all.begin(), all.end(), [](const Met& met) { return met.organ >= 0; });
        const auto counts = [&](const Met& met) { return 2 * organs >= 4 ? met.organ >= 0 : met.organ < 0; };
        const auto like = [&](const Met& one) {
            return std::count_if(all.begin(), all.end(), [&](const Met& other) {
                return other.organ == one.organ && other.is_there == one.is_there;
            });
        };
        const Met* best = nullptr;
        for (const Met& met : all) {
            if (!counts(met)) continue;
            const auto difference = best ? like(met) - like(*best) : 1;
            if (difference > 0 || (difference == 0 && met.is_there && (!best->is_there || met.depth < best->depth))) {
                best = &met;
            }
        }
        return *best;
    }

    const Stage& stage_;
    const archive::FrameOrgans& organs_;
    const LitScene& scene_;
    RayCamera camera_;
    glm::dvec3 ahead_;
};

fs::path beside(const fs::path& picture, const std::string& name) {
    return picture.parent_path() / (picture.stem().string() + "-" + name);
}

/// How a place of the run becomes a pixel, in OpenCV's words: x to the right, y down, z ahead, and the middle of the
/// upper left pixel at 0, 0.
std::string camera_text(const CameraView& view, std::size_t width, std::size_t height) {
    const glm::dvec3 ahead = glm::normalize(view.focus - view.position);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, view.up)), down = glm::cross(ahead, right);
    const double half = view.is_parallel ? view.half_height : std::tan(glm::radians(view.view_angle / 2));
    const double scale = static_cast<double>(height) / 2 / half;
    const double x = static_cast<double>(width) * (1 + view.shift.x) / 2 - 0.5;
    const double y = static_cast<double>(height) * (1 - view.shift.y) / 2 - 0.5;
    nlohmann::ordered_json json;
    json["projection"] = view.is_parallel ? "parallel" : "perspective";
    json["width"] = width;
    json["height"] = height;
    json["K"] = {{scale, 0.0, x}, {0.0, scale, y}, {0.0, 0.0, 1.0}};
    for (const glm::dvec3& axis : {right, down, ahead}) {
        json["world_to_camera"].push_back({axis.x, axis.y, axis.z, -glm::dot(axis, view.position)});
    }
    json["world_to_camera"].push_back({0.0, 0.0, 0.0, 1.0});
    return json_text(json) + "\n";
}

/// What a pixel's organ belongs to, plus 1; 0: no organ.
template <class Number>
GreyPicture numbers(const PictureMasks& masks, const Number& number) {
    GreyPicture picture{masks.width, masks.height, {}};
    picture.pixels.reserve(masks.organs.size());
    for (const std::int32_t organ : masks.organs) {
        const std::size_t value = organ < 0 ? 0 : 1 + static_cast<std::size_t>(number(static_cast<std::size_t>(organ)));
        if (value > 65535) throw RunError("masks: pictures of plants and symbols have numbers up to 65,534");
        picture.pixels.push_back(static_cast<std::uint16_t>(value));
    }
    return picture;
}

}  // namespace

MaskScene::MaskScene(const Stage& stage)
    : stage_(stage), organs_(stage.geometry()), scene_(stage.lit_parts(), stage.hiding_ground()) {}

PictureMasks MaskScene::masks(const PictureSize& size) const {
    const auto width = static_cast<std::size_t>(size.width), height = static_cast<std::size_t>(size.height);
    PictureMasks masks{width, height, {}, {}, {}};
    masks.depths.resize(width * height);
    masks.normals.resize(width * height);
    masks.organs.resize(width * height);
    const Masker masker(stage_, organs_, scene_, size);
    tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            const Met met = masker.pixel(x, y);
            masks.depths[y * width + x] = met.depth;
            masks.normals[y * width + x] = met.normal;
            masks.organs[y * width + x] = met.organ;
        }
    });
    return masks;
}

std::vector<fs::path> write_masks(const PictureMasks& masks, const archive::FrameOrgans& organs, const RecordedRun& run,
                                  const Stage& stage, const fs::path& picture) {
    std::vector<fs::path> files;
    const auto write = [&](const std::string& name, const std::string& bytes) {
        files.push_back(beside(picture, name));
        write_text(files.back(), bytes);
    };
    const std::array size{masks.height, masks.width};
    write("depth.npy", npy_bytes<float>(size, masks.depths));
    write("normal.npy", npy_bytes<float>(std::array{size[0], size[1], std::size_t{3}},
                                         {&masks.normals.data()->x, 3 * masks.normals.size()}));
    write("organ.npy", npy_bytes<std::int32_t>(size, masks.organs));
    write("plant.png", png_bytes(numbers(masks, [&](std::size_t organ) { return organs.all()[organ].plant; })));
    write("symbol.png", png_bytes(numbers(masks, [&](std::size_t organ) { return organs.all()[organ].symbol; })));
    std::vector<std::size_t> pixels(organs.all().size(), 0);
    for (const std::int32_t organ : masks.organs) {
        if (organ >= 0) ++pixels[static_cast<std::size_t>(organ)];
    }
    std::vector<std::string> plants;
    for (const RecordedPlant& plant : run.plants()) plants.push_back(plant.name);
    write("organs.csv", organ_table(organs, stage.geometry().symbol_names, plants, stage.shown()->step, pixels));
    write("camera.json", camera_text(stage.view(), masks.width, masks.height));
    return files;
}

}  // namespace espalier::picture
