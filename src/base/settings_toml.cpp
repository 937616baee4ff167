// TOML into Settings: the only place that knows toml++.
#include "espalier/base/file.h"

#include "base/text.h"
#include "base/toml_depth.h"
#include "base/toml_words.h"
#include "settings_node.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

namespace espalier {
namespace {

using Node = Settings::Node;

struct Origin {
    std::string name;
    std::filesystem::path folder;
};

Place place_of(const toml::source_region& source, const Origin& origin) {
    return {origin.name, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

std::shared_ptr<Node> convert(const toml::node& from, const Origin& origin);

std::shared_ptr<Node> convert_table(const toml::table& table, const Origin& origin) {
    auto node = std::make_shared<Node>(Node::Type::table);
    // toml++ sorts keys; the order of processes in a scene has a meaning, so go back to the file's.
    std::vector<std::pair<const toml::key*, const toml::node*>> entries;
    for (const auto& [key, value] : table) entries.emplace_back(&key, &value);
    std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
        const auto begin_of = [](const auto& entry) { return entry.first->source().begin; };
        return begin_of(a) < begin_of(b);
    });
    for (const auto& [key, value] : entries) {
        std::shared_ptr<Node> child = convert(*value, origin);
        child->place = place_of(key->source(), origin);
        node->put(std::string(key->str()), std::move(child));
    }
    return node;
}

std::shared_ptr<Node> convert_value(const toml::node& from, const Origin& origin) {
    if (const toml::table* table = from.as_table()) return convert_table(*table, origin);
    if (const toml::array* array = from.as_array()) {
        auto node = std::make_shared<Node>(Node::Type::array);
        for (const toml::node& item : *array) node->items.push_back(convert(item, origin));
        return node;
    }
    if (from.is_boolean()) return Node::make(*from.value<bool>());
    if (from.is_integer()) return Node::make(*from.value<std::int64_t>());
    if (from.is_floating_point()) return Node::make(*from.value<double>());
    if (from.is_string()) return Node::make(*from.value<std::string>());
    throw UserError(place_of(from.source(), origin), "dates and times mean nothing here");
}

std::shared_ptr<Node> convert(const toml::node& from, const Origin& origin) {
    std::shared_ptr<Node> node = convert_value(from, origin);
    node->place = place_of(from.source(), origin);
    node->folder = origin.folder;
    return node;
}

std::string line_of(std::string_view text, std::size_t number) {
    std::istringstream in{std::string(text)};
    std::string line;
    for (std::size_t i = 0; i < number && std::getline(in, line); ++i) {
    }
    return line;
}

// All that toml++ ever reads comes this way.
toml::table parsed(std::string_view text, const Origin& origin) {
    if (std::optional<Place> place = deeper_than_toml_may_be(text)) {
        place->file = origin.name;
        throw UserError(*place, fmt::format("keys, tables and arrays are nested more than {} deep", deepest_toml));
    }
    return toml::parse(text, origin.name);
}

std::shared_ptr<Node> parse(std::string_view text, const Origin& origin) {
    try {
        return convert(parsed(text, origin), origin);
    } catch (const toml::parse_error& error) {
        const std::string line = line_of(text, error.source().begin.line);
        throw UserError(place_of(error.source(), origin), words_for_toml(error.description(), line), line);
    }
}

// Array jobs pad their numbers: 007 is no TOML, but means 7.
std::string_view without_padding(std::string_view value) {
    const bool is_whole = !value.empty() && value.find_first_not_of("0123456789") == std::string_view::npos;
    return is_whole ? value.substr(std::min(value.find_first_not_of('0'), value.size() - 1)) : value;
}

// A value given on the command line: TOML if it reads as such, text otherwise.
std::shared_ptr<Node> parse_value(std::string_view value, const Origin& origin) {
    try {
        const toml::table table = parsed("value = " + std::string(without_padding(value)), origin);
        if (table.size() == 1) return convert(*table.get("value"), origin);
    } catch (const toml::parse_error&) {
    }
    return Node::make(std::string(value));
}

std::vector<std::string> split(std::string_view dotted) {
    std::vector<std::string> parts{""};
    for (char c : dotted) {
        if (c == '.') {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

bool is_index(const std::string& part) {
    return !part.empty() && part.size() < 9 && part.find_first_not_of("0123456789") == std::string::npos;
}

std::shared_ptr<Node> enter(Node& node, const std::string& part, std::string_view dotted, const Place& place) {
    if (node.type == Node::Type::array) {
        if (is_index(part) && std::stoul(part) < node.items.size()) return node.items[std::stoul(part)];
        throw UserError(place, fmt::format("'{}': '{}' must be a number from 0 to {}", dotted, part,
                                           static_cast<int>(node.items.size()) - 1));
    }
    if (node.type != Node::Type::table) {
        throw UserError(place, fmt::format("'{}': the part before '{}' is not a table", dotted, part));
    }
    if (std::shared_ptr<Node> child = node.find_shared(part)) return child;
    auto child = std::make_shared<Node>(Node::Type::table);
    child->place = place;
    child->folder = node.folder;
    node.put(part, child);
    return child;
}

/// `*` enters all tables of an array.
std::vector<std::shared_ptr<Node>> enter_all(const std::vector<std::shared_ptr<Node>>& nodes, const std::string& part,
                                             std::string_view dotted, const Place& place) {
    std::vector<std::shared_ptr<Node>> entered;
    for (const std::shared_ptr<Node>& node : nodes) {
        if (part == "*" && node->type == Node::Type::array) {
            entered.insert(entered.end(), node->items.begin(), node->items.end());
        } else {
            entered.push_back(enter(*node, part, dotted, place));
        }
    }
    return entered;
}

void put_value(Node& node, const std::string& last, std::string_view value, std::string_view dotted,
               const Place& place) {
    std::shared_ptr<Node> parsed = parse_value(value, {place.file, node.folder});
    parsed->place = place;
    if (node.type == Node::Type::array && is_index(last) && std::stoul(last) < node.items.size()) {
        node.items[std::stoul(last)] = std::move(parsed);
    } else if (node.type == Node::Type::table) {
        node.put(last, std::move(parsed));
    } else {
        throw UserError(place, fmt::format("'{}' leads nowhere in this file", dotted));
    }
}

}  // namespace

Settings Settings::read_toml(const std::filesystem::path& path) {
    return Settings(parse(read_text(path), {path.string(), path.parent_path()}));
}

Settings Settings::parse_toml(std::string_view text, const std::string& name, const std::filesystem::path& folder) {
    return Settings(parse(text, {name, folder}));
}

void Settings::set(std::string_view dotted_key, std::string_view value) {
    const Place place{"--set " + std::string(dotted_key), 0, 0};
    const std::vector<std::string> parts = split(dotted_key);
    if (parts.size() > deepest_toml) {
        throw UserError(place, fmt::format("the key has {} parts, and may have {}", parts.size(), deepest_toml));
    }
    for (const std::string& part : parts) {
        if (part.empty()) throw UserError(place, "a key such as simulation.steps is expected");
    }
    std::vector<std::shared_ptr<Node>> nodes{node_};
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) nodes = enter_all(nodes, parts[i], dotted_key, place);
    for (const std::shared_ptr<Node>& node : nodes) put_value(*node, parts.back(), value, dotted_key, place);
}

}  // namespace espalier
