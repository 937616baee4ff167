// The help of view files against what reads them.
#include "espalier/turtle/view_setting.h"

#include "espalier/turtle/view_file.h"

#include "catch.h"

#include <string>

using namespace espalier;
using namespace espalier::turtle;

namespace {

View view_told(const std::string& text) {
    return read_view_text(text, "a.v");
}

bool same(const View& a, const View& b) {
    return a.turtle.angle == b.turtle.angle && a.turtle.colour == b.turtle.colour &&
           a.turtle.colour_increment == b.turtle.colour_increment && a.turtle.line_width == b.turtle.line_width &&
           a.turtle.line_width_increment == b.turtle.line_width_increment &&
           a.turtle.line_style == b.turtle.line_style && a.turtle.scale == b.turtle.scale &&
           a.turtle.scale_multiplier == b.turtle.scale_multiplier && a.turtle.past_cut == b.turtle.past_cut &&
           a.turtle.contour_sides == b.turtle.contour_sides && a.turtle.tapered_lines == b.turtle.tapered_lines &&
           a.turtle.twist_of_cylinders == b.turtle.twist_of_cylinders &&
           a.turtle.initial_elasticity == b.turtle.initial_elasticity &&
           a.turtle.elasticity_increment == b.turtle.elasticity_increment && a.exchanges_first == b.exchanges_first &&
           a.camera.eye == b.camera.eye && a.camera.target == b.camera.target && a.camera.twist == b.camera.twist &&
           a.camera.perspective == b.camera.perspective && a.camera.angle == b.camera.angle &&
           a.camera.front == b.camera.front && a.camera.back == b.camera.back && a.camera.scale == b.camera.scale;
}

}  // namespace

TEST_CASE("every setting of view files says what it means", "[turtle]") {
    const std::vector<ViewSetting> settings = view_settings();
    CHECK(settings.size() == 62);
    for (const ViewSetting& setting : settings) {
        INFO(setting.label);
        CHECK(setting.label.ends_with(':'));
        CHECK_FALSE(setting.values.empty());
        CHECK_FALSE(setting.value.help.empty());
        CHECK((setting.value.kind == ViewKind::letters) == !setting.letters.empty());
    }
}

TEST_CASE("the standard of a setting is what holds without it", "[turtle]") {
    const View empty = view_told("");
    int checked = 0;
    for (const ViewSetting& setting : view_settings()) {
        // A width without a word is one of polygons: it sets the line style too.
        if (setting.value.standard.empty() || setting.label == "initial line width:") continue;
        const std::string line = std::string(setting.label) + " " + std::string(setting.value.standard) + "\n";
        INFO(line);
        const View view = view_told(line);
        CHECK(view.diagnostics.empty());
        CHECK(same(view, empty));
        ++checked;
    }
    CHECK(checked == 25);
}

TEST_CASE("each word and each letter of a setting is one that is read", "[turtle]") {
    for (const ViewSetting& setting : view_settings()) {
        std::string line = std::string(setting.label);
        for (const ViewValue& letter : setting.letters) {
            if (letter.letter == 'O') continue;  // a light has a place or a direction
            const std::string values = !letter.standard.empty()          ? std::string(letter.standard)
                                       : letter.kind == ViewKind::file   ? "a.png"
                                       : letter.kind == ViewKind::vector ? "0 1 0"
                                                                         : "";
            line += std::string(" ") + letter.letter + " " + values;
        }
        if (setting.value.kind == ViewKind::letters && setting.label != "texture:") {
            INFO(line);
            CHECK(view_told(line).diagnostics.empty());
        }
        std::string words(setting.value.words);
        for (std::size_t begin = 0, end; begin < words.size(); begin = end + 1) {
            end = std::min(words.find(' ', begin), words.size());
            const std::string one = std::string(setting.label) + " " + words.substr(begin, end - begin);
            INFO(one);
            CHECK(view_told(one).diagnostics.empty());
        }
    }
}
