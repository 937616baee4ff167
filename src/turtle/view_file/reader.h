// Reading a view file: its text as a stream of settings, and what the settings of several places share.
#pragma once

#include "espalier/turtle/view_file.h"
#include "espalier/turtle/view_setting.h"

#include "base/text_cursor.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::turtle {

class ViewReader;

/// One setting of view files.
struct ViewKeyword {
    std::string_view label;   ///< with its colon
    std::string_view values;  ///< what follows it, for messages
    /// Reads the values. Those of a setting without meaning outside a window are read and ignored.
    void (*read)(ViewReader&);
    ViewValue value;
    std::span<const ViewValue> letters = {};  ///< letters that a line of letters takes
    bool display = false;                     ///< without meaning outside a window
};

std::span<const ViewKeyword> turtle_keywords();   ///< how the turtle walks and bends
std::span<const ViewKeyword> shape_keywords();    ///< files of shapes and functions, how things are drawn
std::span<const ViewKeyword> display_keywords();  ///< how the plant is looked at

/// A word of a line that is read as a whole.
struct ViewWord {
    std::string text;
    TextCursor place;
};

class ViewReader {
public:
    ViewReader(std::shared_ptr<const SourceText> text, std::filesystem::path folder);
    View read();

    // What keywords do. Values may be separated by blanks, tabs and commas, and may stand on later lines.

    /// Leaves `value` and complains of too few values if no number follows; so do the next three.
    bool read_number(double& value);
    bool read_integer(int& value);
    bool read_vector(glm::dvec3& value);
    std::optional<std::string> read_word();
    /// Nothing if no such value follows, without complaint.
    std::optional<double> number_if_any();
    std::optional<int> integer_if_any();
    std::optional<std::string> word_on_this_line();
    bool accept(std::string_view literal);
    bool next_is(std::string_view literal) const;
    /// The rest of this line, split.
    std::vector<ViewWord> rest_of_line(std::string_view separators = " \t\r,:");

    void complain(const std::string& message, Diagnostic::Severity severity = Diagnostic::Severity::error);
    void complain(Diagnostic diagnostic);
    void complain(const UserError& error);
    void too_few();
    /// Where the setting at hand begins.
    const TextCursor& setting() const { return setting_; }
    /// The file of this name beside the file that names it, else in the folder; the name alone if it is in neither.
    std::filesystem::path find_file(const std::string& name) const;
    /// The same; throws UserError if it is in neither.
    std::filesystem::path require_file(const std::string& name) const;

    View view;
    Shapes shapes;
    Resources resources;

    /// Read behind everything else: the first of a number wins.
    struct NamedContour {
        int number;
        std::string file;
        TextCursor place;
    };
    std::vector<NamedContour> contours;

private:
    void read_setting();
    void unknown(const std::string& label, const TextCursor& start);
    void read_contours();
    void read_backgrounds();
    void finish_camera();

    TextCursor text_;
    TextCursor setting_;  // where the setting at hand begins
    const ViewKeyword* keyword_ = nullptr;
    std::filesystem::path folder_;
};

}  // namespace espalier::turtle
