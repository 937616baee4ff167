// Draws frames of a run into pictures of one size.
#pragma once

#include "espalier/picture/chart_page.h"
#include "espalier/picture/picture_style.h"

#include "picture/files/off_screen.h"
#include "picture/files/traced_picture.h"
#include "picture/stage/stage.h"

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace espalier::picture {

class FramePainter {
public:
    /// Throws UserError for a size that cannot be drawn, RunError where nothing can.
    FramePainter(const RecordedRun& run, const PictureStyle& style, const PictureSize& size);
    ~FramePainter();
    FramePainter(const FramePainter&) = delete;
    FramePainter& operator=(const FramePainter&) = delete;

    Stage& stage() { return stage_; }
    /// What the stage shows, 8 bits red, green and blue per pixel, and alpha if the background is transparent.
    vtkSmartPointer<vtkImageData> picture();
    /// Keeps what the stage shows, where it is nearer than what was kept before.
    void add();
    /// What add() kept, as picture(); then nothing is kept.
    vtkSmartPointer<vtkImageData> picture_of_all();
    /// The same for a style with `light`.
    vtkSmartPointer<vtkImageData> traced(const PictureSky& sky, const TraceProgress& progress = {});

private:
    vtkSmartPointer<vtkImageData> drawn();

    PictureSize size_;
    OffScreenWindow window_;
    Stage stage_;
    vtkSmartPointer<vtkImageData> kept_;
    std::vector<float> distances_;  ///< of the pixels that are kept
};

/// The keys of a legend alone.
vtkSmartPointer<vtkImageData> picture_of(const Legend& legend, const PictureBackground& background, int height);

}  // namespace espalier::picture
