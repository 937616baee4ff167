#include "espalier/base/file.h"
#include "espalier/base/text.h"
#include "espalier/environment/shape.h"
#include "espalier/simulation/scene.h"
#include "espalier/timeline/recorder.h"
#include "espalier/turtle/symbol.h"

#include "commands.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace espalier {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Parts = std::vector<PartDescription>;

template <class Registry>
Parts parts_of() {
    Parts parts;
    for (const auto& entry : Registry::entries()) parts.push_back(entry.second.description);
    return parts;
}

Parts symbol_parts() {
    Parts parts;
    for (const auto& [name, symbol] : symbols()) parts.push_back({name, symbol->help, ""});
    return parts;
}

// The comment a file begins with, without its marks: a block, or lines of // or #.
std::string leading_comment(const std::string& text) {
    if (text.starts_with("/*")) return text.substr(2, text.find("*/") - 2);
    std::string comment;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line) && (line.starts_with("//") || line.starts_with("#"));) {
        comment += line.substr(std::min(line.find_first_not_of("/#"), line.size())) + "\n";
    }
    return comment;
}

// What a file says of itself. The first line of its comment is the summary.
PartDescription describe_file(const fs::path& file) {
    PartDescription part{file.string(), "", ""};
    std::istringstream in(leading_comment(read_text(file)));
    for (std::string line; std::getline(in, line);) {
        const std::string text = line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
        if (part.summary.empty()) {
            part.summary = text;
        } else {
            part.help += text + "\n";
        }
    }
    return part;
}

Parts file_parts(const fs::path& folder, const std::string& extension) {
    std::vector<fs::path> files;
    if (fs::is_directory(folder)) {
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            if (entry.path().extension() == extension) files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    Parts parts;
    for (const fs::path& file : files) parts.push_back(describe_file(file));
    return parts;
}

struct Kind {
    std::string name;
    std::string summary;
    Parts (*parts)();
};

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all{
        {"processes", "what may surround the plants: [environment.<name>] process = \"...\"",
         parts_of<ProcessRegistry>},
        {"symbols", "what the turtle does with a module", symbol_parts},
        {"recorders", "what a run writes: [timeline]", parts_of<RecorderRegistry>},
        {"models", "models below ./models", [] { return file_parts("models", ".l"); }},
        {"scenes", "scenes below ./environments", [] { return file_parts("environments", ".toml"); }},
        {"scene", "what a scene file may say",
         [] {
             return Parts{{"scene", "the tables of a scene file", scene_help()}};
         }},
        {"shapes", "solids of process `shape`",
         [] {
             return Parts{{"shapes", "how a solid is written", shape_help()}};
         }},
    };
    return all;
}

const Kind* find_kind(const std::string& name) {
    for (const Kind& kind : kinds()) {
        if (kind.name == name) return &kind;
    }
    return nullptr;
}

void print_part(const PartDescription& part) {
    fmt::print("{}\n  {}\n", part.name, part.summary);
    std::istringstream help(part.help);
    for (std::string line; std::getline(help, line);) fmt::print("  {}\n", line);
}

void print_parts(const Parts& parts) {
    std::size_t width = 0;
    for (const PartDescription& part : parts) width = std::max(width, part.name.size());
    for (const PartDescription& part : parts) fmt::print("  {:{}}  {}\n", part.name, width, part.summary);
}

void print_json(const Parts& parts) {
    Json list = Json::array();
    for (const PartDescription& part : parts) {
        list.push_back({{"name", part.name}, {"summary", part.summary}, {"help", part.help}});
    }
    fmt::print("{}\n", list.dump(2, ' ', false, Json::error_handler_t::replace));
}

Parts only(const Parts& parts, const std::string& name, const std::string& kind) {
    std::vector<std::string> names;
    for (const PartDescription& part : parts) {
        const fs::path path(part.name);
        if (part.name == name || path.filename() == name || path.stem() == name) return {part};
        names.push_back(part.name);
    }
    throw UserError(fmt::format("'{}' is none of the {}{}", name, kind, did_you_mean(name, names)));
}

}  // namespace

std::vector<std::string> list_kinds() {
    std::vector<std::string> names;
    for (const Kind& kind : kinds()) names.push_back(kind.name);
    return names;
}

int list_command(const ListArguments& arguments) {
    if (arguments.kind.empty()) {
        Parts overview;
        for (const Kind& kind : kinds()) overview.push_back({kind.name, kind.summary, ""});
        arguments.json ? print_json(overview) : print_parts(overview);
        return exit_code::done;
    }
    const Kind* kind = find_kind(arguments.kind);
    if (!kind) {
        throw UserError(fmt::format("'{}' is none of {}{}", arguments.kind, fmt::join(list_kinds(), ", "),
                                    did_you_mean(arguments.kind, list_kinds())));
    }
    Parts parts = kind->parts();
    if (!arguments.name.empty()) parts = only(parts, arguments.name, arguments.kind);
    if (arguments.json) {
        print_json(parts);
    } else if (parts.size() == 1) {
        print_part(parts.front());
    } else {
        print_parts(parts);
    }
    return exit_code::done;
}

}  // namespace espalier
