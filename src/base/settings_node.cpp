#include "settings_node.h"

#include "base/json_text.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <mutex>

namespace espalier {
namespace {

using Node = Settings::Node;
using Json = nlohmann::ordered_json;

Json json_of(const Node& node);

Json json_of_table(const Node& node) {
    Json object = Json::object();
    for (std::size_t i = 0; i < node.names.size(); ++i) object[node.names[i]] = json_of(*node.items[i]);
    for (const auto& [key, value] : node.defaults) {
        if (value && !node.find(key)) object[key] = json_of(*value);
    }
    return object;
}

Json json_of(const Node& node) {
    switch (node.type) {
        case Node::Type::boolean:
            return node.boolean;
        case Node::Type::integer:
            return node.integer;
        case Node::Type::real:
            return node.real;
        case Node::Type::text:
            return node.text;
        case Node::Type::table:
            return json_of_table(node);
        case Node::Type::array:
            break;
    }
    Json array = Json::array();
    for (const auto& item : node.items) array.push_back(json_of(*item));
    return array;
}

template <class Value>
std::shared_ptr<Node> scalar(Node::Type type, Value Node::*member, Value value) {
    auto node = std::make_shared<Node>(type);
    (*node).*member = std::move(value);
    return node;
}

/// Looking up marks what was read, in tables that several worlds of one scene may share.
std::mutex& marks() {
    static std::mutex mutex;
    return mutex;
}

/// The name that was meant, or else all that are known.
std::string what_may_stand(const std::string& name, std::vector<std::string> known) {
    std::string meant = did_you_mean(name, known);
    if (!meant.empty() || known.empty()) return meant;
    std::sort(known.begin(), known.end());
    return fmt::format("; what can stand here: {}", fmt::join(known, ", "));
}

void mark_below(const Node& node) {
    for (const auto& item : node.items) {
        item->was_read = true;
        mark_below(*item);
    }
}

void collect_unread_below(const Node& node, std::vector<Diagnostic>& diagnostics) {
    const bool is_table = node.type == Node::Type::table;
    std::vector<std::string> known;
    for (std::size_t i = 0; is_table && i < node.names.size(); ++i) {
        if (node.items[i]->was_read) known.push_back(node.names[i]);
    }
    for (const auto& entry : node.defaults) known.push_back(entry.first);
    for (std::size_t i = 0; i < node.items.size(); ++i) {
        if (is_table && !node.items[i]->was_read) {
            diagnostics.push_back(
                {Diagnostic::Severity::error, node.items[i]->place,
                 fmt::format("'{}' means nothing here{}", node.names[i], what_may_stand(node.names[i], known))});
        } else {
            collect_unread_below(*node.items[i], diagnostics);
        }
    }
}

}  // namespace

std::shared_ptr<Node> Node::make(bool value) {
    return scalar(Type::boolean, &Node::boolean, value);
}

std::shared_ptr<Node> Node::make(std::int64_t value) {
    return scalar(Type::integer, &Node::integer, value);
}

std::shared_ptr<Node> Node::make(double value) {
    return scalar(Type::real, &Node::real, value);
}

std::shared_ptr<Node> Node::make(std::string value) {
    return scalar(Type::text, &Node::text, std::move(value));
}

std::shared_ptr<Node> Node::find_shared(std::string_view key) const {
    const auto at = std::find(names.begin(), names.end(), key);
    return at == names.end() ? nullptr : items[at - names.begin()];
}

Node* Node::find(std::string_view key) const {
    return find_shared(key).get();
}

std::shared_ptr<Node> Node::read_shared(std::string_view key) {
    std::shared_ptr<Node> node = find_shared(key);
    if (!node) return nullptr;
    const std::lock_guard lock(marks());
    node->was_read = true;
    // What lies in a plain array is read with it; tables inside answer for themselves.
    for (const auto& item : node->items) {
        if (node->type == Type::array) item->was_read = true;
    }
    return node;
}

Node& Node::require(std::string_view key, const char* expected) {
    if (Node* node = read(key)) return *node;
    remember_default(key, nullptr);
    throw UserError(place, fmt::format("'{}' is missing here: {} is needed", key, expected));
}

void Node::remember_default(std::string_view key, std::shared_ptr<Node> value) {
    const auto known = [&](const auto& entry) { return entry.first == key; };
    const std::lock_guard lock(marks());
    const auto at = std::find_if(defaults.begin(), defaults.end(), known);
    if (at == defaults.end()) {
        defaults.emplace_back(std::string(key), std::move(value));
    } else if (!at->second) {
        at->second = std::move(value);
    }
}

void Node::put(const std::string& key, std::shared_ptr<Node> value) {
    const auto at = std::find(names.begin(), names.end(), key);
    if (at != names.end()) {
        items[at - names.begin()] = std::move(value);
        return;
    }
    names.push_back(key);
    items.push_back(std::move(value));
}

void Node::mark_read_below() {
    const std::lock_guard lock(marks());
    mark_below(*this);
}

void Node::collect_texts(std::vector<std::string>& texts) const {
    if (type == Type::text) texts.push_back(text);
    for (const std::shared_ptr<Node>& item : items) item->collect_texts(texts);
}

void Node::collect_unread(std::vector<Diagnostic>& diagnostics) const {
    const std::lock_guard lock(marks());
    collect_unread_below(*this, diagnostics);
}

std::string Node::to_json() const {
    const std::lock_guard lock(marks());
    // A value of the command line may be no UTF-8.
    return json_text(json_of(*this));
}

}  // namespace espalier
