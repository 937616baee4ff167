#include "studio/document/graph_text.h"

#include "base/text.h"
#include "language/pgraph/graph.h"
#include "language/pgraph/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

namespace espalier::studio {
namespace {

namespace pgraph = language::pgraph;
using pgraph::Component;
using pgraph::Graph;
using pgraph::KeyValue;
using pgraph::Link;
using pgraph::LinkKind;

std::string name_of(LinkKind kind) {
    return kind == LinkKind::child ? "child" : kind == LinkKind::branch ? "branch" : "leaf";
}

std::string arrow_of(LinkKind kind) {
    return kind == LinkKind::child ? "->" : kind == LinkKind::branch ? "-B->" : "-L->";
}

std::string name_of(pgraph::KeyKind kind) {
    switch (kind) {
        case pgraph::KeyKind::literal:
            return "whole";
        case pgraph::KeyKind::list:
        case pgraph::KeyKind::vector:
        case pgraph::KeyKind::field:
            return "list";
        case pgraph::KeyKind::word:
            return "word";
        default:
            return "number";  // or a range
    }
}

Nullable<double> bound(double value) {
    return std::isfinite(value) ? Nullable<double>(value) : Nullable<double>();
}

/// A text as lines that keep their numbers while lines are changed, added behind or taken out.
class EditedLines {
public:
    explicit EditedLines(const std::string& text) {
        std::istringstream in(text);
        for (std::string line; std::getline(in, line);) lines_.push_back({line});
    }

    /// Lines count from 1; the replaced line may be none or several.
    std::vector<std::string>& at(int line) { return lines_.at(static_cast<std::size_t>(line) - 1); }
    int last() const { return static_cast<int>(lines_.size()); }
    void append(const std::string& line) { lines_.push_back({line}); }

    std::string text() const {
        std::string text;
        for (const auto& line : lines_) {
            for (const std::string& part : line) text += part + "\n";
        }
        return text;
    }

private:
    std::vector<std::vector<std::string>> lines_;
};

/// Where a comment begins, with the blanks before it; the length of the line if there is none.
std::size_t end_of_words(const std::string& line) {
    std::size_t end = std::min({line.find("//"), line.find("/*"), line.size()});
    while (end > 0 && (line[end - 1] == ' ' || line[end - 1] == '\t' || line[end - 1] == '\r')) --end;
    return end;
}

/// One edit of a graph and its text.
class EditedGraph {
public:
    EditedGraph(const std::filesystem::path& file, const std::string& text)
        : file_(file.string()), graph_(pgraph::parse(text, file_)), lines_(text) {}

    void set(const std::string& name, const std::string& key, const Nullable<std::string>& value) {
        const Component& component = here(name);
        const pgraph::Key* known = pgraph::find_type(component.type)->find(key);
        if (!known) throw UserError(fmt::format("{} has no key '{}'", component.type, key));
        const auto found = std::find_if(component.keys.begin(), component.keys.end(),
                                        [&](const KeyValue& each) { return each.key == key; });
        if (!value) {
            if (found != component.keys.end()) lines_.at(found->place.line).clear();
            return;
        }
        const std::string& text = *value;
        pgraph::Value read;
        if (text.find_first_of("\r\n") != std::string::npos || !pgraph::read_value(text, known->kind, read)) {
            throw UserError(fmt::format("'{}' is no value of {}", text, key));
        }
        if (found == component.keys.end()) {
            lines_.at(end_of(component)).push_back(fmt::format("  {} {}", key, text));
        } else {
            std::string& line = lines_.at(found->place.line).front();
            const auto begin = static_cast<std::size_t>(found->value.place.column) - 1;
            line.replace(begin, std::max(end_of_words(line), begin) - begin, text);
        }
    }

    void add(const std::string& type, const std::string& name, const std::string& from) {
        if (!pgraph::find_type(type)) throw UserError(fmt::format("there is no component '{}'", type));
        if (graph_.find(name)) throw UserError(fmt::format("there is a component '{}' already", name));
        lines_.append("");
        lines_.append(type + " " + name);
        lines_.append("");
        lines_.append(from + " -> " + name);
    }

    void remove(const std::string& name) {
        const Component& component = here(name);
        for (int line = component.place.line; line <= end_of(component); ++line) lines_.at(line).clear();
        std::vector<const Link*> gone;
        for (const Link& link : graph_.links) {
            if (link.from == name || link.to == name) gone.push_back(&link);
        }
        unlink(gone);
    }

    void link(const std::string& from, const std::string& to, const std::string& kind) {
        lines_.append(fmt::format("{} {} {}", from, arrow_of(kind_of(kind)), to));
    }

    void unlink(const std::string& from, const std::string& to, const std::string& kind) {
        const Link wanted{from, to, kind_of(kind)};
        const auto found = std::find(graph_.links.begin(), graph_.links.end(), wanted);
        if (found == graph_.links.end()) throw UserError(fmt::format("no link leads from {} to {}", from, to));
        unlink({&*found});
    }

    std::string text() const {
        std::string text = lines_.text();
        pgraph::parse(text, file_);  // a graph that cannot be read is no edit
        return text;
    }

private:
    const Component& here(const std::string& name) const {
        const Component* component = graph_.find(name);
        if (!component) throw UserError(fmt::format("there is no component '{}'", name));
        if (component->place.file != file_) {
            throw UserError(fmt::format("'{}' stands in {}: open that file", name, component->place.file));
        }
        return *component;
    }

    static int end_of(const Component& component) {
        int line = component.place.line;
        for (const KeyValue& key : component.keys) line = std::max(line, key.place.line);
        return line;
    }

    static LinkKind kind_of(const std::string& kind) {
        for (const LinkKind known : {LinkKind::child, LinkKind::branch, LinkKind::leaf}) {
            if (kind == name_of(known)) return known;
        }
        throw UserError(fmt::format("'{}' is no kind of link: child, branch or leaf", kind));
    }

    // A line may hold a chain of links: what is left of it stands on lines of its own.
    void unlink(const std::vector<const Link*>& gone) {
        for (int line = 1; line <= lines_.last(); ++line) {
            std::vector<const Link*> chain;
            for (const Link& link : graph_.links) {
                if (link.place.line == line && link.place.file == file_) chain.push_back(&link);
            }
            const auto is_gone = [&](const Link* link) {
                return std::find(gone.begin(), gone.end(), link) != gone.end();
            };
            if (std::none_of(chain.begin(), chain.end(), is_gone)) continue;
            std::vector<std::string>& text = lines_.at(line);
            text.clear();
            bool goes_on = false;
            for (const Link* link : chain) {
                if (is_gone(link)) {
                    goes_on = false;
                } else if (std::exchange(goes_on, true)) {
                    text.back() += fmt::format(" {} {}", arrow_of(link->kind), link->to);
                } else {
                    text.push_back(fmt::format("{} {} {}", link->from, arrow_of(link->kind), link->to));
                }
            }
        }
    }

    const std::string file_;
    const Graph graph_;
    EditedLines lines_;
};

// As the file writes it, from the value to the end of its line.
std::string written(const KeyValue& key, const std::vector<std::string>& lines) {
    const std::string& line = lines.at(static_cast<std::size_t>(key.value.place.line) - 1);
    const std::size_t begin = std::min(static_cast<std::size_t>(key.value.place.column) - 1, line.size());
    return line.substr(begin, std::max(end_of_words(line), begin) - begin);
}

}  // namespace

std::optional<ComponentGraph> read_graph(const std::filesystem::path& file, const std::string& text) {
    Graph graph;
    try {
        graph = pgraph::parse(text, file.string());
    } catch (const UserError&) {
        return std::nullopt;
    }
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    ComponentGraph shown{file.string(), {}, {}};
    for (const Component& component : graph.components) {
        GraphComponent& one = shown.components.emplace_back();
        one.name = component.name;
        one.component_type = component.type;
        if (component.place.file != file.string()) continue;
        one.line = component.place.line;
        for (const KeyValue& key : component.keys) one.values[key.key] = written(key, lines);
    }
    for (const Link& link : graph.links) shown.links.push_back({link.from, link.to, name_of(link.kind)});
    return shown;
}

std::vector<ComponentForm> component_forms() {
    std::vector<ComponentForm> forms;
    for (const pgraph::ComponentType& type : pgraph::component_types()) {
        ComponentForm& form = forms.emplace_back();
        form.name = type.name;
        form.summary = type.summary;
        for (const pgraph::Key& key : type.keys) {
            form.keys.push_back({key.name, key.summary, key.unit, key.standard, name_of(key.kind), bound(key.lowest),
                                 bound(key.highest)});
        }
    }
    return forms;
}

std::string edited_graph(const std::filesystem::path& file, const std::string& text, const GraphEdit& edit) {
    EditedGraph graph(file, text);
    const auto part = [&](const auto& value, const char* name) {
        if (!value) throw UserError(fmt::format("the edit '{}' needs '{}'", edit.edit, name));
        return *value;
    };
    if (edit.edit == "set") {
        graph.set(part(edit.component, "component"), part(edit.key, "key"), part(edit.text, "text"));
    } else if (edit.edit == "add") {
        graph.add(part(edit.component_type, "type"), part(edit.name, "name"), part(edit.from, "from"));
    } else if (edit.edit == "remove") {
        graph.remove(part(edit.component, "component"));
    } else if (edit.edit == "link") {
        graph.link(part(edit.from, "from"), part(edit.to, "to"), part(edit.kind, "kind"));
    } else if (edit.edit == "unlink") {
        graph.unlink(part(edit.from, "from"), part(edit.to, "to"), part(edit.kind, "kind"));
    } else {
        throw UserError(fmt::format("'{}' is no edit of a graph", edit.edit));
    }
    return graph.text();
}

}  // namespace espalier::studio
