// Draws frames of a run into pictures of one size.
#pragma once

#include "espalier/timeline/chart_page.h"
#include "espalier/timeline/picture_style.h"

#include "timeline/picture/off_screen.h"
#include "timeline/picture/stage.h"

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

namespace espalier {

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

private:
    PictureSize size_;
    OffScreenWindow window_;
    Stage stage_;
};

/// The keys of a legend alone.
vtkSmartPointer<vtkImageData> picture_of(const Legend& legend, const PictureBackground& background, int height);

}  // namespace espalier
