// Lines, bands and dots over two axes, on a page of charts.
#pragma once

#include "espalier/picture/chart_page.h"

#include <vtkContextItem.h>
#include <vtkSmartPointer.h>

class vtkRectf;

namespace espalier::picture {

/// Drawn in pixels: of a vtkChartXY the SVG exporter clips the lines away, because it puts them into a space of their
/// own. Page and chart outlive the item.
vtkSmartPointer<vtkContextItem> line_chart_item(const ChartPage& page, const Chart& chart, const vtkRectf& place,
                                                float font);

}  // namespace espalier::picture
