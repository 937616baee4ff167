// A line over the steps, small enough for a panel.
#pragma once

#include "view/overlay.h"
#include "view/painter.h"

namespace espalier::view {

void paint_chart(Painter& painter, const Rectangle& at, const SmallChart& chart, double now,
                 const WindowColours& colours);

}  // namespace espalier::view
