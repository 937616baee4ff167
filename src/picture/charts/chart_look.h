// Colours and letters of charts.
#pragma once

#include "espalier/picture/chart_page.h"

#include <vtkColor.h>
#include <vtkContextItem.h>
#include <vtkSmartPointer.h>

#include <array>
#include <string>

class vtkContext2D;
class vtkRectf;
class vtkTextProperty;

namespace espalier::picture {

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

struct ChartLetters {
    ChartColour colour;
    float size;
    int justification;  ///< along the line, as VTK says it; across it the middle is meant
    double turned;      ///< degrees
};
void write(vtkContext2D& painter, const std::string& text, float x, float y, const ChartLetters& letters);

/// An item that draws a chart at its place on a page.
template <class Item>
vtkSmartPointer<vtkContextItem> placed_item(const ChartPage& page, const Chart& chart, const vtkRectf& place,
                                            float font) {
    const auto item = vtkSmartPointer<Item>::New();
    item->set(page, chart, place, font);
    return item;
}

}  // namespace espalier::picture
