#include "language/dgf/grid.h"

#include "base/number.h"
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>

namespace espalier::language::dgf {
namespace {

constexpr std::string_view blanks = " \t\r";
constexpr double largest_number = 1e12;

/// Columns behind the two vertices of a segment; without names they stand in this order.
struct ColumnRow {
    std::array<std::string_view, 4> words;  ///< in small letters, without - and _
    double Segment::*member;                ///< null: known, and not used
};

constexpr std::array column_rows{
    ColumnRow{{"order"}, &Segment::order},
    ColumnRow{{"branch", "brid", "branchid", "branchnumber"}, &Segment::branch},
    ColumnRow{{"surface", "surf", "area"}, &Segment::surface},
    ColumnRow{{"length", "len"}, &Segment::length},
    ColumnRow{{"radius", "rad", "r"}, &Segment::radius},
    ColumnRow{{"kz", "axialconductance"}, nullptr},
    ColumnRow{{"kr", "radialconductance"}, nullptr},
    ColumnRow{{"emergence", "emergencetime", "creationtime", "age"}, &Segment::birth},
    ColumnRow{{"subtype", "type"}, nullptr},
    ColumnRow{{"organtype", "organ"}, &Segment::organ},
};

std::string small_word(std::string_view text) {
    std::string word;
    for (const char c : text) {
        if (c != '-' && c != '_' && c != ' ') word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return word;
}

/// A column as its file names it: "radius[cm]", "emergence time [d]".
struct ColumnName {
    std::string name, unit;
};

ColumnName column_name(std::string_view text) {
    const std::size_t begin = text.find_first_of("[("), end = text.find_first_of("])");
    const std::vector<std::string> words = words_of(text.substr(0, begin), blanks);
    ColumnName column;
    for (const std::string& word : words) column.name += (column.name.empty() ? "" : " ") + word;
    if (begin < end && end != std::string_view::npos) column.unit = text.substr(begin + 1, end - begin - 1);
    return column;
}

/// Names are separated by commas, or else by blanks outside brackets.
std::vector<ColumnName> column_names(std::string_view text) {
    const bool has_commas = text.find(',') != std::string_view::npos;
    std::vector<ColumnName> names;
    std::string word;
    int depth = 0;
    const auto finish = [&] {
        if (words_of(word, blanks).empty()) return;
        // A unit that stands apart belongs to the name before it.
        if (!has_commas && word[0] == '[' && !names.empty())
            names.back().unit = column_name(word).unit;
        else
            names.push_back(column_name(word));
        word.clear();
    };
    for (const char c : text) {
        depth += c == '[' || c == '(' ? 1 : c == ']' || c == ')' ? -1 : 0;
        const bool separates = has_commas ? c == ',' : blanks.find(c) != std::string_view::npos;
        if (separates && depth <= 0) {
            finish();
        } else {
            word += c;
        }
    }
    finish();
    return names;
}

class Reader {
public:
    Reader(const std::string& name, measured::Notes& notes) : name_(name), notes_(notes) {}

    Grid read(const std::string& text) {
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            ++line_;
            read_line(std::string_view(text).substr(begin, end - begin));
            begin = end + 1;
        }
        if (line_ == 0 || !is_dgf_) fail("this is no file of Dune's grid format: its first word is not DGF");
        if (grid_.vertices.empty()) fail("this file has no block Vertex with vertices");
        if (grid_.segments.empty()) fail("this file has no block Simplex with segments");
        return std::move(grid_);
    }

private:
    enum class Block { none, vertices, segments, unused };

    [[noreturn]] void fail(const std::string& message, std::size_t column = 0) const {
        throw UserError(Place{name_, std::max(line_, 1), static_cast<int>(column) + 1}, message);
    }

    void read_line(std::string_view line) {
        const std::size_t first = line.find_first_not_of(blanks);
        if (first == std::string_view::npos || line[first] == '%') return;
        if (line[first] == '#') return end_block();
        if (!is_dgf_) {
            if (small_word(words_of(line, blanks)[0]) != "dgf") {
                fail("this is no file of Dune's grid format: its first word is not DGF");
            }
            is_dgf_ = true;
            return;
        }
        if (std::isalpha(static_cast<unsigned char>(line[first])) != 0) return read_keyword(line);
        if (block_ == Block::vertices) return read_vertex(line);
        if (block_ == Block::segments) return read_segment(line);
        if (block_ == Block::none) fail("numbers stand in a block: Vertex or Simplex", first);
    }

    void end_block() { block_ = Block::none; }

    void read_keyword(std::string_view line) {
        const std::vector<std::string> words = words_of(line, blanks);
        const std::string word = small_word(words[0].substr(0, words[0].find(':')));
        if (block_ == Block::vertices || block_ == Block::segments) {
            if (word == "parameters") return read_parameters(line);
            if (word == "firstindex") return read_first_index(words);
        }
        if (block_ == Block::unused) return;
        if (word == "vertex") {
            block_ = Block::vertices;
        } else if (word == "simplex") {
            block_ = Block::segments;
            parameters_ = 0;
            columns_.clear();
        } else {
            block_ = Block::unused;
            notes_.unused("block " + escaped(words[0]), {name_, line_, 1});
        }
    }

    void read_first_index(const std::vector<std::string>& words) {
        first_index_ = words.size() == 2 ? finite_number(words[1]).value_or(0) : 0;
    }

    void read_parameters(std::string_view line) {
        const std::vector<std::string> words = words_of(line, " \t\r:#,");
        const std::optional<double> count = words.size() > 1 ? finite_number(words[1]) : std::nullopt;
        if (!count || *count < 0 || *count > 1e7 || *count != std::floor(*count)) {
            fail("'parameters' is followed by their number");
        }
        if (block_ == Block::vertices) {
            if (*count > 0) notes_.unused("parameters of vertices", {name_, line_, 1});
            return;
        }
        parameters_ = static_cast<std::size_t>(*count);
        const std::size_t behind = line.find(words[1], line.find_first_of(blanks)) + words[1].size();
        std::string_view names = line.substr(behind);
        names.remove_prefix(std::min(names.find_first_not_of(" \t\r:#"), names.size()));
        name_columns(column_names(names));
    }

    void name_columns(std::vector<ColumnName> names) {
        columns_.assign(parameters_, nullptr);
        // Names may stand for the two vertices, too.
        if (names.size() == parameters_ + 2) names.erase(names.begin(), names.begin() + 2);
        if (names.size() != parameters_) {
            if (parameters_ > 0) {
                notes_.warn(fmt::format("{} columns have {} names: they are taken as order, branch, surface, length, "
                                        "radius, kz, kr, emergence, subtype, organ type",
                                        parameters_, names.size()),
                            {name_, line_, 1});
            }
            names.clear();
            for (const ColumnRow& row : column_rows) names.push_back({std::string(row.words[0]), ""});
        }
        for (std::size_t i = 0; i < std::min(parameters_, names.size()); ++i) name_column(i, names[i]);
    }

    void name_column(std::size_t at, const ColumnName& column) {
        const std::string word = small_word(column.name);
        for (const ColumnRow& row : column_rows) {
            if (std::find(row.words.begin(), row.words.end(), word) == row.words.end()) continue;
            columns_[at] = row.member;
            if (row.member == &Segment::radius) grid_.radius_unit = column.unit;
            if (row.member == &Segment::surface) grid_.surface_unit = column.unit;
            if (row.member == &Segment::birth) grid_.birth_unit = column.unit;
        }
        if (!columns_[at]) notes_.unused("column '" + escaped(column.name) + "'", {name_, line_, 1});
    }

    // -- rows

    /// The next number of a row, and what stands behind it.
    double number(std::string_view line, std::size_t& at, const char* what) const {
        at = std::min(line.find_first_not_of(blanks, at), line.size());
        const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
        const std::optional<double> value = finite_number(line.substr(at, end - at));
        if (!value || std::abs(*value) > largest_number) fail(fmt::format("{} stands here", what), at);
        at = end;
        return *value;
    }

    void read_vertex(std::string_view line) {
        glm::dvec3 vertex(0);
        std::size_t at = 0;
        for (int axis = 0; axis < 3; ++axis) vertex[axis] = number(line, at, "a number, one of three coordinates,");
        grid_.vertices.push_back(vertex);
    }

    void read_segment(std::string_view line) {
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        Segment segment{0, 0, unknown, unknown, unknown, unknown, unknown, unknown, unknown, line_};
        std::size_t at = 0;
        segment.from = vertex(line, at);
        segment.to = vertex(line, at);
        for (std::size_t i = 0; i < parameters_; ++i) {
            const double value = number(line, at, "a number, one for each of the parameters,");
            if (columns_[i]) segment.*columns_[i] = value;
        }
        if (line.find_first_not_of(blanks, at) != std::string_view::npos) {
            fail(fmt::format("a segment has two vertices and {} parameters: this row is longer", parameters_), at);
        }
        grid_.segments.push_back(segment);
    }

    std::size_t vertex(std::string_view line, std::size_t& at) const {
        const double index = number(line, at, "the number of a vertex") - first_index_;
        if (index != std::floor(index) || index < 0 || index >= static_cast<double>(grid_.vertices.size())) {
            fail(fmt::format("there is no vertex {}: there are {}, from {}", index + first_index_,
                             grid_.vertices.size(), first_index_),
                 at);
        }
        return static_cast<std::size_t>(index);
    }

    std::string name_;
    measured::Notes& notes_;
    Grid grid_;
    Block block_ = Block::none;
    std::vector<double Segment::*> columns_;
    std::size_t parameters_ = 0;
    double first_index_ = 0;
    int line_ = 0;
    bool is_dgf_ = false;
};

}  // namespace

Grid read_grid(const std::string& text, const std::string& name, measured::Notes& notes) {
    return Reader(name, notes).read(text);
}

}  // namespace espalier::language::dgf
