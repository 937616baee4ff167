// What is written on a picture: colour bars, names with their colours, a title, the time, a scale bar.
#pragma once

#include "picture/stage/colouring.h"

#include <vtkContextItem.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkContextActor;

namespace espalier::picture {

struct Legend {
    std::vector<ColourKey> keys;
    std::string title, time;
    std::string caption;  ///< in the middle of the lower edge
    bool shows_keys = true;
    double metres_per_pixel = 0;  ///< metres in a pixel of the scale bar; 0: none
    bool dark = false;

    /// The part of a picture's width that the keys take at its right end, in pixels.
    float width(int picture_height) const;
};

/// Draws a legend over all else.
class LegendItem final : public vtkContextItem {
public:
    static LegendItem* New();
    vtkTypeMacro(LegendItem, vtkContextItem)

    bool Paint(vtkContext2D* painter) override;

    Legend legend;
};

/// A length of 1, 2 or 5 times a power of ten, at most so many metres, and how it is written: "0.5 m", "20 cm".
struct NiceLength {
    double metres;
    std::string text;
};
NiceLength nice_length(double most);

}  // namespace espalier::picture
