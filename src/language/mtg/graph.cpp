#include "language/mtg/graph.h"

#include "base/number.h"
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace espalier::language::mtg {
namespace {

std::string in_small_letters(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::size_t begin = 0;
    while (begin <= line.size()) {
        const std::size_t end = std::min(line.find('\t', begin), line.size());
        const std::vector<std::string> words = words_of(std::string_view(line).substr(begin, end - begin), " \r");
        std::string& cell = cells.emplace_back();
        for (const std::string& word : words) cell += (cell.empty() ? "" : " ") + word;
        begin = end + 1;
    }
    return cells;
}

/// "^<I12": the operator, then a class and an index.
struct Item {
    char relation;
    std::string label;
};

class Reader {
public:
    explicit Reader(const std::string& name) : name_(name) {}

    Graph read(const std::string& text) {
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            ++line_;
            note(line);
            line.resize(std::min(line.find('#'), line.size()));
            if (words_of(line, " \t\r").empty()) continue;
            read_line(line);
        }
        if (section_ != "mtg") fail(1, "this file has no section MTG:");
        if (graph_.vertices.empty()) fail(1, "this file has no entities below MTG:");
        return std::move(graph_);
    }

private:
    [[noreturn]] void fail(std::size_t column, const std::string& message) const {
        throw UserError(Place{name_, std::max(line_, 1), static_cast<int>(column)}, message);
    }

    /// Comments may tell what an MTG has no place for.
    void note(const std::string& line) {
        const std::vector<std::string> words = words_of(line, " \t\r");
        if (words.size() != 3 || words[0] != "#") return;
        if (words[1] == "unit:") graph_.unit = words[2];
        if (words[1] == "up:") graph_.up = words[2];
    }

    void read_line(const std::string& line) {
        const std::vector<std::string> words = words_of(line, " \t\r");
        for (const char* const section : {"code", "classes", "description", "features", "mtg"}) {
            if (in_small_letters(words[0]) != std::string(section) + ":") continue;
            section_ = section;
            is_header_ = true;
            return;
        }
        if (section_ == "classes") read_class(words);
        if (section_ != "mtg") return;
        if (is_header_) return read_header(cells_of(line));
        read_entity(cells_of(line));
    }

    void read_class(const std::vector<std::string>& words) {
        const std::optional<double> scale = words.size() > 1 ? finite_number(words[1]) : std::nullopt;
        if (scale && words[0] != "$") scales_[words[0]] = static_cast<int>(std::clamp(*scale, 0.0, 1000.0));
    }

    void read_header(const std::vector<std::string>& cells) {
        is_header_ = false;
        const std::string first = in_small_letters(cells[0]);
        if (first != "entity-code" && first != "topo") fail(1, "the line below MTG: begins with ENTITY-CODE");
        entity_columns_ = cells.size();
        for (std::size_t i = cells.size(); i-- > 1;) {
            if (cells[i].empty()) continue;
            graph_.column[in_small_letters(cells[i])] = i;
            entity_columns_ = i;
        }
        for (auto& feature : graph_.column) feature.second -= entity_columns_;
        last_.assign(entity_columns_, std::nullopt);
    }

    void read_entity(const std::vector<std::string>& cells) {
        std::size_t column = 0;
        while (column < std::min(entity_columns_, cells.size()) && cells[column].empty()) ++column;
        if (column >= std::min(entity_columns_, cells.size())) return;
        const std::vector<Item> items = items_of(cells[column], column + 1);
        std::optional<std::size_t> at = begin_of(cells[column][0] == '^', column);
        for (std::size_t i = 0; i < items.size(); ++i) {
            const bool is_passed = column == 0 && cells[column][0] != '^' && i + 1 < items.size();
            const std::optional<std::size_t> there = is_passed ? found(at, items[i]) : std::nullopt;
            at = there ? *there : add(at, items[i], column + 1);
        }
        if (cells.size() > entity_columns_) {
            graph_.vertices[*at].features.assign(cells.begin() + static_cast<std::ptrdiff_t>(entity_columns_),
                                                 cells.end());
        }
        last_[column] = at;
        std::fill(last_.begin() + static_cast<std::ptrdiff_t>(column) + 1, last_.end(), std::nullopt);
    }

    /// A code with ^ goes on from the last one of its column, others from the column to the left.
    std::optional<std::size_t> begin_of(bool goes_on, std::size_t column) const {
        if (!goes_on && column == 0) return std::nullopt;
        const std::optional<std::size_t> at = last_[goes_on ? column : column - 1];
        if (at) return at;
        fail(column + 1, goes_on ? "there is no entity above, in this column, that ^ stands for"
                                 : "there is no entity above, in the column to the left, that this one stands on");
    }

    std::vector<Item> items_of(const std::string& code, std::size_t column) const {
        std::vector<Item> items;
        for (std::size_t i = code[0] == '^'; i < code.size();) {
            const char relation = code[i++];
            if (relation != '/' && relation != '<' && relation != '+') {
                fail(column, fmt::format("'{}' begins no entity: write /, < or + and then its class and index", code));
            }
            if (i < code.size() && (code[i] == '<' || code[i] == '.')) {
                fail(column, "rows of entities (<< and <.) are not read: write a line for each");
            }
            const std::size_t end = std::min(code.find_first_of("/<+", i), code.size());
            items.push_back({relation, code.substr(i, end - i)});
            if (end == i) fail(column, fmt::format("an entity of '{}' has no class", code));
            i = end;
        }
        if (items.empty()) fail(column, fmt::format("'{}' names no entity", code));
        return items;
    }

    int scale_of(const std::string& label, std::size_t column) const {
        const std::string symbol = label.substr(0, label.find_first_of("0123456789"));
        const auto found = scales_.find(symbol);
        if (found != scales_.end()) return found->second;
        fail(column, fmt::format("'{}' is no class: CLASSES: does not list it", symbol));
    }

    /// An entity that a code from the root passes once more.
    std::optional<std::size_t> found(std::optional<std::size_t> at, const Item& item) const {
        const auto known = passed_.find({at ? *at : std::size_t(-1), item.relation + item.label});
        return known == passed_.end() ? std::nullopt : std::optional(known->second);
    }

    std::size_t add(std::optional<std::size_t> at, const Item& item, std::size_t column) {
        Vertex vertex;
        vertex.label = item.label;
        vertex.scale = scale_of(item.label, column);
        vertex.place = {name_, line_, static_cast<int>(column)};
        vertex.follows = item.relation == '<';
        if (item.relation == '/') {
            if (at && graph_.vertices[*at].scale >= vertex.scale) {
                fail(column, fmt::format("{} is no part of {}: its scale is not finer", item.label,
                                         graph_.vertices[*at].label));
            }
            begin_part(vertex, at);
        } else {
            if (!at) fail(column, fmt::format("{} stands on nothing: a code begins with /", item.label));
            vertex.parent = at_scale(*at, vertex.scale);
            if (!vertex.parent) fail(column, fmt::format("{} has no part that {} stands on", label(*at), item.label));
            vertex.complex = graph_.vertices[*vertex.parent].complex;
            vertex.stands_on = at;
        }
        const std::size_t number = graph_.vertices.size();
        if (vertex.complex) graph_.vertices[*vertex.complex].last_part = number;
        passed_[{at ? *at : std::size_t(-1), item.relation + item.label}] = number;
        graph_.vertices.push_back(std::move(vertex));
        return number;
    }

    const std::string& label(std::size_t vertex) const { return graph_.vertices[vertex].label; }

    /// The first part of what was attached stands where that stands.
    void begin_part(Vertex& part, std::optional<std::size_t> whole) const {
        part.complex = whole;
        if (!whole) return;
        const Vertex& complex = graph_.vertices[*whole];
        if (!complex.stands_on || complex.last_part) return;
        part.stands_on = complex.stands_on;
        part.parent = at_scale(*complex.stands_on, part.scale);
        part.follows = complex.follows;
    }

    /// What has this scale: the vertex, what it is a part of, or the last of its parts.
    std::optional<std::size_t> at_scale(std::size_t vertex, int scale) const {
        std::optional<std::size_t> at = vertex;
        while (at && graph_.vertices[*at].scale > scale) at = graph_.vertices[*at].complex;
        while (at && graph_.vertices[*at].scale < scale) at = graph_.vertices[*at].last_part;
        return at && graph_.vertices[*at].scale == scale ? at : std::nullopt;
    }

    std::string name_, section_;
    int line_ = 0;
    bool is_header_ = false;
    std::map<std::string, int> scales_;  ///< of classes
    std::size_t entity_columns_ = 1;
    std::vector<std::optional<std::size_t>> last_;  ///< entity of each column
    std::map<std::pair<std::size_t, std::string>, std::size_t> passed_;
    Graph graph_;
};

}  // namespace

std::optional<double> Graph::number(const Vertex& vertex, std::initializer_list<const char*> names) const {
    for (const char* const name : names) {
        const auto found = column.find(name);
        if (found == column.end() || found->second >= vertex.features.size()) continue;
        const std::optional<double> value = finite_number(vertex.features[found->second]);
        if (value && std::abs(*value) < 1e12) return value;
    }
    return std::nullopt;
}

Graph read(const std::string& text, const std::string& name) {
    return Reader(name).read(text);
}

}  // namespace espalier::language::mtg
