#include "picture/files/frame_painter.h"

#include "espalier/base/error.h"

#include "picture/stage/legend.h"

#include <fmt/format.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::picture {
namespace {

/// Pixels that are drawn for each along both sides of a picture: edges become smooth.
constexpr int finer = 2;
constexpr int largest = 8192;

const PictureSize& checked(const PictureSize& size) {
    if (size.width >= 1 && size.height >= 1 && size.width <= largest && size.height <= largest) return size;
    throw UserError(
        fmt::format("a picture has 1 to {} pixels along a side, not {}x{}", largest, size.width, size.height));
}

/// Means of blocks of pixels; what is clear does not lend its colour.
vtkSmartPointer<vtkImageData> shrunk(vtkImageData& drawn, const PictureSize& size) {
    auto picture = vtkSmartPointer<vtkImageData>::New();
    const int parts = drawn.GetNumberOfScalarComponents();
    picture->SetDimensions(size.width, size.height, 1);
    picture->AllocateScalars(VTK_UNSIGNED_CHAR, parts);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            std::array<int, 3> colour{};
            int weight = 0;
            for (int k = 0; k < finer * finer; ++k) {
                const auto* from = static_cast<const unsigned char*>(
                    drawn.GetScalarPointer(finer * x + k % finer, finer * y + k / finer, 0));
                const int alpha = parts == 4 ? from[3] : 255;
                for (std::size_t i = 0; i < 3; ++i) colour[i] += alpha * from[i];
                weight += alpha;
            }
            auto* to = static_cast<unsigned char*>(picture->GetScalarPointer(x, y, 0));
            for (std::size_t i = 0; i < 3; ++i) {
                to[i] = static_cast<unsigned char>(weight > 0 ? (colour[i] + weight / 2) / weight : 255);
            }
            if (parts == 4) to[3] = static_cast<unsigned char>((weight + finer * finer / 2) / (finer * finer));
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

vtkSmartPointer<vtkImageData> FramePainter::picture() {
    const bool transparent = stage_.style().background.transparent;
    return shrunk(transparent ? *window_.image_with_alpha() : *window_.image(), size_);
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
