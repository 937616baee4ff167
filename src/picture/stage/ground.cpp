#include "picture/stage/ground.h"

#include "picture/stage/textured_plane.h"

#include <tbb/parallel_for.h>
#include <vtkImageData.h>
#include <vtkNew.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace espalier::picture {
namespace {

constexpr int texels = 416, texels_of_sky = 104;  // the sky's light changes slowly, the sun's at the edge of a shadow

/// 1 in the middle, 0 at the rim, without an edge anywhere.
float presence(float distance) {
    const float inside = std::clamp(1 - distance, 0.0f, 1.0f);
    return inside * inside * (3 - 2 * inside);
}

/// The light of the sky on a square about `middle`, and between its samples evenly.
class SkyOnGround {
public:
    SkyOnGround(const SkyVisibility& visibility, const glm::dvec3& middle, double radius)
        : samples_(static_cast<std::size_t>(side) * side) {
        tbb::parallel_for(0, side, [&](int row) {
            for (int column = 0; column < side; ++column) {
                const double x = 2.0 * column / texels_of_sky - 1, z = 2.0 * row / texels_of_sky - 1;
                const glm::vec3 point(middle.x + radius * x, 0, middle.z + radius * z);
                samples_[place(column, row)] = visibility.sky(point, glm::vec3(0, 1, 0), false);
            }
        });
    }
    /// -1 to 1 across the square.
    float at(double x, double z) const {
        const double across = (x + 1) / 2 * texels_of_sky, along = (z + 1) / 2 * texels_of_sky;
        const int column = std::clamp(static_cast<int>(across), 0, side - 2);
        const int row = std::clamp(static_cast<int>(along), 0, side - 2);
        const auto u = static_cast<float>(across - column), v = static_cast<float>(along - row);
        const float here = std::lerp(samples_[place(column, row)], samples_[place(column + 1, row)], u);
        const float next = std::lerp(samples_[place(column, row + 1)], samples_[place(column + 1, row + 1)], u);
        return std::lerp(here, next, v);
    }

private:
    static constexpr int side = texels_of_sky + 1;

    static std::size_t place(int column, int row) { return static_cast<std::size_t>(row * side + column); }

    std::vector<float> samples_;
};

}  // namespace

std::array<float, 3> soil_of(const PictureBackground& background) {
    return background.is_dark() ? std::array{74.0f, 76.0f, 80.0f} : std::array{226.0f, 222.0f, 214.0f};
}

float brightness(float sky, float sun) {
    return 0.36f + 0.36f * sky + 0.28f * sun;
}

vtkSmartPointer<vtkActor> ground_actor(const glm::dvec3& middle, double radius, const SkyVisibility* visibility,
                                       const PictureBackground& background, float opacity) {
    vtkNew<vtkImageData> image;
    image->SetDimensions(texels, texels, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
    auto* const pixels = static_cast<unsigned char*>(image->GetScalarPointer());
    const std::array<float, 3> soil = soil_of(background);
    std::optional<SkyOnGround> sky;
    if (visibility) sky.emplace(*visibility, middle, radius);
    tbb::parallel_for(0, texels, [&](int row) {
        for (int column = 0; column < texels; ++column) {
            const double x = (column + 0.5) / texels * 2 - 1, z = (row + 0.5) / texels * 2 - 1;
            const glm::vec3 point(middle.x + radius * x, 0, middle.z + radius * z);
            const float light = visibility ? brightness(sky->at(x, z), visibility->sun(point, 2)) : 1;
            unsigned char* pixel = pixels + 4 * (static_cast<std::ptrdiff_t>(row) * texels + column);
            for (const float part : soil) *pixel++ = static_cast<unsigned char>(std::lround(light * part));
            *pixel =
                static_cast<unsigned char>(std::lround(255 * opacity * presence(static_cast<float>(std::hypot(x, z)))));
        }
    });
    const glm::dvec3 corner(middle.x - radius, 0, middle.z - radius);
    return textured_plane(corner, corner + glm::dvec3(2 * radius, 0, 0), corner + glm::dvec3(0, 0, 2 * radius), *image);
}

}  // namespace espalier::picture
