#include "language/rsml/vocabulary.h"

#include "base/text.h"

#include <algorithm>
#include <array>

namespace espalier::language::rsml {
namespace {

struct ElementRow {
    Scope around;
    std::string_view element;  ///< "*": whatever it is called
    Scope scope;
};

constexpr std::array element_rows{
    ElementRow{Scope::polyline, "point", Scope::point},
    ElementRow{Scope::function, "sample", Scope::sample},
    ElementRow{Scope::functions, "sample", Scope::sample},  // <functions name="diameter"> itself holds samples
    ElementRow{Scope::outside, "rsml", Scope::document},
    ElementRow{Scope::document, "metadata", Scope::metadata},
    ElementRow{Scope::document, "scene", Scope::scene},
    ElementRow{Scope::document, "plant", Scope::plant},
    ElementRow{Scope::metadata, "unit", Scope::unit},
    ElementRow{Scope::metadata, "resolution", Scope::resolution},
    ElementRow{Scope::metadata, "software", Scope::software},
    ElementRow{Scope::metadata, "up", Scope::up},
    ElementRow{Scope::metadata, "property-definitions", Scope::definitions},
    ElementRow{Scope::metadata, "version", Scope::bookkeeping},
    ElementRow{Scope::metadata, "last-modified", Scope::bookkeeping},
    ElementRow{Scope::metadata, "user", Scope::bookkeeping},
    ElementRow{Scope::metadata, "file-key", Scope::bookkeeping},
    ElementRow{Scope::definitions, "property-definition", Scope::definition},
    ElementRow{Scope::definition, "label", Scope::defined_name},
    ElementRow{Scope::definition, "unit", Scope::defined_unit},
    ElementRow{Scope::definition, "type", Scope::bookkeeping},
    ElementRow{Scope::scene, "plant", Scope::plant},
    ElementRow{Scope::scene, "root", Scope::root},
    ElementRow{Scope::plant, "root", Scope::root},
    ElementRow{Scope::root, "root", Scope::root},
    ElementRow{Scope::root, "geometry", Scope::geometry},
    ElementRow{Scope::geometry, "polyline", Scope::polyline},
    ElementRow{Scope::root, "functions", Scope::functions},
    ElementRow{Scope::functions, "function", Scope::function},
    ElementRow{Scope::functions, "function1", Scope::function},
    ElementRow{Scope::functions, "functions", Scope::function},
    ElementRow{Scope::root, "function", Scope::function},
    ElementRow{Scope::root, "properties", Scope::properties},
    ElementRow{Scope::root, "parent-node", Scope::property},
    ElementRow{Scope::properties, "*", Scope::property},
};

struct TermRow {
    std::string_view word;  ///< without - and _
    Term term;
};

constexpr std::array term_rows{
    TermRow{"diameter", {Quantity::diameter, 1}},
    TermRow{"rootdiameter", {Quantity::diameter, 1}},
    TermRow{"radius", {Quantity::diameter, 2}},
    TermRow{"rootradius", {Quantity::diameter, 2}},
    TermRow{"nodecreationtime", {Quantity::birth, 1}},
    TermRow{"creationtime", {Quantity::birth, 1}},
    TermRow{"emergencetime", {Quantity::birth, 1}},
    TermRow{"emergence", {Quantity::birth, 1}},
    TermRow{"time", {Quantity::birth, 1}},
    TermRow{"age", {Quantity::age, 1}},
    TermRow{"parentnode", {Quantity::parent_node, 1}},
    TermRow{"length", {Quantity::length, 1}},
    TermRow{"continues", {Quantity::continues, 1}},
};

struct UpwardsRow {
    std::string_view software, up;
};

constexpr std::array upwards_rows{
    UpwardsRow{"archisimple", "-y"},
    UpwardsRow{"archidart", "-y"},
};

struct TimeRow {
    std::string_view unit;
    double days;
};

constexpr std::array time_rows{
    TimeRow{"d", 1},           TimeRow{"day", 1},
    TimeRow{"days", 1},        TimeRow{"h", 1.0 / 24},
    TimeRow{"hour", 1. / 24},  TimeRow{"hours", 1. / 24},
    TimeRow{"week", 7},        TimeRow{"weeks", 7},
    TimeRow{"min", 1. / 1440}, TimeRow{"minute", 1. / 1440},
    TimeRow{"s", 1. / 86400},  TimeRow{"second", 1. / 86400},
};

}  // namespace

std::string plain_name(std::string_view name) {
    const std::size_t colon = name.rfind(':');
    return in_small_letters(colon == std::string_view::npos ? name : name.substr(colon + 1));
}

std::optional<Scope> scope_of(Scope around, std::string_view element) {
    for (const ElementRow& row : element_rows) {
        if (row.around == around && (row.element == element || row.element == "*")) return row.scope;
    }
    return std::nullopt;
}

std::optional<Term> term_of(std::string_view name) {
    std::string word = plain_name(name);
    std::erase_if(word, [](char c) { return c == '-' || c == '_' || c == ' '; });
    for (const TermRow& row : term_rows) {
        if (row.word == word) return row.term;
    }
    return std::nullopt;
}

std::string upwards_of(std::string_view software) {
    const std::string small = in_small_letters(software);
    for (const UpwardsRow& row : upwards_rows) {
        if (small.find(row.software) != std::string::npos) return std::string(row.up);
    }
    return "";
}

std::optional<double> days_of(std::string_view unit) {
    const std::string small = in_small_letters(unit);
    for (const TimeRow& row : time_rows) {
        if (row.unit == small) return row.days;
    }
    return std::nullopt;
}

bool is_pixel(std::string_view unit) {
    const std::string small = in_small_letters(unit);
    return small == "pixel" || small == "pixels" || small == "px";
}

}  // namespace espalier::language::rsml
