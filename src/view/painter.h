// Rectangles, signs and words in the colours of the window.
#pragma once

#include "view/layout.h"

#include <vtkColor.h>
#include <vtkContext2D.h>
#include <vtkVector.h>

#include <initializer_list>
#include <string>
#include <vector>

namespace espalier::view {

/// What colours are for. Those of lines are told apart by colour-blind readers (Okabe & Ito 2008).
struct WindowColours {
    vtkColor4ub surface, raised, line, text, dim, accent, error, veil;
};
const WindowColours& window_colours(bool dark);

enum class Align { left, centre, right };

class Painter {
public:
    Painter(vtkContext2D& context, float scale) : context_(context), scale_(scale) {}

    float scaled(float pixels) const { return pixels * scale_; }

    void fill(const Rectangle& at, const vtkColor4ub& colour);
    void frame(const Rectangle& at, const vtkColor4ub& colour);
    /// Corners in parts of the rectangle, from its lower left.
    void shape(const Rectangle& at, std::initializer_list<vtkVector2f> corners, const vtkColor4ub& colour);
    void disc(float x, float y, float radius, const vtkColor4ub& colour);
    void line(const std::vector<vtkVector2f>& points, const vtkColor4ub& colour, float width = 1);
    /// `y` is the middle of the letters.
    void text(float x, float y, const std::string& words, const vtkColor4ub& colour, float size = 13, bool bold = false,
              Align align = Align::left);
    float width_of(const std::string& words, float size = 13, bool bold = false);
    /// The words, cut with dots where they are wider.
    std::string fitting(const std::string& words, float width, float size = 13);

private:
    void use_font(const vtkColor4ub& colour, float size, bool bold);

    vtkContext2D& context_;
    float scale_;
};

}  // namespace espalier::view
