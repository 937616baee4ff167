// A heat map on a page of charts: a number for every pair of two names, as coloured cells, with a colour bar.
#pragma once

#include "espalier/picture/chart_page.h"

#include <vtkContextItem.h>
#include <vtkSmartPointer.h>

class vtkRectf;

namespace espalier::picture {

/// `chart.map` is there; page and chart outlive the item.
vtkSmartPointer<vtkContextItem> heat_map_item(const ChartPage& page, const Chart& chart, const vtkRectf& place,
                                              float font);

}  // namespace espalier::picture
