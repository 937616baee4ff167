#include "picture/files/frame_painter.h"

#include "espalier/base/error.h"

#include "picture/stage/legend.h"
#include "picture/stage/sky_visibility.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <vtkCamera.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace espalier::picture {
namespace {

/// Pixels that are drawn for each along both sides of a picture: edges become smooth.
constexpr int finer = 2;
constexpr std::size_t block_side = finer;
constexpr int largest_side = 8192;

const PictureSize& checked(const PictureSize& size) {
    if (size.width >= 1 && size.height >= 1 && size.width <= largest_side && size.height <= largest_side) return size;
    throw UserError(
        fmt::format("a picture has 1 to {} pixels along a side, not {}x{}", largest_side, size.width, size.height));
}

/// The mean of a block of pixels, whose rows are `row` bytes apart; what is clear does not lend its colour.
void mean_of(const unsigned char* block, std::size_t row, std::size_t parts, unsigned char* to) {
    std::array<int, 3> colour{};
    int weight = 0;
    for (std::size_t k = 0; k < block_side * block_side; ++k) {
        const unsigned char* const pixel = block + k / block_side * row + k % block_side * parts;
        const int alpha = parts == 4 ? pixel[3] : 255;
        for (std::size_t i = 0; i < 3; ++i) colour[i] += alpha * pixel[i];
        weight += alpha;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        to[i] = static_cast<unsigned char>(weight > 0 ? (colour[i] + weight / 2) / weight : 255);
    }
    constexpr int count = finer * finer;
    if (parts == 4) to[3] = static_cast<unsigned char>((weight + count / 2) / count);
}

/// Means of blocks of pixels.
vtkSmartPointer<vtkImageData> shrunk(vtkImageData& drawn, const PictureSize& size) {
    auto picture = vtkSmartPointer<vtkImageData>::New();
    const int parts = drawn.GetNumberOfScalarComponents();
    picture->SetDimensions(size.width, size.height, 1);
    picture->AllocateScalars(VTK_UNSIGNED_CHAR, parts);
    const auto* const from = static_cast<const unsigned char*>(drawn.GetScalarPointer());
    auto* const to = static_cast<unsigned char*>(picture->GetScalarPointer());
    const auto width = static_cast<std::size_t>(size.width), height = static_cast<std::size_t>(size.height);
    const auto bytes = static_cast<std::size_t>(parts);
    tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t row = bytes * block_side * width;
            mean_of(from + block_side * (y * row + x * bytes), row, bytes, to + bytes * (y * width + x));
        }
    });
    return picture;
}

using Pixel = std::array<float, 4>;  // red, green, blue and opacity, from 0 to 1

/// What is drawn over something else (Porter & Duff 1984).
Pixel over(const Pixel& upper, const Pixel& lower) {
    const float rest = lower[3] * (1 - upper[3]), opacity = upper[3] + rest;
    Pixel both{0, 0, 0, opacity};
    for (std::size_t k = 0; k < 3 && opacity > 0; ++k) both[k] = (upper[3] * upper[k] + rest * lower[k]) / opacity;
    return both;
}

Pixel pixel_of(const unsigned char* bytes) {
    return {bytes[0] / 255.0F, bytes[1] / 255.0F, bytes[2] / 255.0F, bytes[3] / 255.0F};
}

/// A traced picture over its background, under what is drawn over it: `on_black` and `on_white` are that, and differ by
/// what is seen through.
vtkSmartPointer<vtkImageData> composed(const OpacityPicture& traced, vtkImageData& on_black, vtkImageData& on_white,
                                       const PictureBackground& background) {
    auto picture = vtkSmartPointer<vtkImageData>::New();
    const int channels = background.transparent ? 4 : 3;
    picture->SetDimensions(static_cast<int>(traced.width), static_cast<int>(traced.height), 1);
    picture->AllocateScalars(VTK_UNSIGNED_CHAR, channels);
    const auto& [red, green, blue] = background.rgb;
    const std::array<unsigned char, 4> behind{red, green, blue,
                                              background.transparent ? std::uint8_t{0} : std::uint8_t{255}};
    const auto *black = static_cast<const unsigned char*>(on_black.GetScalarPointer()),
               *white = static_cast<const unsigned char*>(on_white.GetScalarPointer());
    auto* to = static_cast<unsigned char*>(picture->GetScalarPointer());
    for (std::size_t y = traced.height; y-- > 0;) {
        for (std::size_t x = 0; x < traced.width; ++x, black += 3, white += 3, to += channels) {
            const Pixel plants = over(pixel_of(traced.at(x, y).data()), pixel_of(behind.data()));
            float through = 0;
            for (int k = 0; k < 3; ++k) through += static_cast<float>(std::max(0, white[k] - black[k])) / (3 * 255);
            const float rest = plants[3] * through, opacity = 1 - through + rest;
            for (std::size_t k = 0; k < 3; ++k) {
                const float colour = opacity > 0 ? (black[k] / 255.0F + rest * plants[k]) / opacity : 0;
                to[k] = static_cast<unsigned char>(std::lround(255 * std::min(1.0F, colour)));
            }
            if (channels == 4) to[3] = static_cast<unsigned char>(std::lround(255 * opacity));
        }
    }
    return picture;
}

}  // namespace

FramePainter::FramePainter(const RecordedRun& run, const PictureStyle& style, const PictureSize& size)
    : size_(checked(size)), window_(finer * size.width, finer * size.height, 0), stage_(run, style) {
    window_.window().SetAlphaBitPlanes(1);
    window_.window().AddRenderer(&stage_.renderer());
}

FramePainter::~FramePainter() {
    window_.window().RemoveRenderer(&stage_.renderer());
}

vtkSmartPointer<vtkImageData> FramePainter::drawn() {
    return stage_.style().background.transparent ? window_.image_with_alpha() : window_.image();
}

vtkSmartPointer<vtkImageData> FramePainter::picture() {
    return shrunk(*drawn(), size_);
}

void FramePainter::add() {
    const auto image = drawn();
    std::vector<float> distances = window_.distances(*stage_.renderer().GetActiveCamera());
    if (!kept_) {
        kept_ = image;
        distances_ = std::move(distances);
        return;
    }
    const auto parts = static_cast<std::size_t>(image->GetNumberOfScalarComponents());
    const auto* from = static_cast<const unsigned char*>(image->GetScalarPointer());
    auto* to = static_cast<unsigned char*>(kept_->GetScalarPointer());
    for (std::size_t i = 0; i < distances.size(); ++i) {
        if (!(distances[i] < distances_[i])) continue;
        distances_[i] = distances[i];
        std::copy_n(from + parts * i, parts, to + parts * i);
    }
}

vtkSmartPointer<vtkImageData> FramePainter::picture_of_all() {
    return shrunk(*std::exchange(kept_, nullptr), size_);
}

vtkSmartPointer<vtkImageData> FramePainter::traced(const PictureSky& sky, const TraceProgress& progress) {
    const PictureStyle& style = stage_.style();
    const std::optional<LitGround> ground = stage_.lit_ground();
    const LitScene scene(stage_.lit_parts(), ground);
    const auto [azimuth, elevation] = sky.sun.value_or(std::array{style.sun_azimuth, style.sun_elevation});
    const SkyLight light(sky, direction_at(azimuth, elevation));
    const PathTracer tracer(scene, light, ground ? ground->reflectance : open_ground);
    const OpacityPicture picture = traced_picture(tracer, light, stage_.view(), size_, *style.light, progress);
    stage_.clear_for_light(0);
    const auto on_black = shrunk(*window_.image(), size_);
    stage_.clear_for_light(1);
    return composed(picture, *on_black, *shrunk(*window_.image(), size_), style.background);
}

vtkSmartPointer<vtkImageData> picture_of(const Legend& legend, const PictureBackground& background, int height) {
    Legend keys;
    keys.keys = legend.keys;
    keys.dark = legend.dark;
    const PictureSize size{static_cast<int>(std::ceil(keys.width(height))), height};
    OffScreenWindow window(finer * size.width, finer * size.height, 0);
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(background.rgb[0] / 255.0, background.rgb[1] / 255.0, background.rgb[2] / 255.0);
    renderer->SetBackgroundAlpha(background.transparent ? 0 : 1);
    vtkNew<vtkContextActor> actor;
    vtkNew<LegendItem> item;
    item->legend = keys;
    actor->GetScene()->AddItem(item);
    renderer->AddActor(actor);
    window.window().SetAlphaBitPlanes(1);
    window.window().AddRenderer(renderer);
    const auto picture = shrunk(background.transparent ? *window.image_with_alpha() : *window.image(), size);
    window.window().RemoveRenderer(renderer);
    return picture;
}

}  // namespace espalier::picture
