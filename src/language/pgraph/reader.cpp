#include "espalier/base/file.h"
#include "espalier/language/model_settings.h"

#include "base/characters.h"
#include "base/text.h"
#include "language/pgraph/graph.h"
#include "language/pgraph/schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <utility>

namespace espalier::language::pgraph {
namespace {

constexpr int newest_version = 1;

/// The text with blanks instead of comments, except on the lines of #define, where comments are settings, and for one
/// that never ends.
std::string without_comments(std::string text) {
    const auto line_end = [&](std::size_t k) { return std::min(text.find('\n', k), text.size()); };
    for (std::size_t k = 0; k < text.size();) {
        const bool begins_line = k == 0 || text[k - 1] == '\n';
        if (begins_line && text.compare(k, 7, "#define") == 0) {
            k = line_end(k);
        } else if (text.compare(k, 2, "//") == 0 || text.compare(k, 2, "/*") == 0) {
            const bool is_block = text[k + 1] == '*';
            if (is_block && text.find("*/", k + 2) == std::string::npos) return text;
            const std::size_t end = is_block ? text.find("*/", k + 2) + 2 : line_end(k);
            for (; k < end; ++k) {
                if (text[k] != '\n') text[k] = ' ';
            }
        } else {
            ++k;
        }
    }
    return text;
}

bool is_component_name(const std::string& name) {
    const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || is_digit(c) || c == '_'; };
    return name.size() > 1 && name.front() >= 'a' && name.front() <= 'z' && std::all_of(name.begin(), name.end(), fits);
}

class Reader {
public:
    Graph read(const std::string& text, const std::string& file) {
        read_file(text, file);
        if (has_version_) check_links(file);
        if (!mistakes_.empty()) throw UserError(std::move(mistakes_));
        return std::move(graph_);
    }

private:
    /// The lines of #define of a file, each at its own line.
    struct Definitions {
        std::string text;
        int newlines = 0;
    };

    void read_file(const std::string& text, const std::string& file) {
        files_.push_back(file);
        number_ = 0;
        has_version_ = false;
        std::istringstream in(without_comments(text));
        for (std::string line; std::getline(in, line);) {
            ++number_;
            line_ = line;
            while (!line_.empty() && is_blank(line_.back())) line_.pop_back();
            if (line_.find_first_not_of(" \t") == std::string::npos) continue;
            if (const std::size_t open = line_.find("/*"); open != std::string::npos && !line_.starts_with("#define")) {
                mistake(open, "this comment is never closed: '*/' is missing");
                break;
            }
            if (!has_version_ && words_of(line_, " \t").front() != "pgraph") break;  // what follows is no graph
            read_line();
        }
        if (!has_version_ && mistakes_.empty()) {
            number_ = std::max(number_, 1);
            mistake(0, fmt::format("a graph begins with the line 'pgraph {}'", newest_version));
        } else if (has_version_) {
            check_settings();
        }
        files_.pop_back();
    }

    void mistake(std::size_t column, const std::string& message) { report(place(column), message); }

    void report(const Place& place, const std::string& message) {
        constexpr std::size_t most = 20;
        if (mistakes_.size() < most) mistakes_.push_back({Diagnostic::Severity::error, place, message});
    }

    std::string line_of(const Place& first) const {
        return fmt::format("{}line {}", first.file == files_.back() ? "" : first.file + ", ", first.line);
    }

    Place place(std::size_t column) const { return {files_.back(), number_, static_cast<int>(column) + 1}; }

    void read_line() {
        if (line_.starts_with("#define")) return read_define();
        const std::vector<std::string> words = words_of(line_, " \t");
        if (!is_blank(line_.front()) && words.front() == "pgraph") return read_version(words);
        if (!is_blank(line_.front()) && words.front() == "include") return read_include();
        if (line_.find("->") != std::string::npos) return read_links();
        if (is_blank(line_.front())) return read_key();
        read_component(words);
    }

    void read_define() {
        const std::vector<std::string> words = words_of(line_, " \t(");
        const std::string name = words.size() > 1 ? words[1] : "";
        const auto fits = [](char c) { return (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_'; };
        if (name.size() < 2 || !std::all_of(name.begin(), name.end(), fits)) {
            return mistake(line_.find(name), "the name of a #define is written in capitals, at least two");
        }
        if (line_.back() == '\\') return mistake(line_.size() - 1, "a #define is one line, without a '\\' at its end");
        const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' && !is_blank(c); };
        if (const auto strange = std::find_if(line_.begin(), line_.end(), is_control); strange != line_.end()) {
            return mistake(std::size_t(strange - line_.begin()), "a #define holds no control characters");
        }
        if (const auto comment = line_.rfind("/*"); comment != std::string::npos) {
            if (line_.find("*/", comment + 2) == std::string::npos) {
                return mistake(comment, "a comment behind a #define ends on its line: '*/' is missing");
            }
        }
        const auto [first, is_new] = defined_.emplace(name, place(0));
        if (!is_new) {
            return mistake(line_.find(name, 7),
                           fmt::format("'{}' is defined already, in {}", name, line_of(first->second)));
        }
        graph_.defines.push_back({line_, place(0)});
        definitions_.text.resize(definitions_.text.size() + std::size_t(number_ - 1 - definitions_.newlines), '\n');
        definitions_.text += line_ + "\n";
        definitions_.newlines = number_;
    }

    // include "leaves.pgraph": its lines, as if they stood here.
    void read_include() {
        const std::size_t first = line_.find('"'), last = line_.rfind('"');
        if (first == last) return mistake(0, "expected a file in quotes: include \"leaves.pgraph\"");
        const std::string written = line_.substr(first + 1, last - first - 1);
        const std::string file =
            (std::filesystem::path(files_.back()).parent_path() / written).lexically_normal().string();
        if (std::find(files_.begin(), files_.end(), file) != files_.end()) {
            return mistake(first, fmt::format("'{}' includes itself", written));
        }
        std::string text;
        try {
            text = read_text(file);
        } catch (const UserError& error) {
            return mistake(first, error.what());
        }
        const int number = std::exchange(number_, 0);
        const bool has_version = has_version_;
        Definitions definitions = std::exchange(definitions_, {});
        read_file(text, file);
        number_ = number;
        has_version_ = has_version;
        definitions_ = std::move(definitions);
    }

    void read_version(const std::vector<std::string>& words) {
        has_version_ = true;
        if (words.size() != 2 || words[1] != std::to_string(newest_version)) {
            mistake(0, fmt::format("this program reads graphs of version {}: expected 'pgraph {}'", newest_version,
                                   newest_version));
        }
    }

    void read_component(const std::vector<std::string>& words) {
        const ComponentType* type = find_type(words.front());
        if (!type) {
            skips_keys_ = true;
            std::vector<std::string> names;
            for (const ComponentType& each : component_types()) names.push_back(each.name);
            if (!graph_.components.empty() && find_type(graph_.components.back().type)->find(words.front())) {
                return mistake(0, fmt::format("'{}' is a key, which stands behind blanks", words.front()));
            }
            return mistake(0, fmt::format("'{}' is no component; the components are {}{}", words.front(),
                                          fmt::join(names, ", "), did_you_mean(words.front(), names)));
        }
        skips_keys_ = false;
        const std::string name = words.size() > 1 ? words[1] : "";
        const std::size_t column = name.empty() ? line_.size() : line_.find(name, words.front().size());
        if (words.size() != 2 || !is_component_name(name) || name == camera) {
            mistake(column, words.size() < 2 ? fmt::format("expected a name after '{}'", type->name)
                                             : fmt::format("'{}' is no name of a component; a name has two or more of "
                                                           "a to z, 0 to 9 and _, begins with a letter, and is not "
                                                           "'{}'",
                                                           words.size() > 2 ? line_.substr(column) : name, camera));
        } else if (graph_.find(name)) {
            mistake(column,
                    fmt::format("there is a component '{}' already, in {}", name, line_of(graph_.find(name)->place)));
        }
        graph_.components.push_back({type->name, name, {}, place(column)});
    }

    void read_key() {
        const std::size_t begin = line_.find_first_not_of(" \t");
        const std::string name = words_of(line_, " \t").front();
        if (skips_keys_) return;
        if (graph_.components.empty()) {
            return mistake(begin, "a key belongs to a component, which stands above it without blanks in front");
        }
        Component& component = graph_.components.back();
        const ComponentType* type = find_type(component.type);
        const Key* key = type->find(name);
        if (!key) {
            std::vector<std::string> names;
            for (const Key& each : type->keys) names.push_back(each.name);
            return mistake(begin, fmt::format("{} has no key '{}'; its keys are {}{}", type->name, name,
                                              fmt::join(names, ", "), did_you_mean(name, names)));
        }
        if (component.find(name)) return mistake(begin, fmt::format("'{}' is set twice", name));
        const std::size_t column = std::min(line_.find_first_not_of(" \t", begin + name.size()), line_.size());
        Value value;
        value.place = place(column);
        if (!read_value(line_.substr(column), key->kind, value)) return mistake(column, expectation(*key));
        value.columns = columns_of(value, column);
        component.keys.push_back({name, value, place(begin)});
    }

    /// Columns of the parts, the function and the noise of a value, which stand in this order.
    std::vector<int> columns_of(const Value& value, std::size_t from) const {
        std::vector<std::string> texts = value.parts;
        for (const std::string& further : {value.function, value.noise}) {
            if (!further.empty()) texts.push_back(further);
        }
        std::vector<int> columns;
        for (const std::string& text : texts) {
            from = line_.find(text, from);
            columns.push_back(static_cast<int>(from) + 1);
            from += text.size();
        }
        return columns;
    }

    static std::string expectation(const Key& key) {
        switch (key.kind) {
            case KeyKind::word:
                return fmt::format("'{}' is one of {}", key.name, key.unit);
            case KeyKind::literal:
                return fmt::format("'{}' is a whole number", key.name);
            case KeyKind::list:
            case KeyKind::vector:
            case KeyKind::field:
                return fmt::format("'{}' is a list such as {}", key.name, key.standard);
            default:
                return fmt::format("'{}' is a number or a range 'a .. b', and then perhaps 'then f(x)' and 'noise a'",
                                   key.name);
        }
    }

    /// A chain of components with arrows between: a -> b -B-> c.
    void read_links() {
        const std::vector<std::string> words = words_of(line_, " \t");
        std::size_t column = 0;
        for (std::size_t k = 0; k < words.size(); ++k) {
            column = line_.find(words[k], column);
            if (k % 2 == 0) {
                if (words[k].find('>') != std::string::npos) {
                    if (k > 0) graph_.links.pop_back();
                    return mistake(column, "a link is two components with an arrow and blanks between: camera -> stem");
                }
                if (k > 0) graph_.links.back().to = words[k];
                if (k + 1 < words.size()) graph_.links.push_back({words[k], "", LinkKind::child, place(column)});
            } else if (!read_arrow(words[k], column) || k + 1 == words.size()) {
                if (k + 1 == words.size()) mistake(line_.size(), "expected a component behind the arrow");
                graph_.links.pop_back();
                return;
            }
            column += words[k].size();
        }
    }

    bool read_arrow(const std::string& arrow, std::size_t column) {
        if (arrow == "->" || arrow == "-B->" || arrow == "-L->") {
            graph_.links.back().kind = arrow == "->"     ? LinkKind::child
                                       : arrow == "-B->" ? LinkKind::branch
                                                         : LinkKind::leaf;
            return true;
        }
        mistake(column, fmt::format("'{}' is no link; the links are -> (child), -B-> (branch) and -L-> (leaf)", arrow));
        return false;
    }

    void check_settings() {
        try {
            ModelSettings::parse(definitions_.text, files_.back());
        } catch (const UserError& error) {
            for (const Diagnostic& mistake : error.diagnostics()) report(mistake.place, mistake.message);
        }
    }

    void check_links(const std::string& file) {
        if (graph_.components.empty() && mistakes_.empty()) {
            report({file, 1, 1}, "a graph needs a component and a link from the camera to it: camera -> stem");
        }
        std::vector<std::string> names{camera};
        for (const Component& component : graph_.components) names.push_back(component.name);
        for (const Link& link : graph_.links) {
            for (const std::string& name : {link.from, link.to}) {
                if (std::find(names.begin(), names.end(), name) != names.end()) continue;
                report(link.place,
                       fmt::format("there is no component '{}' to link{}", name, did_you_mean(name, names)));
            }
            check_kind(link);
        }
    }

    void check_kind(const Link& link) {
        const Component* from = graph_.find(link.from);
        if (link.to == camera) report(link.place, "no link leads to the camera, which is the root");
        if (link.kind == LinkKind::branch && from && !find_type(from->type)->has_branches) {
            report(link.place, fmt::format("a branch link begins at a Tree, and '{}' is a {}", from->name, from->type));
        }
        if (link.kind != LinkKind::child && link.from == camera) {
            report(link.place, "the links of the camera are child links: ->");
        }
    }

    std::vector<std::string> files_;  // that at hand, behind those that include it
    std::string line_;
    int number_ = 0;
    std::map<std::string, Place> defined_;
    Definitions definitions_;  // definitions of the file at hand
    bool has_version_ = false;
    bool skips_keys_ = false;  // keys of a component that is not known
    Graph graph_;
    std::vector<Diagnostic> mistakes_;
};

}  // namespace

const Value* Component::find(const std::string& key) const {
    for (const KeyValue& each : keys) {
        if (each.key == key) return &each.value;
    }
    return nullptr;
}

const Component* Graph::find(const std::string& name) const {
    for (const Component& component : components) {
        if (component.name == name) return &component;
    }
    return nullptr;
}

Graph parse(const std::string& text, const std::string& name) {
    return Reader().read(text, name);
}

}  // namespace espalier::language::pgraph
