// Pictures of small runs, and what is seen where.
#pragma once

#include "archive/recorded_folder.h"
#include "catch.h"
#include "picture/files/frame_painter.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkRenderer.h>

#include <array>
#include <cmath>

namespace espalier {

using namespace espalier::picture;

/// Says why, if nothing can be drawn here.
inline bool can_draw() {
    const std::string reason = why_no_pictures();
    if (!reason.empty()) WARN("skipped: " << reason);
    return reason.empty();
}

using Pixel = std::array<int, 4>;  ///< alpha is 255 where a picture has none

inline Pixel pixel_at(vtkImageData& image, int x, int y) {
    const auto* from = static_cast<const unsigned char*>(image.GetScalarPointer(x, y, 0));
    return {from[0], from[1], from[2], image.GetNumberOfScalarComponents() == 4 ? from[3] : 255};
}

inline bool is_white(const Pixel& pixel) {
    return pixel[0] == 255 && pixel[1] == 255 && pixel[2] == 255;
}

/// A run made by hand, and its frames as pictures of 240x180 pixels, seen from the front unless said otherwise.
struct Pictured {
    static constexpr int width = 240, height = 180;

    RunFolder folder;
    std::optional<RecordedRun> run;
    std::optional<FramePainter> painter;

    explicit Pictured(const std::vector<const HandmadePlant*>& plants) {
        Timeline timeline(folder.path, timeline_table("parameters = { vigour = \"F.2\" }\nfields = [\"light\"]\n"), 1);
        Fields fields;
        fields.provide(light_field(0.5f));
        for (const int step : {0, 1}) record(timeline, step, plants, fields);
        timeline.finish();
        timeline.write_run(run_json);
        run.emplace(folder.path);
    }

    static PictureStyle plain() {
        PictureStyle style;
        style.shading = false;
        style.legend = false;
        return style;
    }

    vtkSmartPointer<vtkImageData> picture(const PictureStyle& style = plain(), CameraPlace place = {0, 0}) {
        if (!painter) painter.emplace(*run, style, PictureSize{width, height});
        painter->stage().restyle(style);
        painter->stage().show(run->frames().back());
        painter->stage().place_camera(place);
        return painter->picture();
    }

    /// What is seen at a place of the scene.
    Pixel seen(vtkImageData& image, const glm::dvec3& place) {
        vtkRenderer& renderer = painter->stage().renderer();
        renderer.SetWorldPoint(place.x, place.y, place.z, 1);
        renderer.WorldToDisplay();
        const double* display = renderer.GetDisplayPoint();
        const int* drawn = renderer.GetSize();
        const int x = static_cast<int>(display[0] * width / drawn[0]),
                  y = static_cast<int>(display[1] * height / drawn[1]);
        REQUIRE(x >= 0);
        REQUIRE(x < width);
        REQUIRE(y >= 0);
        REQUIRE(y < height);
        return pixel_at(image, x, y);
    }
};

inline vtkSmartPointer<vtkImageData> read_png(const std::filesystem::path& path) {
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader->GetOutput();
}

}  // namespace espalier
