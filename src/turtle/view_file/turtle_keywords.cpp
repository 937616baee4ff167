#include "turtle/view_file/reader.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace espalier::turtle {
namespace {

constexpr int colours = 256;
constexpr std::size_t most_tropisms = 10;  // as in cpfg; more are ignored

double radians(double degrees) {
    return degrees * (std::numbers::pi / 180);
}

void angle_factor(ViewReader& reader) {
    double factor = 0;
    if (!reader.read_number(factor)) return;
    if (factor == 0) return reader.complain("'angle factor' must not be 0");
    reader.view.turtle.angle = radians(360 / factor);
}

void angle_increment(ViewReader& reader) {
    double degrees = 0;
    if (reader.read_number(degrees)) reader.view.turtle.angle = radians(degrees);
}

int colour_index(ViewReader& reader, int index) {
    const int within = (index % colours + colours) % colours;
    if (within != index) {
        reader.complain(fmt::format("colour {} is taken as {}: indices go from 0 to 255", index, within),
                        Diagnostic::Severity::warning);
    }
    return within;
}

void initial_color(ViewReader& reader) {
    int front = 0;
    if (!reader.read_integer(front)) return;
    reader.view.turtle.colour = colour_index(reader, front);
    if (const auto back = reader.integer_if_any()) reader.view.turtle.back_colour = colour_index(reader, *back);
}

void color_increment(ViewReader& reader) {
    int front = 0;
    if (!reader.read_integer(front)) return;
    reader.view.turtle.colour_increment = front % colours;
    if (const auto back = reader.integer_if_any()) reader.view.turtle.back_colour_increment = *back % colours;
}

// The style is that of the word behind the width; without a word lines are polygons (cpfg's manual says pixels).
void initial_line_width(ViewReader& reader) {
    TurtleSettings& turtle = reader.view.turtle;
    if (!reader.read_number(*turtle.line_width)) return;
    const std::string style = reader.word_on_this_line().value_or("");
    turtle.line_style = style.starts_with('p')   ? LineStyle::pixel
                        : style.starts_with('s') ? LineStyle::cylinder
                                                 : LineStyle::polygon;
}

void line_width_increment(ViewReader& reader) {
    reader.read_number(reader.view.turtle.line_width_increment);
}

/// A factor that must not be 0, and is 1 then.
void read_factor(ViewReader& reader, double& factor, const char* name) {
    if (!reader.read_number(factor) || factor != 0) return;
    factor = 1;
    reader.complain(fmt::format("'{}' must not be 0; it is 1", name), Diagnostic::Severity::warning);
}

void initial_scale(ViewReader& reader) {
    read_factor(reader, reader.view.turtle.scale, "initial scale");
}

void scale_multiplier(ViewReader& reader) {
    read_factor(reader, reader.view.turtle.scale_multiplier, "scale multiplier");
}

void interpretation_past_cut(ViewReader& reader) {
    if (const auto word = reader.read_word()) reader.view.turtle.past_cut = !word->starts_with("off");
}

// There is no way to switch it off again.
void environment_display(ViewReader& reader) {
    const auto word = reader.read_word();
    if (!word) return;
    if (word->starts_with("before")) {
        reader.view.exchanges_first = true;
    } else if (*word != "off") {
        reader.complain(fmt::format("'environment display: {}' does nothing; the word is 'before'", *word),
                        Diagnostic::Severity::warning);
    }
}

void older_tropism_direction(ViewReader& reader) {
    glm::dvec3 direction = reader.view.turtle.tropism_direction;
    reader.read_vector(direction);
    const double length = glm::length(direction);
    if (length == 0) return reader.complain("'tropism direction' must not be 0, 0, 0");
    reader.view.turtle.tropism_direction = direction / length;
}

void initial_elasticity(ViewReader& reader) {
    reader.read_number(reader.view.turtle.initial_elasticity);
}

void elasticity_increment(ViewReader& reader) {
    reader.read_number(reader.view.turtle.elasticity_increment);
}

/// One line of sub-commands: T x y z, A degrees, I intensity, E elasticity, S step.
class TropismLine {
public:
    TropismLine(ViewReader& reader, bool torque) : reader_(reader), words_(reader.rest_of_line()) {
        tropism_.torque = torque;
    }

    void read() {
        if (reader_.view.turtle.tropisms.size() == most_tropisms) {
            return reader_.complain(
                fmt::format("more than {} tropisms and torques; this one is ignored", most_tropisms),
                Diagnostic::Severity::warning);
        }
        while (next_ < words_.size()) {
            if (!read_command()) return;
        }
        if (!has_vector_) return reader_.complain("a tropism needs its direction: T x y z");
        if (!has_intensity_) tropism_.direction = glm::normalize(tropism_.direction);
        reader_.view.turtle.tropisms.push_back(tropism_);
    }

private:
    // False if the line is ignored.
    bool read_command() {
        const ViewWord& command = words_[next_++];
        switch (command.text[0]) {
            case 'T':
                return read_vector(command);
            case 'A': {
                const bool read = read_value(command, tropism_.angle);
                tropism_.angle = radians(tropism_.angle);
                return read;
            }
            case 'I':
                return read_intensity(command);
            case 'E':
                return read_value(command, tropism_.elasticity);
            case 'S':
                return read_value(command, tropism_.elasticity_step);
            default:
                return refuse(command, fmt::format("'{}' is none of T, A, I, E, S", command.text));
        }
    }

    bool refuse(const ViewWord& word, const std::string& why) {
        reader_.complain(word.place.diagnostic(why + "; the line is ignored"));
        return false;
    }

    bool read_value(const ViewWord& command, double& value) {
        std::optional<double> number;
        if (next_ < words_.size()) number = TextCursor(words_[next_].place).number();
        if (!number) return refuse(command, fmt::format("'{}' needs a number behind it", command.text));
        ++next_;
        value = *number;
        return true;
    }

    bool read_vector(const ViewWord& command) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!read_value(command, tropism_.direction[axis])) return false;
        }
        if (glm::length(tropism_.direction) == 0) return refuse(command, "a tropism's direction must not be 0 0 0");
        has_vector_ = true;
        return true;
    }

    // As cpfg computes it: the length of the vector becomes the smaller of its own and the intensity's.
    bool read_intensity(const ViewWord& command) {
        double intensity = 0;
        if (!read_value(command, intensity)) return false;
        if (intensity == 0) return refuse(command, "the intensity of a tropism must not be 0");
        if (!has_vector_) return refuse(command, "the intensity comes after the direction T x y z");
        tropism_.direction *= std::clamp(intensity / glm::length(tropism_.direction), -1.0, 1.0);
        has_intensity_ = true;
        return true;
    }

    ViewReader& reader_;
    std::vector<ViewWord> words_;
    std::size_t next_ = 0;
    Tropism tropism_;
    bool has_vector_ = false, has_intensity_ = false;
};

void tropism(ViewReader& reader) {
    TropismLine(reader, false).read();
}

void torque(ViewReader& reader) {
    TropismLine(reader, true).read();
}

constexpr std::array tropism_letters{
    ViewValue{.kind = ViewKind::vector, .help = "towards which headings turn", .standard = "0,1,0", .letter = 'T'},
    ViewValue{.kind = ViewKind::number, .help = "intensity: the length of T at most", .standard = "1", .letter = 'I'},
    ViewValue{.kind = ViewKind::number,
              .help = "angle to T at which headings settle",
              .standard = "0",
              .unit = "degrees",
              .lowest = -180,
              .highest = 180,
              .letter = 'A'},
    ViewValue{.kind = ViewKind::number,
              .help = "elasticity at the start",
              .standard = "0",
              .lowest = -1,
              .highest = 1,
              .letter = 'E'},
    ViewValue{.kind = ViewKind::number,
              .help = "step of @Ti and @Td",
              .standard = "0",
              .lowest = -1,
              .highest = 1,
              .letter = 'S'},
};

constexpr std::array of_turtle{
    ViewKeyword{"angle factor:",
                "a number",
                angle_factor,
                {ViewKind::number, "the angle of turns is 360 degrees divided by it", "8", "", 1, 72}},
    ViewKeyword{"angle increment:",
                "a number",
                angle_increment,
                {ViewKind::number, "the angle of turns", "45", "degrees", 0, 180}},
    ViewKeyword{"initial color:",
                "a whole number",
                initial_color,
                {ViewKind::whole, "colour of the turtle at the start", "128", "", 0, 255}},
    ViewKeyword{"color increment:",
                "a whole number",
                color_increment,
                {ViewKind::whole, "by which ; and , change the colour", "1", "", 0, 255}},
    ViewKeyword{"initial line width:",
                "a number",
                initial_line_width,
                {ViewKind::number, "width of lines at the start", "1", "", 0}},
    ViewKeyword{"line width increment:",
                "a number",
                line_width_increment,
                {ViewKind::number, "by which # and ! change the width", "0"}},
    ViewKeyword{"initial scale:",
                "a number",
                initial_scale,
                {ViewKind::number, "scale of lengths at the start", "1", "", 0.01}},
    ViewKeyword{"scale multiplier:",
                "a number",
                scale_multiplier,
                {ViewKind::number, "by which @Di and @Dd change the scale", "1", "", 0.01}},
    ViewKeyword{"interpretation past %:",
                "'on' or 'off'",
                interpretation_past_cut,
                {ViewKind::on_off, "whether what follows a % is drawn", "on"}},
    ViewKeyword{"environment display:",
                "a word",
                environment_display,
                {.kind = ViewKind::word,
                 .help = "whether queries are answered once before the first step",
                 .standard = "off",
                 .words = "off before"}},
    ViewKeyword{
        "tropism:", "sub-commands", tropism, {ViewKind::letters, "a direction to which axes bend"}, tropism_letters},
    ViewKeyword{
        "torque:", "sub-commands", torque, {ViewKind::letters, "a direction to which axes roll"}, tropism_letters},
    ViewKeyword{"tropism direction:",
                "three numbers",
                older_tropism_direction,
                {ViewKind::vector, "direction of the older tropism, which acts after each segment", "0,1,0"}},
    ViewKeyword{"initial elasticity:",
                "a number",
                initial_elasticity,
                {ViewKind::number, "elasticity of the older tropism at the beginning", "0", "", -1, 1}},
    ViewKeyword{"elasticity increment:",
                "a number",
                elasticity_increment,
                {ViewKind::number, "by which _ changes the elasticity", "0", "", -1, 1}},
};

}  // namespace

std::span<const ViewKeyword> turtle_keywords() {
    return of_turtle;
}

}  // namespace espalier::turtle
