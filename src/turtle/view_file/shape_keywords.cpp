#include "base/picture_file.h"
#include "base/text.h"
#include "geometry/side_files/side_files.h"
#include "geometry/surface_id.h"
#include "language/side_files/side_files.h"
#include "turtle/view_file/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace espalier::turtle {
namespace {

namespace fs = std::filesystem;
using Severity = Diagnostic::Severity;

constexpr int most_sides = 1000;
constexpr int most_precision = 10;

/// What `surface`, `line` and `tsurface` have in common: an id, a file and a size.
struct SurfaceLine {
    std::string id, file;
    double size = 1;
};

std::optional<SurfaceLine> read_surface_line(ViewReader& reader) {
    const auto id = reader.read_word();
    if (!id) return std::nullopt;
    const auto file = reader.read_word();
    if (!file) return std::nullopt;
    SurfaceLine line{*id, *file, 1};
    reader.read_number(line.size);
    if (line.size <= 0) line.size = 1;
    if (code_points(line.id).size() != 1) {
        reader.complain(fmt::format("'{}' is no id: the id of a surface is one character", line.id));
        return std::nullopt;
    }
    if (reader.shapes.surfaces.contains(surface_id(line.id))) {
        reader.complain(fmt::format("surface '{}' is there already; this one is ignored", line.id), Severity::warning);
        return std::nullopt;
    }
    return line;
}

int precision(ViewReader& reader, int wanted, int of_file) {
    if (wanted == 0) return of_file;
    const int kept = std::clamp(wanted, 1, most_precision);
    if (kept != wanted) {
        reader.complain(fmt::format("precision {} is taken as {}: it goes from 1 to {}", wanted, kept, most_precision),
                        Severity::warning);
    }
    return kept;
}

// One number behind the size is a texture, two are the precision, three the precision and a texture.
void surface(ViewReader& reader) {
    const auto line = read_surface_line(reader);
    std::vector<int> numbers;
    while (numbers.size() < 3) {
        const auto number = reader.integer_if_any();
        if (!number) break;
        numbers.push_back(*number);
    }
    if (!line) return;
    const fs::path file = reader.require_file(line->file);
    std::optional<Surface> surface = read_surface(file, line->size, reader.view.diagnostics);
    reader.view.files.push_back(file);
    if (!surface) return;
    if (numbers.size() >= 2) {
        surface->precision_s = precision(reader, numbers[0], surface->precision_s);
        surface->precision_t = precision(reader, numbers[1], surface->precision_t);
    }
    if (numbers.size() % 2 == 1 && numbers.back() >= 0) surface->texture = numbers.back();
    reader.shapes.surfaces.emplace(surface_id(line->id), std::move(*surface));
}

// A surface by another name; '~' as its id means lines, and must be the first.
void line_surface(ViewReader& reader) {
    if (reader.next_is("~") && !reader.shapes.surfaces.empty()) {
        reader.rest_of_line();
        return reader.complain("the surface of lines must be the first; it is ignored", Severity::warning);
    }
    surface(reader);
}

void triangle_surface(ViewReader& reader) {
    const auto line = read_surface_line(reader);
    if (!line) return;
    const fs::path file = reader.require_file(line->file);
    std::optional<Surface> surface = file.extension() == ".obj"
                                         ? read_object(file, line->size)
                                         : read_triangles(file, line->size, reader.view.diagnostics);
    reader.view.files.push_back(file);
    if (surface) reader.shapes.surfaces.emplace(surface_id(line->id), std::move(*surface));
}

void contour(ViewReader& reader) {
    int number = 0;
    if (!reader.read_integer(number)) return;
    if (const auto file = reader.read_word()) reader.contours.push_back({number, *file, reader.setting()});
}

/// A function or curve that cannot be read keeps its number, so that those behind it keep theirs.
template <class Read>
void keep_number(ViewReader& reader, const char* what, std::size_t number, const std::string& name, Read read) {
    const fs::path file = reader.find_file(name);
    try {
        read(file);
        reader.view.files.push_back(file);
    } catch (const UserError& error) {
        reader.complain(fmt::format("{} {} is 0 everywhere, because its file '{}' cannot be read", what, number, name),
                        Severity::warning);
        for (Diagnostic diagnostic : error.diagnostics()) {
            diagnostic.severity = Severity::warning;
            reader.complain(std::move(diagnostic));
        }
    }
}

void function(ViewReader& reader) {
    const auto name = reader.read_word();
    if (!name) return;
    const int samples = reader.integer_if_any().value_or(0);
    std::vector<FunctionCurve>& functions = reader.resources.functions;
    functions.emplace_back();
    keep_number(reader, "function", functions.size(), *name,
                [&](const fs::path& file) { functions.back() = read_function_file(file, samples); });
}

bool is_identifier(const std::string& name) {
    const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '$'; };
    return !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) &&
           std::all_of(name.begin(), name.end(), fits);
}

void add_member(ViewReader& reader, NamedFunction member, const std::string& file) {
    std::vector<FunctionCurve>& functions = reader.resources.functions;
    functions.push_back(std::move(member.function));
    const std::string number = std::to_string(functions.size());
    if (is_identifier(member.name)) {
        reader.view.function_names[member.name] = number;
        return;
    }
    reader.complain(fmt::format("function {} of '{}' has no name that models can use: '{}'", number, file, member.name),
                    Severity::warning);
}

// Restarts the numbers. The names are defined in the model.
void function_set(ViewReader& reader) {
    const auto name = reader.read_word();
    if (!name) return;
    const fs::path file = reader.require_file(*name);
    reader.resources.functions.clear();
    reader.view.function_names.clear();
    reader.view.files.push_back(file);
    try {
        for (NamedFunction& member : read_function_set(file)) add_member(reader, std::move(member), *name);
    } catch (const UserError& error) {
        reader.complain(error);  // there are no functions then
    }
}

void curve(ViewReader& reader) {
    const auto name = reader.read_word();
    if (!name) return;
    const int samples = reader.integer_if_any().value_or(100);
    std::vector<SpaceCurve>& curves = reader.resources.curves;
    const fs::path file = reader.require_file(*name);
    curves.push_back(read_curve_file(file, samples));
    reader.view.files.push_back(file);
}

void blob(ViewReader& reader) {
    const std::vector<ViewWord> words = reader.rest_of_line();
    reader.complain(fmt::format("blob fields{} are not read, and inblob() is not available",
                                words.empty() ? "" : " such as '" + words[0].text + "'"));
}

void contour_sides(ViewReader& reader) {
    int sides = 0;
    if (!reader.read_integer(sides)) return;
    const int kept = sides <= 2 ? 3 : std::min(sides, most_sides);
    if (kept != sides) {
        reader.complain(fmt::format("{} contour sides are taken as {}: from 3 to {}", sides, kept, most_sides),
                        Severity::warning);
    }
    reader.view.turtle.contour_sides = kept;
}

// The older form of contour sides: 2, 4, 8, ... of them.
void polygonization_level(ViewReader& reader) {
    constexpr int most_level = 8;
    int level = 0;
    if (!reader.read_integer(level)) return;
    reader.view.turtle.contour_sides = std::max(3, 1 << (std::clamp(level, 0, most_level) + 1));
}

void line_style(ViewReader& reader) {
    const auto word = reader.read_word();
    if (!word) return;
    constexpr std::array<std::string_view, 3> names{"pixel", "polygon", "cylinder"};
    std::size_t style = std::size_t(std::find(names.begin(), names.end(), *word) - names.begin());
    if (std::isdigit(static_cast<unsigned char>((*word)[0]))) style = std::size_t((*word)[0] - '0') - 1;
    if (style >= names.size()) {
        return reader.complain(fmt::format("'{}' is no line style (pixel, polygon, cylinder)", *word),
                               Severity::warning);
    }
    reader.view.turtle.line_style = LineStyle(style);
}

void tapered_lines(ViewReader& reader) {
    if (const auto word = reader.read_word()) reader.view.turtle.tapered_lines = *word == "on";
}

void twist_of_cylinders(ViewReader& reader) {
    if (const auto word = reader.read_word()) reader.view.turtle.twist_of_cylinders = word->starts_with("on");
}

bool is_one_of(const std::string& word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// One line of sub-commands: F file, L and H filters, E environment mode, S one picture a surface, R ratio.
class TextureLine {
public:
    explicit TextureLine(ViewReader& reader) : reader_(reader), words_(reader.rest_of_line(" \t\r,:")) {}

    // A texture that cannot be understood keeps its number, so that those behind it keep theirs.
    void read() {
        bool sound = true;
        while (sound && next_ < words_.size()) sound = read_command();
        if (sound && texture_.file.empty()) reader_.complain("a texture needs its file: F name");
        reader_.shapes.textures.push_back(texture_);
    }

private:
    bool refuse(const std::string& why) {
        reader_.complain(fmt::format("{}; texture {} is read up to here", why, reader_.shapes.textures.size() + 1));
        return false;
    }

    bool read_command() {
        const std::string command = words_[next_++].text;
        if (command[0] == 'S') return texture_.per_surface = true;
        if (std::string_view("FLHER").find(command[0]) == std::string_view::npos) {
            return refuse(fmt::format("'{}' is none of F, L, H, E, S, R", command));
        }
        if (next_ == words_.size()) return refuse(fmt::format("'{}' needs something behind it", command));
        const ViewWord& value = words_[next_++];
        switch (command[0]) {
            case 'F':
                return read_file(value.text);
            case 'L':
                texture_.minification = value.text;
                return is_one_of(value.text, {"n", "l", "m", "mnn", "mln", "mnl", "mll"}) ||
                       refuse(fmt::format("'{}' is no filter (n, l, m, mnn, mln, mnl, mll)", value.text));
            case 'H':
                texture_.magnification = value.text;
                return is_one_of(value.text, {"n", "l"}) || refuse(fmt::format("'{}' is no filter (n, l)", value.text));
            case 'E':
                texture_.mode = value.text.substr(0, 1);
                return is_one_of(texture_.mode, {"m", "d", "b"}) ||
                       refuse(fmt::format("'{}' is no mode (modulate, decal, blend)", value.text));
            default:
                return read_ratio(value);
        }
    }

    // Pictures are passed on, not drawn, so one that is missing does not stop anything.
    bool read_file(const std::string& name) {
        texture_.file = reader_.find_file(name);
        const std::size_t number = reader_.shapes.textures.size() + 1;
        std::error_code ignored;
        if (!fs::is_regular_file(texture_.file, ignored)) {
            reader_.complain(fmt::format("there is no picture '{}' for texture {}", name, number), Severity::warning);
        } else if (texture_.file.extension() != ".bark") {
            const std::string why = reason_not_to_show(texture_.file);
            if (why.empty()) return true;
            reader_.complain(fmt::format("the picture '{}' of texture {} will not be shown: {}", name, number, why),
                             Severity::warning);
        }
        return true;
    }

    bool read_ratio(const ViewWord& value) {
        const auto ratio = TextCursor(value.place).number();
        if (!ratio || *ratio == 0) return refuse(fmt::format("'{}' is no ratio", value.text));
        texture_.ratio = *ratio;
        return true;
    }

    ViewReader& reader_;
    std::vector<ViewWord> words_;
    std::size_t next_ = 0;
    Texture texture_;
};

void texture(ViewReader& reader) {
    TextureLine(reader).read();
}

constexpr std::array texture_letters{
    ViewValue{.kind = ViewKind::file, .help = "a picture, or settings of bark", .letter = 'F'},
    ViewValue{.kind = ViewKind::word,
              .help = "how a picture is made smaller",
              .standard = "n",
              .words = "n l m mnn mln mnl mll",
              .letter = 'L'},
    ViewValue{
        .kind = ViewKind::word, .help = "how a picture is made larger", .standard = "n", .words = "n l", .letter = 'H'},
    ViewValue{
        .kind = ViewKind::word, .help = "modulate, decal or blend", .standard = "m", .words = "m d b", .letter = 'E'},
    ViewValue{.kind = ViewKind::flag, .help = "one picture over a whole surface instead of one a patch", .letter = 'S'},
    ViewValue{.kind = ViewKind::number,
              .help = "stretches the picture along cylinders",
              .standard = "1",
              .lowest = 0.01,
              .letter = 'R'},
};

constexpr std::array of_shapes{
    ViewKeyword{"surface:", "an id, a file and a size", surface, {ViewKind::other, "a surface that ~ draws"}},
    ViewKeyword{"line:", "an id, a file and a size", line_surface, {ViewKind::other, "the same, as an older name"}},
    ViewKeyword{"tsurface:",
                "an id, a file and a size",
                triangle_surface,
                {ViewKind::other, "a surface of triangles that ~ draws"}},
    ViewKeyword{"contour:", "a number and a file", contour, {ViewKind::other, "a cross-section that @# chooses"}},
    ViewKeyword{"function:", "a file", function, {ViewKind::file, "the next function of func()"}},
    ViewKeyword{"function set:", "a file", function_set, {ViewKind::file, "all functions of func(), with names"}},
    ViewKeyword{"curve:", "a file", curve, {ViewKind::file, "the next curve of curveX() and its like"}},
    ViewKeyword{"blob:", "a file", blob, {ViewKind::file, "not read"}},
    ViewKeyword{"texture:",
                "sub-commands",
                texture,
                {ViewKind::letters, "a picture that @Tx puts on what is drawn"},
                texture_letters},
    ViewKeyword{"line style:",
                "pixel, polygon or cylinder",
                line_style,
                {.kind = ViewKind::word,
                 .help = "how lines are drawn",
                 .standard = "pixel",
                 .words = "pixel polygon cylinder"}},
    ViewKeyword{"contour sides:",
                "a whole number",
                contour_sides,
                {ViewKind::whole, "around cylinders and spheres", "8", "", 3, most_sides}},
    ViewKeyword{"polygonization level:",
                "a whole number",
                polygonization_level,
                {ViewKind::whole, "an older way to say the sides", "", "", 0, 8}},
    ViewKeyword{"tapered lines:",
                "'on' or 'off'",
                tapered_lines,
                {ViewKind::on_off, "whether a segment goes over into the width of the next", "on"}},
    ViewKeyword{"twist of cylinders:",
                "'on' or 'off'",
                twist_of_cylinders,
                {ViewKind::on_off, "whether generalized cylinders follow the roll of the turtle", "off"}},
};

}  // namespace

std::span<const ViewKeyword> shape_keywords() {
    return of_shapes;
}

}  // namespace espalier::turtle
