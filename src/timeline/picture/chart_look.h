// Colours and letters of charts.
#pragma once

#include "espalier/timeline/chart_page.h"

#include <vtkColor.h>

#include <array>
#include <string>

class vtkTextProperty;

namespace espalier {

using ChartColour = vtkColor4ub;

/// Colours of a page. Those of lines are Okabe & Ito's (2008), without the one that fades on the background.
struct ChartLook {
    ChartColour background, text, axis, grid;
    std::array<ChartColour, Key::colour_count> lines;
};
ChartLook look_of(const ChartPage& page);

/// A line type of vtkPen.
int dash_of(const Key& key);

void set_text(vtkTextProperty& text, const ChartColour& colour, float size);

}  // namespace espalier
