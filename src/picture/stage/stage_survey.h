// What frames of a run hold, for cameras and colours that fit all of them.
#pragma once

#include "picture/stage/colouring.h"
#include "picture/stage/stage.h"

namespace espalier::picture {

/// Adds what a style shows of a frame: its plants, the numbers they are coloured by, and its fields.
void add_survey(const RecordedRun& run, const PictureStyle& style, const Colouring& colouring,
                const RecordedFrame& frame, const FrameGeometry& geometry, StageSurvey& survey);

/// The background of the run's author; else a dark one where most colours are hardly seen on white, or `otherwise`.
PictureBackground chosen_background(const RecordedRun& run, const StageSurvey& survey,
                                    const PictureBackground& otherwise);

/// Of a box, m; 1 of an empty one.
double diagonal(const Box& box);
/// True of what lies in the plane x y, with the thickness that organs have.
bool is_flat_box(const Box& box);

}  // namespace espalier::picture
