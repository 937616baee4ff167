#include "turtle/view_file/reader.h"

#include "espalier/base/file.h"

#include "base/text.h"
#include "geometry/side_files/side_files.h"
#include "language/preprocessor/preprocessed_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

namespace espalier::turtle {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view separators = " \t\r\n\v\f,";
constexpr std::string_view separators_of_line = " \t\r,";
constexpr std::size_t most_diagnostics = 200;

// Settings of other programs, found in view files that cpfg reads; it passes over them.
constexpr std::array foreign_labels{"scale:",      "corrected rotation:",
                                    "stropism:",   "window:",
                                    "view:",       "window border:",
                                    "terrain:",    "correct rotation:",
                                    "background:", "origin:",
                                    "value:",      "message:",
                                    "size:",       "name:",
                                    "colors:",     "type:",
                                    "panel name:", "target:"};

const std::unordered_map<std::string_view, const ViewKeyword*>& known_keywords() {
    static const auto table = [] {
        std::unordered_map<std::string_view, const ViewKeyword*> by_label;
        for (const auto& group : {turtle_keywords(), shape_keywords(), display_keywords()}) {
            for (const ViewKeyword& keyword : group) by_label.emplace(keyword.label, &keyword);
        }
        return by_label;
    }();
    return table;
}

std::string without_colon(std::string_view label) {
    if (label.ends_with(':')) label.remove_suffix(1);
    return std::string(label);
}

}  // namespace

ViewReader::ViewReader(std::shared_ptr<const SourceText> text, fs::path folder)
    : text_(std::move(text)), setting_(text_), folder_(std::move(folder)) {
    // Until the file says otherwise.
    view.turtle.line_style = LineStyle::pixel;
    view.turtle.line_width = 1;
}

View ViewReader::read() {
    for (;;) {
        text_.skip(" \r\n");
        // A line of blanks and tabs is empty too, but a tab before a label belongs to it.
        TextCursor ahead = text_;
        ahead.skip(" \t\r\n");
        if (ahead.at_end()) break;
        TextCursor line = text_;
        line = line.line();
        line.skip(TextCursor::blanks);
        if (line.at_end()) {
            text_.line();
        } else {
            read_setting();
        }
    }
    read_contours();
    read_backgrounds();
    finish_camera();
    resources.z_min = view.camera.front;
    resources.z_max = view.camera.back;
    resources.view_scale = view.camera.scale;
    view.resources = std::make_shared<const Resources>(std::move(resources));
    view.turtle.shapes = std::make_shared<const Shapes>(std::move(shapes));
    return std::move(view);
}

// A label goes up to its colon, or to the end of the line; what a setting leaves on its line is taken for the next.
void ViewReader::read_setting() {
    setting_ = text_;
    std::string label(text_.word(":#\n"));
    if (text_.next() == ':' || text_.next() == '#') {
        label += text_.next();
        text_.accept(label.substr(label.size() - 1));
    }
    const auto found = known_keywords().find(label);
    if (found == known_keywords().end()) return unknown(label, setting_);
    keyword_ = found->second;
    if (keyword_->display) {
        const std::string name = without_colon(label);
        if (std::find(view.unused.begin(), view.unused.end(), name) == view.unused.end()) view.unused.push_back(name);
    }
    keyword_->read(*this);
    // A comma or tab at the end of a line is no setting.
    TextCursor ahead = text_;
    ahead.skip(separators_of_line);
    if (ahead.at_end() || ahead.next() == '\n') text_ = ahead;
}

void ViewReader::unknown(const std::string& label, const TextCursor& start) {
    text_.line();
    if (std::find(foreign_labels.begin(), foreign_labels.end(), label) != foreign_labels.end()) return;
    std::vector<std::string> known;
    for (const auto& entry : known_keywords()) known.push_back(without_colon(entry.first));
    std::sort(known.begin(), known.end());
    std::string name = without_colon(label);
    while (name.ends_with('\r') || name.ends_with(' ')) name.pop_back();
    const std::size_t first = name.find_first_not_of("\t ");
    if (first == std::string::npos) return complain(start.diagnostic("there is no setting before this sign"));
    if (name.starts_with('\t')) {
        return complain(
            start.diagnostic(fmt::format("'{}' is not read because of the tab before it", name.substr(first))));
    }
    if (label.ends_with(" :") && std::find(known.begin(), known.end(), name) != known.end()) {
        return complain(start.diagnostic(fmt::format("'{}' is not read because blanks stand before its colon", name)));
    }
    complain(start.diagnostic(label.ends_with(':')
                                  ? fmt::format("view files have no setting '{}'{}", name, did_you_mean(name, known))
                                  : fmt::format("'{}' is no setting: its name ends with a colon", name)));
}

void ViewReader::read_contours() {
    for (const NamedContour& contour : contours) {
        setting_ = contour.place;
        if (contour.number == 0 || shapes.contours.contains(contour.number)) {
            complain(fmt::format("contour {} is {} already; this one is ignored", contour.number,
                                 contour.number == 0 ? "the circle" : "there"),
                     Diagnostic::Severity::warning);
            continue;
        }
        const fs::path file = require_file(contour.file);
        try {
            const std::optional<Contour> shape = read_contour(file, view.diagnostics);
            view.files.push_back(file);
            if (shape) shapes.contours.emplace(contour.number, *shape);
        } catch (const UserError& error) {
            complain(error);  // the circle is drawn
        }
    }
}

void ViewReader::read_backgrounds() {
    if (view.backgrounds.empty()) return;
    Background scene;
    for (const fs::path& file : view.backgrounds) {
        read_background(file, Material{}, scene, view.diagnostics);
        view.files.push_back(file);
    }
    view.background = std::make_shared<const Background>(std::move(scene));
}

// cpfg looks from somewhere else where its author would have seen nothing.
void ViewReader::finish_camera() {
    Camera& camera = view.camera;
    if (camera.eye == camera.target) {
        camera.eye = {0, 0, -1};
        camera.target = {0, 0, 0};
    }
    if (!camera.perspective) return;
    if (camera.front < 0) camera.front = 0.1;
    if (camera.front > camera.back) {
        camera.front = 1;
        camera.back = 100;
    }
}

bool ViewReader::read_number(double& value) {
    const std::optional<double> number = number_if_any();
    if (number) value = *number;
    if (!number) too_few();
    return number.has_value();
}

bool ViewReader::read_integer(int& value) {
    const std::optional<int> number = integer_if_any();
    if (number) value = *number;
    if (!number) too_few();
    return number.has_value();
}

bool ViewReader::read_vector(glm::dvec3& value) {
    return read_number(value.x) && read_number(value.y) && read_number(value.z);
}

std::optional<std::string> ViewReader::read_word() {
    TextCursor ahead = text_;
    ahead.skip(separators);
    std::string word(ahead.word(separators));
    if (word.empty()) {
        too_few();
        return std::nullopt;
    }
    text_ = ahead;
    return word;
}

std::optional<double> ViewReader::number_if_any() {
    TextCursor ahead = text_;
    ahead.skip(separators);
    const std::optional<double> number = ahead.number();
    if (number) text_ = ahead;
    return number;
}

std::optional<int> ViewReader::integer_if_any() {
    TextCursor ahead = text_;
    ahead.skip(separators);
    const std::optional<int> number = ahead.integer();
    if (number) text_ = ahead;
    return number;
}

std::optional<std::string> ViewReader::word_on_this_line() {
    TextCursor ahead = text_;
    ahead.skip(separators_of_line);
    std::string word(ahead.word(separators));
    if (word.empty()) return std::nullopt;
    text_ = ahead;
    return word;
}

bool ViewReader::accept(std::string_view literal) {
    if (!next_is(literal)) return false;
    text_.skip(separators);
    return text_.accept(literal);
}

bool ViewReader::next_is(std::string_view literal) const {
    TextCursor ahead = text_;
    ahead.skip(separators);
    return ahead.accept(literal);
}

std::vector<ViewWord> ViewReader::rest_of_line(std::string_view between) {
    TextCursor line = text_.line();
    std::vector<ViewWord> words;
    for (line.skip(between); !line.at_end(); line.skip(between)) {
        const TextCursor place = line;
        words.push_back({std::string(line.word(between)), place});
    }
    return words;
}

void ViewReader::complain(const std::string& message, Diagnostic::Severity severity) {
    complain(setting_.diagnostic(message, severity));
}

void ViewReader::complain(Diagnostic diagnostic) {
    if (view.diagnostics.size() < most_diagnostics) view.diagnostics.push_back(std::move(diagnostic));
}

void ViewReader::complain(const UserError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) complain(diagnostic);
}

// As in cpfg the rest of the line is dropped, and the values that did fit are kept.
void ViewReader::too_few() {
    complain(fmt::format("'{}' needs {}", without_colon(keyword_->label), keyword_->values));
    text_.line();
}

fs::path ViewReader::find_file(const std::string& name) const {
    const fs::path beside = fs::path(setting_.place().file).parent_path();
    std::error_code ignored;
    for (const fs::path& where : {beside, folder_}) {
        if (fs::is_regular_file(where / name, ignored)) return where / name;
    }
    return name;
}

fs::path ViewReader::require_file(const std::string& name) const {
    fs::path path = find_file(name);
    std::error_code ignored;
    if (fs::is_regular_file(path, ignored)) return path;
    const fs::path beside = fs::path(setting_.place().file).parent_path();
    setting_.fail(fmt::format("there is no file '{}' {}{}", name, beside.empty() ? "here" : "in " + beside.string(),
                              folder_.empty() || folder_ == beside ? "" : " or in " + folder_.string()));
}

View read_view_text(std::string_view text, const std::string& name, const Defines& defines, const fs::path& folder) {
    std::vector<Diagnostic> warnings;
    ReadOptions options;
    options.defines = defines;
    options.warnings = &warnings;
    const auto preprocessed = preprocess_text(text, name, fs::path(name).parent_path(), options);
    View view = ViewReader(preprocessed, folder).read();
    view.diagnostics.insert(view.diagnostics.begin(), warnings.begin(), warnings.end());
    return view;
}

View read_view_file(const fs::path& path, const Defines& defines, const fs::path& folder) {
    return read_view_text(read_text(path), path.string(), defines, folder);
}

std::vector<ViewSetting> view_settings() {
    std::vector<ViewSetting> settings;
    const auto add = [&](std::span<const ViewKeyword> keywords_of_group, std::string_view group) {
        for (const ViewKeyword& keyword : keywords_of_group) {
            settings.push_back(
                {keyword.label, keyword.values, keyword.display ? "window" : group, keyword.value, keyword.letters});
        }
    };
    add(turtle_keywords(), "growth");
    add(shape_keywords(), "shape");
    add(display_keywords(), "picture");
    return settings;
}

}  // namespace espalier::turtle
