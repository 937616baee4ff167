#include "espalier/base/settings.h"

#include "base/text.h"
#include "settings_node.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace espalier {
namespace {

using Node = Settings::Node;
using Type = Node::Type;

const char* type_name(Type type) {
    switch (type) {
        case Type::boolean:
            return "true or false";
        case Type::integer:
            return "a whole number";
        case Type::real:
            return "a number";
        case Type::text:
            return "a text";
        case Type::array:
            return "an array";
        case Type::table:
            return "a table";
    }
    return "nothing";
}

std::string article_of(const Node& node) {
    return type_name(node.type);
}

bool is_number(const Node& node) {
    return node.type == Type::integer || node.type == Type::real;
}

[[noreturn]] void wrong_type(const Node& node, std::string_view key, const char* expected) {
    throw UserError(node.place, fmt::format("'{}' must be {}, not {}", key, expected, article_of(node)));
}

std::string describe(Range range) {
    const std::string low = format_general(range.lowest);
    if (std::isinf(range.lowest)) return "at most " + format_general(range.highest);
    if (std::isinf(range.highest)) return (range.open_below ? "greater than " : "at least ") + low;
    return fmt::format("between {} and {}", low, format_general(range.highest));
}

void require_in(const Node& node, std::string_view key, double value, Range range) {
    if (!std::isfinite(value)) {
        throw UserError(node.place, fmt::format("'{}' must be a finite number, not {}", key, format_general(value)));
    }
    const bool low = range.open_below ? value <= range.lowest : value < range.lowest;
    if (low || value > range.highest) {
        throw UserError(node.place,
                        fmt::format("'{}' must be {}, not {}", key, describe(range), format_general(value)));
    }
}

double number_of(const Node& node, std::string_view key, Range range) {
    if (!is_number(node)) wrong_type(node, key, "a number");
    const double value = node.as_number();
    require_in(node, key, value, range);
    return value;
}

std::int64_t integer_of(const Node& node, std::string_view key, Range range) {
    if (node.type != Type::integer) wrong_type(node, key, "a whole number");
    require_in(node, key, static_cast<double>(node.integer), range);
    return node.integer;
}

bool flag_of(const Node& node, std::string_view key) {
    const bool computed = node.computed && node.type == Type::integer && (node.integer == 0 || node.integer == 1);
    if (computed) return node.integer == 1;
    if (node.type != Type::boolean) wrong_type(node, key, "true or false");
    return node.boolean;
}

const std::string& text_of(const Node& node, std::string_view key) {
    if (node.type != Type::text) wrong_type(node, key, "a text");
    return node.text;
}

std::vector<double> numbers_of(const Node& node, std::string_view key) {
    if (node.type != Type::array) wrong_type(node, key, "an array of numbers");
    std::vector<double> values;
    for (const auto& item : node.items) values.push_back(number_of(*item, key, Range::any()));
    return values;
}

glm::dvec3 vector_of(const Node& node, std::string_view key) {
    const std::vector<double> values = numbers_of(node, key);
    if (values.size() != 3) {
        throw UserError(node.place, fmt::format("'{}' must have three numbers [x, y, z], not {}", key, values.size()));
    }
    return {values[0], values[1], values[2]};
}

std::shared_ptr<Node> array_of(std::span<const double> values) {
    auto node = std::make_shared<Node>(Type::array);
    for (double value : values) node->items.push_back(Node::make(value));
    return node;
}

}  // namespace

Settings::Settings() : node_(std::make_shared<Node>(Node::Type::table)) {}

// Who asks for a key would read it: it is offered where its name is misspelt.
bool Settings::has(std::string_view key) const {
    if (node_->find(key)) return true;
    node_->remember_default(key, nullptr);
    return false;
}

Place Settings::place(std::string_view key) const {
    const Node* node = key.empty() ? nullptr : node_->find(key);
    return node ? node->place : node_->place;
}

double Settings::number(std::string_view key, Range range) const {
    return number_of(node_->require(key, "a number"), key, range);
}

std::int64_t Settings::integer(std::string_view key, Range range) const {
    return integer_of(node_->require(key, "a whole number"), key, range);
}

std::string Settings::text(std::string_view key) const {
    return text_of(node_->require(key, "a text"), key);
}

std::vector<double> Settings::numbers(std::string_view key) const {
    return numbers_of(node_->require(key, "an array of numbers"), key);
}

glm::dvec3 Settings::vector(std::string_view key) const {
    return vector_of(node_->require(key, "three numbers [x, y, z]"), key);
}

std::vector<glm::dvec3> Settings::vectors(std::string_view key) const {
    const Node& node = node_->require(key, "an array of vectors [[x, y, z], ...]");
    if (node.type != Type::array) wrong_type(node, key, "an array of vectors [[x, y, z], ...]");
    std::vector<glm::dvec3> vectors;
    for (const auto& item : node.items) vectors.push_back(vector_of(*item, key));
    return vectors;
}

double Settings::number_or(std::string_view key, double fallback, Range range) const {
    const Node* node = node_->read(key);
    if (node) return number_of(*node, key, range);
    node_->remember_default(key, Node::make(fallback));
    return fallback;
}

std::int64_t Settings::integer_or(std::string_view key, std::int64_t fallback, Range range) const {
    const Node* node = node_->read(key);
    if (node) return integer_of(*node, key, range);
    node_->remember_default(key, Node::make(fallback));
    return fallback;
}

bool Settings::flag_or(std::string_view key, bool fallback) const {
    const Node* node = node_->read(key);
    if (node) return flag_of(*node, key);
    node_->remember_default(key, Node::make(fallback));
    return fallback;
}

std::string Settings::text_or(std::string_view key, std::string_view fallback) const {
    const Node* node = node_->read(key);
    if (node) return text_of(*node, key);
    node_->remember_default(key, Node::make(std::string(fallback)));
    return std::string(fallback);
}

std::vector<double> Settings::numbers_or(std::string_view key, std::vector<double> fallback) const {
    const Node* node = node_->read(key);
    if (node) return numbers_of(*node, key);
    node_->remember_default(key, array_of(fallback));
    return fallback;
}

std::vector<std::string> Settings::texts_or(std::string_view key, std::vector<std::string> fallback) const {
    const Node* node = node_->read(key);
    if (!node) {
        auto remembered = std::make_shared<Node>(Type::array);
        for (const std::string& text : fallback) remembered->items.push_back(Node::make(text));
        node_->remember_default(key, std::move(remembered));
        return fallback;
    }
    if (node->type != Type::array) wrong_type(*node, key, "an array of texts");
    std::vector<std::string> texts;
    for (const auto& item : node->items) texts.push_back(text_of(*item, key));
    return texts;
}

glm::dvec3 Settings::vector_or(std::string_view key, glm::dvec3 fallback) const {
    const Node* node = node_->read(key);
    if (node) return vector_of(*node, key);
    const double values[] = {fallback.x, fallback.y, fallback.z};
    node_->remember_default(key, array_of(values));
    return fallback;
}

std::string Settings::choice_or(std::string_view key, std::string_view fallback,
                                const std::vector<std::string>& words) const {
    const std::string word = text_or(key, fallback);
    if (std::find(words.begin(), words.end(), word) != words.end()) return word;
    throw UserError(place(key), fmt::format("'{}' must be one of {}, not '{}'{}", key, fmt::join(words, ", "), word,
                                            did_you_mean(word, words)));
}

std::filesystem::path Settings::path(std::string_view key) const {
    const std::string words = text(key);
    if (words.find_first_of("\b\t\n\f\r") != std::string::npos) {
        throw UserError(place(key),
                        fmt::format("'{}' holds a tab or the end of a line: in double quotes, \\t and \\n mean "
                                    "these. Write a path with slashes, or in single quotes",
                                    key));
    }
    const std::filesystem::path given = words;
    return given.is_absolute() ? given : (node_->folder / given).lexically_normal();
}

std::optional<double> Settings::number_if_any(std::string_view key, Range range) const {
    if (!has(key)) return std::nullopt;
    return number(key, range);
}

std::optional<std::string> Settings::text_if_any(std::string_view key) const {
    if (!has(key)) return std::nullopt;
    return text(key);
}

std::optional<std::filesystem::path> Settings::path_if_any(std::string_view key) const {
    if (!has(key)) return std::nullopt;
    return path(key);
}

Settings Settings::table(std::string_view key) const {
    const std::shared_ptr<Node> node = node_->read_shared(key);
    if (node && node->type != Type::table) wrong_type(*node, key, "a table");
    if (node) return Settings(node);
    auto empty = std::make_shared<Node>(Type::table);
    empty->place = node_->place;
    empty->folder = node_->folder;
    node_->remember_default(key, empty);
    return Settings(empty);
}

std::vector<Settings> Settings::tables(std::string_view key) const {
    const Node* node = node_->read(key);
    if (!node) {
        node_->remember_default(key, nullptr);
        return {};
    }
    if (node->type != Type::array) wrong_type(*node, key, "an array of tables");
    std::vector<Settings> tables;
    for (const auto& item : node->items) {
        if (item->type != Type::table) wrong_type(*item, key, "an array of tables");
        tables.push_back(Settings(item));
    }
    return tables;
}

std::vector<std::string> Settings::keys() const {
    return node_->names;
}

bool Settings::is_table(std::string_view key) const {
    const Node* node = node_->find(key);
    return node && node->type == Type::table;
}

bool Settings::is_text(std::string_view key) const {
    const Node* node = node_->find(key);
    if (node && node->type == Type::array && !node->items.empty()) node = node->items.front().get();
    return node && node->type == Type::text;
}

std::string Settings::value_text(std::string_view key) const {
    const Node& node = node_->require(key, "a value");
    switch (node.type) {
        case Type::boolean:
            return node.boolean ? "1" : "0";
        case Type::integer:
            return std::to_string(node.integer);
        case Type::real:
            return format_exact(node.real);
        case Type::text:
            return node.text;
        default:
            wrong_type(node, key, "a number or a text");
    }
}

std::vector<std::string> Settings::texts_below() const {
    std::vector<std::string> texts;
    node_->collect_texts(texts);
    return texts;
}

void Settings::ignore() const {
    node_->mark_read_below();
}

void Settings::reject_unread() const {
    std::vector<Diagnostic> diagnostics;
    node_->collect_unread(diagnostics);
    if (!diagnostics.empty()) throw UserError(std::move(diagnostics));
}

std::string Settings::resolved_json() const {
    return node_->to_json();
}

}  // namespace espalier
