// Parameters as a file or a program gives them: typed look-ups with defaults and ranges; unknown names are errors.
#pragma once

#include "espalier/base/error.h"

#include <glm/vec3.hpp>

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

/// What a number may be; the bounds are part of the message when it is not.
struct Range {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    bool open_below = false;  ///< the lowest value itself is not allowed

    static Range any() { return {}; }
    static Range positive() { return {0, std::numeric_limits<double>::infinity(), true}; }
    static Range not_negative() { return {0, std::numeric_limits<double>::infinity(), false}; }
    static Range between(double a, double b) { return {a, b, false}; }
};

class SettingValue;

/// A table of parameters, from TOML or made by a program:
///   Settings{{"voxel", 0.25}, {"centre", {0, 1, 0}}, {"motion", Settings{{"growth", 0.1}}}}
/// Copies share the same table; several threads may read it. Every look-up marks its key as read and remembers the
/// value used, default or not, for `resolved_json()`. Look-ups throw UserError with file, line and column when the
/// value is missing, of the wrong type or out of range.
class Settings {
public:
    struct Entry;

    Settings();
    Settings(std::initializer_list<Entry> entries);

    /// Reads a TOML file or text; `name` stands in messages. Throws UserError.
    static Settings read_toml(const std::filesystem::path& path);
    static Settings parse_toml(std::string_view text, const std::string& name,
                               const std::filesystem::path& folder = {});

    bool has(std::string_view key) const;
    Place place(std::string_view key = {}) const;  ///< where a key stands, or the table itself

    /// Nothing if the key is absent.
    std::optional<double> number_if_any(std::string_view key, Range range = Range::any()) const;
    std::optional<std::string> text_if_any(std::string_view key) const;

    // Required values.
    double number(std::string_view key, Range range = Range::any()) const;
    std::int64_t integer(std::string_view key, Range range = Range::any()) const;
    std::string text(std::string_view key) const;
    std::vector<double> numbers(std::string_view key) const;
    glm::dvec3 vector(std::string_view key) const;
    std::vector<glm::dvec3> vectors(std::string_view key) const;  ///< [[x, y, z], ...]

    // Values with a default.
    double number_or(std::string_view key, double fallback, Range range = Range::any()) const;
    std::int64_t integer_or(std::string_view key, std::int64_t fallback, Range range = Range::any()) const;
    bool flag_or(std::string_view key, bool fallback) const;
    std::string text_or(std::string_view key, std::string_view fallback) const;
    std::vector<double> numbers_or(std::string_view key, std::vector<double> fallback) const;
    std::vector<std::string> texts_or(std::string_view key, std::vector<std::string> fallback) const;
    glm::dvec3 vector_or(std::string_view key, glm::dvec3 fallback) const;

    /// One of several words; anything else is an error that lists them and offers the nearest.
    std::string choice_or(std::string_view key, std::string_view fallback, const std::vector<std::string>& words) const;

    /// A file name, relative to the file that says it. Does not check that it exists.
    std::filesystem::path path(std::string_view key) const;
    std::optional<std::filesystem::path> path_if_any(std::string_view key) const;

    /// A sub-table (empty if absent), an array of tables (empty if absent), the keys in the file's order.
    Settings table(std::string_view key) const;
    std::vector<Settings> tables(std::string_view key) const;
    std::vector<std::string> keys() const;
    /// True if the value of `key` is a table.
    bool is_table(std::string_view key) const;
    /// True if the value of `key` is a text, or a list that begins with one.
    bool is_text(std::string_view key) const;
    /// The value as text whatever its type (for #define overrides).
    std::string value_text(std::string_view key) const;

    /// Overrides one value, e.g. set("environment.light.voxel", "0.5"); `a.2.b` enters the third table of an array.
    /// The value is read as TOML, or taken as text if it is not. Throws UserError if the path leads nowhere sensible.
    void set(std::string_view dotted_key, std::string_view value);

    /// Replaces texts that begin with '=', here and below, by what `evaluate` makes of the rest; `key` is the place of
    /// the key that holds the expression. A flag may be computed as 0 or 1. Throws UserError naming the keys of all
    /// expressions that `evaluate` refuses without a place.
    using Evaluate = std::function<double(std::string_view expression, const Place& key)>;
    void replace_expressions(const Evaluate& evaluate) const;

    /// One value as a program gives it; relative paths are relative to the current folder.
    void put(std::string_view key, SettingValue value);
    /// A table of its own with the same values, none of them read. In messages `name` stands where a file's would.
    Settings copy(const std::string& name) const;

    /// All values here and below that are texts. Marks nothing as read.
    std::vector<std::string> texts_below() const;

    /// Marks everything here and below as read: a table that is not used may hold anything.
    void ignore() const;
    /// Throws UserError listing every key that was not read, here and below, with the nearest name that was asked for.
    void reject_unread() const;

    /// Everything read so far with the values used, as JSON text.
    std::string resolved_json() const;

    struct Node;

private:
    friend class SettingValue;
    explicit Settings(std::shared_ptr<Node> node) : node_(std::move(node)) {}
    std::shared_ptr<Node> node_;
};

/// Made from what it holds: true or false, a number, a text, a list of these, or a table.
class SettingValue {
public:
    SettingValue(bool value);
    SettingValue(double value);
    template <std::integral Integer>
    SettingValue(Integer value) : SettingValue(whole(static_cast<std::int64_t>(value))) {}
    SettingValue(const char* text);
    SettingValue(const std::string& text);
    SettingValue(const std::filesystem::path& path);
    SettingValue(glm::dvec3 vector);
    SettingValue(std::initializer_list<SettingValue> list);
    SettingValue(const std::vector<double>& list);
    SettingValue(const std::vector<std::string>& list);
    SettingValue(const Settings& table);

private:
    friend class Settings;
    explicit SettingValue(std::shared_ptr<Settings::Node> node) : node_(std::move(node)) {}
    static SettingValue whole(std::int64_t value);
    std::shared_ptr<Settings::Node> node_;
};

struct Settings::Entry {
    std::string key;
    SettingValue value;
};

}  // namespace espalier
