#include "language/mtg/graph.h"

#include "base/number.h"
#include "base/text.h"
#include "language/measured/cells.h"
#include "language/measured/notes.h"
#include "language/measured/units.h"
#include "language/mtg/columns.h"
#include "language/mtg/entity_code.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <deque>
#include <optional>
#include <unordered_map>

namespace espalier::language::mtg {
namespace {

constexpr std::size_t most_entities = 20'000'000;

/// "mtg" for "MTG :"; "" if the line begins no section.
std::string section_of(std::string_view line) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) return "";
    const std::vector<std::string> words = words_of(line.substr(0, colon), " \t");
    if (words.size() != 1) return "";
    const std::string name = in_small_letters(words[0]);
    for (const char* const section : {"code", "classes", "description", "features", "mtg"}) {
        if (name == section) return name;
    }
    return "";
}

/// An entity as a code passes it: what it is attached to, how and by which name.
struct Passage {
    std::uint32_t from;
    char relation;
    std::string_view label;

    bool operator==(const Passage&) const = default;
};

struct PassageHash {
    std::size_t operator()(const Passage& passage) const {
        return std::hash<std::string_view>()(passage.label) ^
               (passage.from * 2654435761u + static_cast<std::size_t>(passage.relation));
    }
};

class Reader {
public:
    Reader(const std::string& name, measured::Notes& notes) : name_(name), notes_(notes) {}

    Graph read(std::string_view text) {
        for (std::size_t begin = 0; begin < text.size();) {
            ++line_;
            read_line(measured::next_line(text, begin));
        }
        if (section_ != "mtg") fail(1, "this file has no section MTG:");
        if (graph_.vertices.empty()) fail(1, "this file has no entities below MTG:");
        columns_.tell_unused(notes_);
        if (later_rows_ > 0) {
            notes_.warn(
                "of an entity that is measured several times the last measures are drawn, from its first date "
                "on; rows that begin with *",
                later_, later_rows_);
        }
        graph_.diameter_unit = columns_.unit_of(top);
        if (graph_.diameter_unit.empty()) graph_.diameter_unit = columns_.unit_of(bottom);
        if (graph_.unit.empty()) graph_.unit = columns_.unit_of(x);
        graph_.columns = columns_.names();
        graph_.has_times = columns_.has_days();
        if (columns_.has_dates()) graph_.rows.count_from_first_day();
        gather_labels();
        return std::move(graph_);
    }

private:
    /// The graph needs the text no more.
    void gather_labels() {
        std::size_t length = 0;
        for (const Vertex& vertex : graph_.vertices) length += vertex.label.size();
        graph_.labels.reserve(length);
        for (Vertex& vertex : graph_.vertices) {
            const std::string_view label = vertex.label;
            graph_.labels.insert(graph_.labels.end(), label.begin(), label.end());
            vertex.label = {graph_.labels.data() + graph_.labels.size() - label.size(), label.size()};
        }
    }

    [[noreturn]] void fail(std::size_t column, const std::string& message) const {
        throw UserError(place(column), message);
    }

    Place place(std::size_t column) const {
        return {name_, std::max(line_, 1), static_cast<int>(std::min<std::size_t>(column, 1'000'000))};
    }

    void read_line(std::string_view line) {
        note(line);
        line = line.substr(0, line.find('#'));
        measured::split_cells(line, '\t', cells_);
        if (std::all_of(cells_.begin(), cells_.end(), [](std::string_view cell) { return cell.empty(); })) return;
        if (section_ == "mtg" && !is_header_) return read_row();
        if (const std::string section = section_of(line); !section.empty()) {
            section_ = section;
            is_header_ = true;
        } else if (section_ == "classes") {
            read_class(words_of(line, " \t\r"));
        } else if (section_ == "features") {
            columns_.declare(words_of(line, " \t\r"));
        } else if (section_ == "mtg") {
            read_header();
        }
    }

    /// Comments may tell what an MTG has no place for.
    void note(std::string_view line) {
        if (!line.starts_with('#')) return;
        const std::vector<std::string> words = words_of(line, " \t\r");
        if (words.size() == 4 && words[1] == "unit") {
            measured::metres_of_unit(words[3]);
            columns_.declare({words[2].substr(0, words[2].find(':')), "", words[3]});
        }
        if (words.size() == 5 && words[1] == "origin:") {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                graph_.origin[axis] = finite_number(words[axis + 2]).value_or(0);
            }
        }
        if (words.size() != 3) return;
        if (words[1] == "unit:") graph_.unit = words[2];
        if (words[1] == "up:") graph_.up = words[2];
    }

    void read_class(const std::vector<std::string>& words) {
        const std::optional<double> scale = words.size() > 1 ? finite_number(words[1]) : std::nullopt;
        if (scale && words[0] != "$") scales_[words[0]] = static_cast<int>(std::clamp(*scale, 0.0, 1000.0));
    }

    void read_header() {
        is_header_ = false;
        const std::string first = in_small_letters(cells_[0]);
        if (first != "entity-code" && first != "topo") fail(1, "the line below MTG: begins with ENTITY-CODE");
        std::size_t begin = 1;
        while (begin < cells_.size() && cells_[begin].empty()) ++begin;
        has_features_ = begin < cells_.size();
        entity_columns_ = has_features_ ? begin : static_cast<std::size_t>(-1);
        columns_.head(cells_, begin);
        graph_.rows.keep(columns_.measures_read());
    }

    void read_row() {
        const std::size_t codes = std::min(entity_columns_, cells_.size());
        std::size_t column = 0;
        while (column < codes && cells_[column].empty()) ++column;
        if (column >= codes) return notes_.unused("a row without an entity", place(1));
        const std::string_view code = cells_[column];
        if (code.front() == '*') return read_later(column);
        // A code with ^ goes on from the column's own entities, others from the column to the left.
        const bool goes_on = code.front() == '^';
        goes_on ? require(column, column) : require(column, column - 1);
        if (!goes_on) begin_column(column);
        add_code(code, goes_on, column);
        for (std::size_t i = column + 1; i < codes; ++i) {
            if (!cells_[i].empty()) notes_.unused("a second entity of a row", place(i + 1));
        }
    }

    void require(std::size_t column, std::size_t on) const {
        if (on == static_cast<std::size_t>(-1) || (on < open_.size() && open_[on].last != none)) return;
        fail(column + 1, on == column ? "there is no entity above, in this column, that ^ stands for"
                                      : "there is no entity above, in the column to the left, that this one stands on");
    }

    void begin_column(std::size_t column) {
        open_.resize(column);
        open_.emplace_back();
    }

    /// The same entity at a later date.
    void read_later(std::size_t column) {
        if (cells_[column] != "*") fail(column + 1, "* stands alone: it is the entity above, at a later date");
        if (column >= open_.size() || open_[column].last == none) {
            fail(column + 1, "there is no entity above, in this column, that * stands for");
        }
        if (later_rows_++ == 0) later_ = place(column + 1);
        Vertex& vertex = graph_.vertices[open_[column].last];
        Measures values = columns_.read(cells_, place(column + 1), notes_);
        if (vertex.row != none) {
            const Measures before = graph_.rows.row(vertex.row);
            for (std::size_t i = 0; i < values.size(); ++i) {
                if (std::isnan(values[i]) || i == day) values[i] = before[i];
            }
        }
        vertex.row = row_of(values);
    }

    std::uint32_t row_of(const Measures& values) {
        graph_.rows.add(values);
        return graph_.rows.size() == 0 ? none : static_cast<std::uint32_t>(graph_.rows.size() - 1);
    }

    void add_code(std::string_view code, bool goes_on, std::size_t column) {
        const std::vector<EntityCode> items = items_of(code, place(column + 1));
        open_.resize(std::max(open_.size(), column + 1));
        std::uint32_t at = goes_on || column == 0 ? none : open_[column - 1].last;
        const std::size_t old = graph_.vertices.size();
        std::size_t sharing = 0;  // the entities before the last that have its features
        for (std::size_t i = 0; i < items.size(); ++i) {
            const EntityCode& item = items[i];
            const bool may_be_there = at == none || at < old;
            if (column == 0 && !goes_on && i + 1 < items.size() && may_be_there) {
                if (const std::uint32_t there = found({at, item.relation, item.label}); there != none) {
                    at = keep(column, there);
                    continue;
                }
            }
            if (goes_on && i == 0) at = from_column(item, column);
            const std::size_t first = i > 0 && at >= old ? at : graph_.vertices.size();
            at = item.is_row ? add_sequence(at, item, column) : add(at, item.relation, item.label, column);
            sharing = item.is_row && !item.last_alone ? at - first : 0;
        }
        open_.resize(column + 1);
        give_measures(at, sharing, column);
    }

    /// What a row of entities shares are diameters and dates; its place and length are those of the last.
    void give_measures(std::uint32_t last, std::size_t sharing, std::size_t column) {
        if (!has_features_ || cells_.size() <= entity_columns_) return;
        Measures values = columns_.read(cells_, place(column + 1), notes_);
        graph_.vertices[last].row = row_of(values);
        if (const std::string_view plant = columns_.cell(cells_, "plant"); !plant.empty()) {
            graph_.plant_names[last] = plant;
        }
        if (sharing == 0) return;
        values[x] = values[y] = values[z] = values[length] = std::nan("");
        const std::uint32_t row = row_of(values);
        for (std::size_t v = last - sharing; v < last; ++v) graph_.vertices[v].row = row;
    }

    /// I2, I3 ... of I1<<I25.
    std::uint32_t add_sequence(std::uint32_t at, const EntityCode& item, std::size_t column) {
        if (at == none) fail(column + 1, fmt::format("{} stands on nothing: a code begins with /", item.label));
        const std::size_t digits = first_digit(item.label);
        const std::string_view symbol = item.label.substr(0, digits);
        const std::string_view before = label(at);
        const std::optional<int> begin =
            whole_text_as<int>(before.substr(std::min(before.size(), first_digit(before))));
        const std::optional<int> end = whole_text_as<int>(item.label.substr(digits));
        if (!begin || !end || before.substr(0, first_digit(before)) != symbol || *end <= *begin ||
            *end - *begin > longest_sequence) {
            fail(column + 1, fmt::format("{}{}{}{}: a row of entities goes from an index of a class to a higher one, "
                                         "over {} at most",
                                         before, item.relation, item.relation, item.label, longest_sequence));
        }
        for (int index = *begin + 1; index < *end; ++index) {
            sequence_labels_.push_back(fmt::format("{}{}", symbol, index));
            at = add(at, item.relation, sequence_labels_.back(), column);
        }
        return add(at, item.relation, item.label, column);
    }

    /// The entity of a column that ^ stands for: the last one, or the last at the scale of what follows it.
    std::uint32_t from_column(const EntityCode& item, std::size_t column) {
        const Open& open = open_[column];
        if (item.relation == '/') return open.last;
        const int scale = scale_of(item.label, open.last, item.relation);
        if (graph_.vertices[open.last].scale >= scale) return open.last;
        for (auto each = open.of_scale.rbegin(); each != open.of_scale.rend(); ++each) {
            if (graph_.vertices[*each].scale == scale) return *each;
        }
        return open.last;
    }

    /// Makes an entity the last of its column, and of its scale there.
    std::uint32_t keep(std::size_t column, std::uint32_t vertex) {
        Open& open = open_[column];
        open.last = vertex;
        const int scale = graph_.vertices[vertex].scale;
        const auto same = std::find_if(open.of_scale.begin(), open.of_scale.end(),
                                       [&](std::uint32_t each) { return graph_.vertices[each].scale == scale; });
        if (same != open.of_scale.end()) {
            *same = vertex;
        } else {
            open.of_scale.push_back(vertex);
        }
        return vertex;
    }

    /// Of a class that is not declared: that of what it stands on, or the next finer one.
    int scale_of(std::string_view label, std::uint32_t at, char relation) {
        const std::string symbol(label.substr(0, first_digit(label)));
        const auto known = scales_.find(symbol);
        if (known != scales_.end()) return known->second;
        const int whole = at == none ? -1 : graph_.vertices[at].scale;
        const int scale = relation == '/' ? whole + 1 : std::max(whole, 0);
        notes_.warn(fmt::format("CLASSES: does not list '{}': it is taken for one of scale {}", escaped(symbol), scale),
                    place(1));
        return scales_[symbol] = scale;
    }

    /// An entity that a code from the root passes once more. Most files name each once, so that there is no table of
    /// all before it is needed.
    std::uint32_t found(const Passage& passage) {
        if (passage.from == none && roots_.find(passage.label) == roots_.end()) return none;
        if (passed_.empty()) {
            for (std::uint32_t v = 0; v < graph_.vertices.size(); ++v) remember(v);
        }
        const auto known = passed_.find(passage);
        return known == passed_.end() ? none : known->second;
    }

    void remember(std::uint32_t v) {
        const Vertex& vertex = graph_.vertices[v];
        passed_[{relation_from_[v], relation_[v], vertex.label}] = v;
    }

    std::uint32_t add(std::uint32_t at, char relation, std::string_view label, std::size_t column) {
        if (graph_.vertices.size() >= most_entities) {
            fail(column + 1, fmt::format("this file has more than {} entities", most_entities));
        }
        Vertex vertex;
        vertex.label = label;
        vertex.scale = static_cast<std::int16_t>(scale_of(label, at, relation));
        vertex.line = line_;
        vertex.column = static_cast<std::int32_t>(std::min<std::size_t>(column + 1, 1'000'000));
        vertex.follows = relation == '<';
        if (relation == '/') {
            begin_part(vertex, at, column);
        } else {
            attach(vertex, at, column);
        }
        const auto number = static_cast<std::uint32_t>(graph_.vertices.size());
        if (vertex.complex != none) graph_.vertices[vertex.complex].last_part = number;
        if (at == none) roots_[label] = number;
        graph_.vertices.push_back(vertex);
        relation_from_.push_back(at);
        relation_.push_back(relation);
        if (!passed_.empty()) remember(number);
        return keep(column, number);
    }

    void attach(Vertex& vertex, std::uint32_t at, std::size_t column) const {
        if (at == none) fail(column + 1, fmt::format("{} stands on nothing: a code begins with /", vertex.label));
        vertex.stands_on = deepest(at);
        vertex.parent = at_scale(vertex.stands_on, vertex.scale);
        if (vertex.parent == none || graph_.vertices[vertex.parent].scale != vertex.scale) {
            fail(column + 1, fmt::format("{} has no part that {} stands on", label(at), vertex.label));
        }
        vertex.complex = graph_.vertices[vertex.parent].complex;
    }

    /// The first part of what was attached stands where that stands.
    void begin_part(Vertex& part, std::uint32_t whole, std::size_t column) const {
        part.complex = whole;
        if (whole == none) return;
        const Vertex& complex = graph_.vertices[whole];
        if (complex.scale >= part.scale) {
            fail(column + 1, fmt::format("{} is no part of {}: its scale is not finer", part.label, complex.label));
        }
        part.is_first_part = complex.last_part == none;
        if (complex.stands_on == none || !part.is_first_part) return;
        part.stands_on = complex.stands_on;
        part.parent = at_scale(complex.stands_on, part.scale);
        part.follows = complex.follows;
    }

    std::string_view label(std::uint32_t vertex) const { return graph_.vertices[vertex].label; }

    std::uint32_t deepest(std::uint32_t at) const {
        while (graph_.vertices[at].last_part != none) at = graph_.vertices[at].last_part;
        return at;
    }

    /// What has this scale or, without such parts, a coarser one: the deepest vertex, or what it is a part of.
    std::uint32_t at_scale(std::uint32_t deepest, int scale) const {
        std::uint32_t at = deepest;
        while (at != none && graph_.vertices[at].scale > scale) at = graph_.vertices[at].complex;
        return at;
    }

    struct Open {
        std::uint32_t last = none;
        std::vector<std::uint32_t> of_scale;  ///< the last of each scale
    };

    std::string name_, section_;
    measured::Notes& notes_;
    Columns columns_;
    int line_ = 0;
    bool is_header_ = false, has_features_ = false;
    std::map<std::string, int> scales_;  ///< of classes
    std::size_t entity_columns_ = 1;
    std::vector<std::string_view> cells_;
    std::vector<Open> open_;  ///< of each column
    std::vector<std::uint32_t> relation_from_;
    std::vector<char> relation_;
    std::map<std::string_view, std::uint32_t> roots_;
    std::unordered_map<Passage, std::uint32_t, PassageHash> passed_;
    std::size_t later_rows_ = 0;
    Place later_;
    std::deque<std::string> sequence_labels_;  ///< that do not stand in the text
    Graph graph_;
};

}  // namespace

double Graph::measure(const Vertex& vertex, Measure which) const {
    return vertex.row == none ? std::nan("") : rows.at(vertex.row, which);
}

Graph read(const std::string& text, const std::string& name, measured::Notes& notes) {
    return Reader(name, notes).read(text);
}

}  // namespace espalier::language::mtg
