// The panels of sliders that the author of a document has laid out.
#pragma once

#include "espalier/base/error.h"

#include "studio/protocol/declaration.h"
#include "studio/session/document_texts.h"

#include <string>
#include <vector>

namespace espalier::studio {

struct ShownSlider {
    static constexpr TypeName type{"Slider", "a setting of a panel; what is null is as the setting has it"};
    std::string name;
    Nullable<std::string> label, unit;
    Nullable<double> lowest, highest, step;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("name", self.name, "of the setting");
        field("label", self.label, "what it is, for people");
        field("unit", self.unit, "empty for a pure number");
        field("lowest", self.lowest, "left end; the number beside may be less");
        field("highest", self.highest, "right end; the number beside may be more");
        field("step", self.step, "between two values, from the left end on");
    }
};

struct ShownPanel {
    static constexpr TypeName type{"Panel", "a group of sliders as the author laid it out"};
    std::string title;
    int columns = 1;
    bool is_open = true;
    std::vector<ShownSlider> sliders;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("title", self.title, "its heading");
        field("columns", self.columns, "how many sliders stand side by side where there is room", at_least(1));
        field("open", self.is_open, "it is open at first");
        field("sliders", self.sliders, "in the order of the author");
    }
};

/// Those of settings that there are; none of a text with mistakes, which the growth tells.
std::vector<ShownPanel> shown_panels(const DocumentTexts& texts, const DocumentState& state);

/// Sliders of settings that there are not, or beyond what these may be.
std::vector<Diagnostic> panel_warnings(const DocumentTexts& texts, const DocumentState& state);

}  // namespace espalier::studio
