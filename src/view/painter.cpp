#include "view/painter.h"

#include <vtkBrush.h>
#include <vtkPen.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>

#include <cmath>

namespace espalier::view {

using Colour = vtkColor4ub;

const WindowColours& window_colours(bool dark) {
    static const WindowColours on_dark{Colour(38, 41, 47),    Colour(56, 60, 68),     Colour(82, 87, 97),
                                       Colour(234, 236, 240), Colour(164, 170, 180),  Colour(86, 180, 233),
                                       Colour(255, 140, 105), Colour(20, 22, 26, 235)};
    static const WindowColours on_light{Colour(244, 245, 247), Colour(226, 229, 233),     Colour(196, 200, 207),
                                        Colour(28, 31, 36),    Colour(92, 98, 108),       Colour(0, 114, 178),
                                        Colour(190, 40, 20),   Colour(252, 252, 253, 240)};
    return dark ? on_dark : on_light;
}

void Painter::fill(const Rectangle& at, const Colour& colour) {
    context_.GetPen()->SetLineType(vtkPen::NO_PEN);
    context_.GetBrush()->SetColor(colour);
    context_.DrawRect(at.x, at.y, at.width, at.height);
}

void Painter::frame(const Rectangle& at, const Colour& colour) {
    const float right = at.x + at.width, top = at.y + at.height;
    line({{at.x, at.y}, {right, at.y}, {right, top}, {at.x, top}, {at.x, at.y}}, colour);
}

void Painter::shape(const Rectangle& at, std::initializer_list<vtkVector2f> corners, const Colour& colour) {
    std::vector<float> points;
    for (const vtkVector2f& corner : corners) {
        points.push_back(at.x + corner.GetX() * at.width);
        points.push_back(at.y + corner.GetY() * at.height);
    }
    context_.GetPen()->SetLineType(vtkPen::NO_PEN);
    context_.GetBrush()->SetColor(colour);
    context_.DrawPolygon(points.data(), static_cast<int>(corners.size()));
}

void Painter::disc(float x, float y, float radius, const Colour& colour) {
    context_.GetPen()->SetLineType(vtkPen::NO_PEN);
    context_.GetBrush()->SetColor(colour);
    context_.DrawEllipse(x, y, radius, radius);
}

void Painter::line(const std::vector<vtkVector2f>& points, const Colour& colour, float width) {
    if (points.size() < 2) return;
    context_.GetPen()->SetLineType(vtkPen::SOLID_LINE);
    context_.GetPen()->SetColor(colour);
    context_.GetPen()->SetWidth(scaled(width));
    context_.DrawPoly(const_cast<float*>(points.front().GetData()), static_cast<int>(points.size()));
}

void Painter::use_font(const Colour& colour, float size, bool bold) {
    vtkTextProperty* font = context_.GetTextProp();
    font->SetFontFamilyToArial();
    font->SetBold(bold);
    font->SetFontSize(static_cast<int>(std::lround(scaled(size))));
    font->SetColor(colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
    font->SetOpacity(1);
    font->SetJustificationToLeft();
    font->SetVerticalJustificationToBottom();
}

float Painter::width_of(const std::string& words, float size, bool bold) {
    use_font(Colour(0, 0, 0), size, bold);
    float bounds[4] = {0, 0, 0, 0};
    context_.ComputeStringBounds(words, bounds);
    return bounds[2];
}

void Painter::text(float x, float y, const std::string& words, const Colour& colour, float size, bool bold,
                   Align align) {
    if (words.empty()) return;
    if (align != Align::left) x -= width_of(words, size, bold) * (align == Align::centre ? 0.5F : 1.0F);
    use_font(colour, size, bold);
    // The middle of a small letter is a third of the size above the base line, which all words of a line share.
    context_.GetTextProp()->SetVerticalJustificationToBottom();
    context_.DrawString(std::round(x), std::round(y - 0.5F * scaled(size)), words);
}

std::string Painter::fitting(const std::string& words, float width, float size) {
    if (width_of(words, size) <= width) return words;
    std::string cut = words;
    while (!cut.empty() && width_of(cut + "...", size) > width) {
        const auto is_rest_of_letter = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
        while (cut.size() > 1 && is_rest_of_letter(cut.back())) cut.pop_back();
        cut.pop_back();
    }
    return cut + "...";
}

}  // namespace espalier::view
