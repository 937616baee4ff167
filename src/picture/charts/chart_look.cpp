#include "picture/charts/chart_look.h"

#include <vtkContext2D.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>

namespace espalier::picture {

ChartLook look_of(const ChartPage& page) {
    if (page.dark) {
        return {
            ChartColour(24, 26, 30),
            ChartColour(230, 230, 230),
            ChartColour(150, 150, 155),
            ChartColour(52, 55, 61),
            {ChartColour(86, 180, 233), ChartColour(230, 159, 0), ChartColour(0, 190, 140), ChartColour(224, 142, 186),
             ChartColour(240, 228, 66), ChartColour(237, 109, 40), ChartColour(200, 200, 200)}};
    }
    return {ChartColour(255, 255, 255),
            ChartColour(40, 40, 40),
            ChartColour(120, 120, 120),
            ChartColour(230, 230, 230),
            {ChartColour(0, 114, 178), ChartColour(213, 94, 0), ChartColour(0, 158, 115), ChartColour(204, 121, 167),
             ChartColour(230, 159, 0), ChartColour(86, 180, 233), ChartColour(70, 70, 70)}};
}

int dash_of(const Key& key) {
    constexpr std::array<int, Key::dash_count> dashes{vtkPen::SOLID_LINE, vtkPen::DASH_LINE, vtkPen::DOT_LINE,
                                                      vtkPen::DASH_DOT_LINE};
    return dashes[static_cast<std::size_t>(key.dash)];
}

void set_text(vtkTextProperty& text, const ChartColour& colour, float size) {
    text.SetFontFamilyToArial();
    text.SetColor(colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
    text.SetFontSize(static_cast<int>(size));
    text.SetBold(0);
    text.SetItalic(0);
}

void write(vtkContext2D& painter, const std::string& text, float x, float y, const ChartLetters& letters) {
    vtkNew<vtkTextProperty> property;
    set_text(*property, letters.colour, letters.size);
    property->SetJustification(letters.justification);
    property->SetVerticalJustificationToCentered();
    property->SetOrientation(letters.turned);
    painter.ApplyTextProp(property);
    painter.DrawString(x, y, text);
}

}  // namespace espalier::picture
