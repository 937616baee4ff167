// The tree behind Settings.
#pragma once

#include "espalier/base/settings.h"

namespace espalier {

struct Settings::Node {
    enum class Type { boolean, integer, real, text, array, table };

    explicit Node(Type kind) : type(kind) {}
    static std::shared_ptr<Node> make(bool value);
    static std::shared_ptr<Node> make(std::int64_t value);
    static std::shared_ptr<Node> make(double value);
    static std::shared_ptr<Node> make(std::string value);

    Type type;
    Place place;
    std::filesystem::path folder;  ///< what relative paths are relative to
    bool boolean = false;
    std::int64_t integer = 0;
    double real = 0;
    std::string text;
    std::vector<std::shared_ptr<Node>> items;  ///< items of an array; values of a table, beside `names`
    std::vector<std::string> names;
    bool was_read = false;
    bool computed = false;  ///< an expression gave the value
    /// Keys asked for and absent, with the defaults used: candidates for "did you mean", and part of what was resolved.
    std::vector<std::pair<std::string, std::shared_ptr<Node>>> defaults;

    double as_number() const { return type == Type::integer ? static_cast<double>(integer) : real; }

    Node* find(std::string_view key) const;
    std::shared_ptr<Node> find_shared(std::string_view key) const;
    /// As find, and marks the value as read.
    Node* read(std::string_view key) { return read_shared(key).get(); }
    std::shared_ptr<Node> read_shared(std::string_view key);
    /// As read; throws UserError saying what was expected if the key is absent.
    Node& require(std::string_view key, const char* expected);
    void remember_default(std::string_view key, std::shared_ptr<Node> value);
    void put(const std::string& key, std::shared_ptr<Node> value);
    void mark_read_below();
    void collect_texts(std::vector<std::string>& texts) const;
    void collect_unread(std::vector<Diagnostic>& diagnostics) const;
    std::string to_json() const;
};

}  // namespace espalier
