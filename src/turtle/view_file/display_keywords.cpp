#include "turtle/view_file/reader.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cctype>

namespace espalier::turtle {
namespace {

using Severity = Diagnostic::Severity;

constexpr std::size_t most_lights = 8;
constexpr std::array<std::string_view, 7> render_modes{"wireframe", "filled", "flat",   "interpolated",
                                                       "shaded",    "fast",   "shadows"};

// Settings of a window alone are read as far as it takes to find the next.
void skip_number(ViewReader& reader) {
    double value = 0;
    reader.read_number(value);
}

void skip_integer(ViewReader& reader) {
    int value = 0;
    reader.read_integer(value);
}

void skip_vector(ViewReader& reader) {
    glm::dvec3 value(0);
    reader.read_vector(value);
}

void skip_word(ViewReader& reader) {
    reader.read_word();
}

void skip_line(ViewReader& reader) {
    reader.rest_of_line();
}

void viewpoint(ViewReader& reader) {
    reader.read_vector(reader.view.camera.eye);
}

void view_reference_point(ViewReader& reader) {
    reader.read_vector(reader.view.camera.target);
}

void twist(ViewReader& reader) {
    constexpr double tenth = 0.1;
    int tenths = 0;
    if (reader.read_integer(tenths)) reader.view.camera.twist = tenths * tenth;
}

void projection(ViewReader& reader) {
    const auto word = reader.read_word();
    if (!word) return;
    reader.view.camera.perspective = word->starts_with("perspective");
    if (word->starts_with("perspective") || word->starts_with("parallel")) return;
    reader.complain(fmt::format("'{}' is no projection (parallel, perspective)", *word), Severity::warning);
}

void viewing_angle(ViewReader& reader) {
    reader.read_number(reader.view.camera.angle);
}

void front_distance(ViewReader& reader) {
    reader.read_number(reader.view.camera.front);
}

void back_distance(ViewReader& reader) {
    reader.read_number(reader.view.camera.back);
}

void scale_factor(ViewReader& reader) {
    double& scale = reader.view.camera.scale;
    if (reader.read_number(scale) && scale == 0) scale = 1;
}

void box(ViewReader& reader) {
    Box box;
    constexpr std::array letters{"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        if (!reader.accept(letters[std::size_t(axis)]) || !reader.accept(":")) return reader.too_few();
        if (!reader.read_number(box.lower[axis]) || !reader.read_number(box.upper[axis])) return;
    }
    reader.view.camera.box = box;
}

// cpfg knows the keyword and ignores it. Numbers beyond 1 count to 255.
void background_color(ViewReader& reader) {
    constexpr double bytes = 255;
    glm::dvec3 colour(0);
    reader.read_vector(colour);
    const double most = std::max({colour.x, colour.y, colour.z});
    reader.view.background_colour = glm::clamp(most > 1 ? colour / bytes : colour, 0.0, 1.0);
}

void light_direction(ViewReader& reader) {
    glm::dvec3 direction(1, 0, 0);
    reader.read_vector(direction);
    if (glm::length(direction) > 0) reader.view.light_direction = glm::normalize(direction);
}

void render_mode(ViewReader& reader) {
    const auto word = reader.read_word();
    if (!word) return;
    std::size_t mode = std::size_t(std::find(render_modes.begin(), render_modes.end(), *word) - render_modes.begin());
    if (std::isdigit(static_cast<unsigned char>((*word)[0]))) mode = std::size_t((*word)[0] - '0') - 1;
    if (mode < render_modes.size()) reader.view.render_mode = render_modes[mode];
}

// The older numbers of the render modes.
void shade_mode(ViewReader& reader) {
    constexpr std::array<std::string_view, 8> modes{"filled",    "filled",    "interpolated", "shaded",
                                                    "wireframe", "wireframe", "shaded",       "wireframe"};
    int mode = 0;
    if (!reader.read_integer(mode)) return;
    reader.view.render_mode = mode >= 0 && mode < int(modes.size()) ? modes[std::size_t(mode)] : "filled";
}

void background_scene(ViewReader& reader) {
    reader.view.backgrounds.clear();
    for (const ViewWord& word : reader.rest_of_line(" \t\r,;")) {
        reader.view.backgrounds.push_back(reader.require_file(word.text));
    }
    if (reader.view.backgrounds.empty()) reader.too_few();
}

/// One line of sub-commands, each starting from the defaults.
class LightLine {
public:
    explicit LightLine(ViewReader& reader) : reader_(reader), words_(reader.rest_of_line()) {}

    void read() {
        if (reader_.view.lights.size() == most_lights) {
            return reader_.complain(fmt::format("more than {} lights; this one is ignored", most_lights),
                                    Severity::warning);
        }
        while (next_ < words_.size()) {
            if (!read_command()) return;
        }
        reader_.view.lights.push_back(light_);
    }

private:
    // False if the line is ignored.
    bool read_command() {
        const ViewWord& command = words_[next_++];
        switch (command.text[0]) {
            case 'O':
                light_.directional = false;
                return read_vector(command, light_.vector);
            case 'V':
                light_.directional = true;
                return read_vector(command, light_.vector);
            case 'A':
                return read_vector(command, light_.ambient);
            case 'D':
                return read_vector(command, light_.diffuse);
            case 'S':
                return read_vector(command, light_.specular);
            case 'P':
                return read_vector(command, light_.spot_direction) && read_value(command, light_.spot_exponent) &&
                       read_value(command, light_.spot_cutoff);
            case 'T':
                return read_vector(command, light_.attenuation);
            default:
                return refuse(command, fmt::format("'{}' is none of O, V, A, D, S, P, T", command.text));
        }
    }

    bool refuse(const ViewWord& word, const std::string& why) {
        reader_.complain(word.place.diagnostic(why + "; the line is ignored"));
        return false;
    }

    bool read_vector(const ViewWord& command, glm::dvec3& vector) {
        return read_value(command, vector.x) && read_value(command, vector.y) && read_value(command, vector.z);
    }

    bool read_value(const ViewWord& command, double& value) {
        std::optional<double> number;
        if (next_ < words_.size()) number = TextCursor(words_[next_].place).number();
        if (!number) return refuse(command, fmt::format("'{}' needs more numbers behind it", command.text));
        ++next_;
        value = *number;
        return true;
    }

    ViewReader& reader_;
    std::vector<ViewWord> words_;
    std::size_t next_ = 0;
    Light light_;
};

void light(ViewReader& reader) {
    LightLine(reader).read();
}

constexpr std::array light_letters{
    ViewValue{.kind = ViewKind::vector, .help = "where it comes from, infinitely far away", .letter = 'V'},
    ViewValue{.kind = ViewKind::vector, .help = "where it stands", .letter = 'O'},
    ViewValue{
        .kind = ViewKind::colour, .help = "ambient light, for other programs", .standard = "1 1 1", .letter = 'A'},
    ViewValue{.kind = ViewKind::colour,
              .help = "light that surfaces scatter, for other programs",
              .standard = "1 1 1",
              .letter = 'D'},
    ViewValue{.kind = ViewKind::colour,
              .help = "light that surfaces reflect, for other programs",
              .standard = "1 1 1",
              .letter = 'S'},
};

constexpr ViewValue of_window{ViewKind::other, "without meaning outside a window"};
constexpr bool display = true;

constexpr std::array of_display{
    ViewKeyword{"viewpoint:", "three numbers", viewpoint, {ViewKind::vector, "where the eye stands", "0 0 1"}},
    ViewKeyword{"view reference point:",
                "three numbers",
                view_reference_point,
                {ViewKind::vector, "what the eye looks at", "0 0 0"}},
    ViewKeyword{"twist:",
                "a whole number",
                twist,
                {ViewKind::whole, "roll of the eye", "0", "tenths of a degree", -1800, 1800}},
    ViewKeyword{
        "projection:",
        "parallel or perspective",
        projection,
        {.kind = ViewKind::word, .help = "how space is seen", .standard = "parallel", .words = "parallel perspective"}},
    ViewKeyword{"viewing angle:",
                "a number",
                viewing_angle,
                {ViewKind::number, "angle of view of the picture, in perspective", "45", "degrees", 1, 120}},
    ViewKeyword{
        "front distance:", "a number", front_distance, {ViewKind::number, "what is nearer is cut off", "-100000"}},
    ViewKeyword{
        "back distance:", "a number", back_distance, {ViewKind::number, "what is farther away is cut off", "100000"}},
    ViewKeyword{
        "scale factor:", "a number", scale_factor, {ViewKind::number, "enlarges the picture", "1", "", 0.05, 10}},
    ViewKeyword{"box:", "x: two numbers y: two numbers z: two numbers", box, of_window, {}, display},
    ViewKeyword{"light:",
                "sub-commands",
                light,
                {ViewKind::letters, "a light; the first one is the sun of pictures"},
                light_letters},
    ViewKeyword{"light direction:",
                "three numbers",
                light_direction,
                {ViewKind::vector, "direction to the light, where no line gives a light", "1 0 0"}},
    ViewKeyword{"background color:", "three numbers", background_color, {ViewKind::colour, "what is behind the plant"}},
    ViewKeyword{
        "background scene:", "files", background_scene, {ViewKind::file, "objects that stand around the plant"}},
    ViewKeyword{"min zoom:", "a number", skip_number, of_window, {}, display},
    ViewKeyword{"max zoom:", "a number", skip_number, of_window, {}, display},
    ViewKeyword{"generate on view change:", "a word", skip_word, of_window, {}, display},
    ViewKeyword{"z buffer:", "'on' or 'off'", skip_word, of_window, {}, display},
    ViewKeyword{"cue range:", "a whole number", skip_integer, of_window, {}, display},
    ViewKeyword{"antialiasing:", "'on' or 'off'", skip_word, of_window, {}, display},
    ViewKeyword{"concave polygons:", "'on' or 'off'", skip_word, of_window, {}, display},
    ViewKeyword{"interpretation step:", "a whole number", skip_integer, of_window, {}, display},
    ViewKeyword{"render mode:", "a word", render_mode, of_window, {}, display},
    ViewKeyword{"shade mode:", "a whole number", shade_mode, of_window, {}, display},
    ViewKeyword{"shadow map:", "sub-commands", skip_line, of_window, {}, display},
    ViewKeyword{"diffuse reflection:", "a whole number", skip_integer, of_window, {}, display},
    ViewKeyword{"surface ambient:", "a number", skip_number, of_window, {}, display},
    ViewKeyword{"surface diffuse:", "a number", skip_number, of_window, {}, display},
    ViewKeyword{"font:", "a word", skip_word, of_window, {}, display},
    ViewKeyword{"winfont:", "a name and a size", skip_line, of_window, {}, display},
    ViewKeyword{"PS linecap:", "a whole number", skip_integer, of_window, {}, display},
    ViewKeyword{"ambient light:", "three numbers", skip_vector, of_window, {}, display},
    ViewKeyword{"rayshade scale:", "a number", skip_number, of_window, {}, display},
    ViewKeyword{"rayshade objects:", "a format", skip_line, of_window, {}, display},
};

}  // namespace

std::span<const ViewKeyword> display_keywords() {
    return of_display;
}

}  // namespace espalier::turtle
