#include "manual_pages.h"

#include "espalier/base/file.h"
#include "espalier/base/registry.h"
#include "espalier/language/notation.h"
#include "espalier/turtle/symbol.h"

#include "markdown_help.h"
#include "model_library.h"
#include "part_kinds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <sstream>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

/// A file that shows a part at work, and how large it is.
struct Example {
    fs::path file;
    std::string text;
};

std::string without_blanks(const std::string& text) {
    std::string kept;
    for (const char c : text) {
        if (c != ' ') kept += c;
    }
    return kept;
}

/// The shortest of the files whose text has it; nothing if none has.
std::optional<Example> shortest(const std::vector<Example>& examples, const std::function<bool(const Example&)>& has) {
    std::optional<Example> found;
    for (const Example& example : examples) {
        if (has(example) && (!found || example.text.size() < found->text.size())) found = example;
    }
    return found;
}

std::optional<Example> shortest_with(const std::vector<Example>& scenes, const std::string& what) {
    return shortest(scenes, [&](const Example& scene) {
        return without_blanks("\n" + scene.text).find(without_blanks(what)) != std::string::npos;
    });
}

std::vector<Example> examples_of(const std::vector<fs::path>& files) {
    std::vector<Example> examples;
    for (const fs::path& file : files) examples.push_back({file, read_text(file)});
    return examples;
}

std::vector<Example> scenes_of(const fs::path& manual) {
    std::vector<Example> scenes = examples_of(scenes_below("environments"));
    for (Example& scene : examples_of(scenes_below(manual))) scenes.push_back(std::move(scene));
    return scenes;
}

/// A hand-written page of the manual.
struct OwnPage {
    fs::path place;  ///< in the manual
    std::string title, text;
};

std::vector<OwnPage> own_pages(const fs::path& manual) {
    std::vector<OwnPage> pages;
    for (const auto& entry : fs::recursive_directory_iterator(manual)) {
        const fs::path place = entry.path().lexically_relative(manual);
        if (place.extension() != ".md" || *place.begin() == "reference" || place == "README.md") continue;
        std::string text = read_text(entry.path());
        if (text.starts_with("# ")) pages.push_back({place, text.substr(2, text.find('\n') - 2), text});
    }
    std::sort(pages.begin(), pages.end(), [](const OwnPage& a, const OwnPage& b) { return a.place < b.place; });
    return pages;
}

/// What pages are made of.
struct Manual {
    fs::path folder;
    std::vector<Example> scenes, models;
    std::vector<OwnPage> pages;
};

std::string list_of_own_pages(const Manual& manual, const fs::path& page) {
    std::vector<std::string> links;
    for (const OwnPage& own : manual.pages) {
        const std::string link = page.lexically_relative(own.place.parent_path()).generic_string();
        if (own.text.find("](" + link) == std::string::npos) continue;
        links.push_back(
            fmt::format("[{}]({})", own.title, own.place.lexically_relative(page.parent_path()).generic_string()));
    }
    return links.empty() ? "" : fmt::format("More: {}.\n\n", fmt::join(links, "; "));
}

std::string example_section(const Manual& manual, const std::string& what, const std::optional<Example>& example,
                            const fs::path& from, const std::string& language) {
    if (!example) return "";
    const std::string name = example->file.generic_string();
    std::string text = example->text;
    if (!text.ends_with('\n')) text += '\n';
    const bool starts_programs = text.find("process = \"external\"") != std::string::npos;
    return fmt::format(
        "## {}\n\n{}[`{}`]({})\n\n```{}\n{}```\n\n<!-- shortened in tests: run --steps 2 -->\n```sh\nespalier run "
        "{}{}\n```\n",
        what, picture_of(manual.folder, picture_name(example->file), example->file.filename().string(), from), name,
        link_from(from, example->file), language, text, name, starts_programs ? " --trust" : "");
}

/// "voxel-shade", what it is, and its help.
std::string head_of(const std::string& title, const std::string& summary, const std::string& rest) {
    return fmt::format("{}\n# {}\n\n{}\n\n{}", made_by, title, markdown_text(summary), rest);
}

// "fields.pvd and ..." begins with the name of a file.
std::string sentence(std::string summary) {
    const std::string word = summary.substr(0, summary.find(' '));
    if (!summary.empty() && word.find('.') == word.npos) summary[0] = static_cast<char>(std::toupper(summary[0]));
    if (!summary.empty() && !summary.ends_with('.')) summary += '.';
    return summary;
}

using ExampleOf = std::function<std::string(const Manual&, const PartDescription&, const fs::path& from)>;

std::string scene_example(const Manual& manual, const std::string& line, const fs::path& from) {
    return example_section(manual, "A small scene", shortest_with(manual.scenes, line), from, "toml");
}

std::string notation_example(const Manual& manual, const PartDescription& part, const fs::path& from) {
    const std::string extension = registered<NotationType>().at(part.name)->extension;
    const auto found =
        shortest(manual.models, [&](const Example& model) { return model.file.extension() == extension; });
    return example_section(manual, "A small model", found, from, "");
}

struct ReferenceKind {
    std::string name;  ///< of the kind in `espalier list`, and of the folder
    std::string title, what;
    ExampleOf example;
};

const std::vector<ReferenceKind>& reference_kinds() {
    static const std::vector<ReferenceKind> all{
        {"processes", "Environment processes", "An environment process: `process = \"{}\"` in `[environment.<name>]`.",
         [](const Manual& manual, const PartDescription& part, const fs::path& from) {
             return scene_example(manual, fmt::format("\nprocess = \"{}\"", part.name), from);
         }},
        {"stages", "Geometry stages", "A geometry stage: `stage = \"{}\"` in `[[plant.stage]]`.",
         [](const Manual& manual, const PartDescription& part, const fs::path& from) {
             return scene_example(manual, fmt::format("stage = \"{}\"", part.name), from);
         }},
        {"recorders", "Recorders", "The recorder `{}`, with its keys in `[timeline]`.",
         [](const Manual& manual, const PartDescription& part, const fs::path& from) {
             return scene_example(manual, fmt::format("\n{} = ", part.name), from);
         }},
        {"notations", "Notations", "The notation `{}`, another way to write a model.", notation_example},
    };
    return all;
}

std::string index_table(const std::string& title, const std::vector<std::vector<std::string>>& rows) {
    return fmt::format("## {}\n\n{}\n", title, markdown_table({"page", "what it tells of"}, rows));
}

std::string part_page(const Manual& manual, const ReferenceKind& kind, const PartDescription& part) {
    const fs::path page = fs::path("reference") / kind.name / (part.name + ".md");
    const std::string what = fmt::format(fmt::runtime(kind.what), part.name);
    return head_of(part.name, sentence(part.summary),
                   what + "\n\n" + list_of_own_pages(manual, page) + markdown_help(part.help) +
                       kind.example(manual, part, page.parent_path()));
}

std::string symbol_table(const SymbolGroup& group) {
    std::vector<std::vector<std::string>> rows;
    for (const std::string& name : group.symbols) {
        const std::string& help = registered<Symbol>().at(name)->help;
        const std::size_t colon = help.find(": ");
        rows.push_back({markdown_code(help.substr(0, colon)), markdown_text(help.substr(colon + 2))});
    }
    return markdown_table({"symbol", "effect"}, rows);
}

std::string symbol_page(const Manual& manual, const SymbolGroup& group) {
    const fs::path page = fs::path("reference/symbols") / (group.name + ".md");
    std::string help;
    std::istringstream in(group.help);
    for (std::string line; std::getline(in, line);) help += markdown_text(line) + "\n\n";
    return head_of(
        group.name, "Symbols of the turtle: " + sentence(group.summary),
        list_of_own_pages(manual, page) +
            picture_of(manual.folder, "symbols-" + group.name, group.summary, page.parent_path()) +
            symbol_table(group) + "\n" + help +
            fmt::format(
                "## A small model\n\n```sh\ncat >{0}.l <<'END'\nlsystem: 1\n{1}\nendlsystem\nEND\nespalier run {0}.l "
                "--output {0}\n```\n",
                group.name, group.example));
}

std::string single_page(const Manual& manual, const std::string& kind) {
    const PartDescription part = find_part_kind(kind)->parts().front();
    const fs::path page = fs::path("reference") / (part.name + ".md");
    const std::string title = kind == "scene" ? "The scene file" : "Solids";
    return head_of(title, sentence(part.summary), list_of_own_pages(manual, page) + markdown_help(part.help));
}

/// Adds the pages of a kind; its part of the index.
std::string add_parts(const Manual& manual, const ReferenceKind& kind, ManualPages& pages) {
    std::vector<std::vector<std::string>> rows;
    for (const PartDescription& part : find_part_kind(kind.name)->parts()) {
        pages[fs::path("reference") / kind.name / (part.name + ".md")] = part_page(manual, kind, part);
        rows.push_back({fmt::format("[{0}]({1}/{0}.md)", part.name, kind.name), markdown_text(part.summary)});
    }
    return index_table(kind.title, rows);
}

std::string add_symbols(const Manual& manual, ManualPages& pages) {
    std::vector<std::vector<std::string>> rows;
    for (const auto& [name, group] : registered<SymbolGroup>()) {
        pages[fs::path("reference/symbols") / (name + ".md")] = symbol_page(manual, *group);
        std::vector<std::string> symbols;
        for (const std::string& symbol : group->symbols)
            symbols.push_back(markdown_code(symbol == "~*" ? "~x" : symbol));
        rows.push_back({fmt::format("[{0}](symbols/{0}.md)", name),
                        fmt::format("{}: {}", group->summary, fmt::join(symbols, " "))});
    }
    return index_table("Symbols of the turtle", rows);
}

}  // namespace

std::string picture_name(const fs::path& file) {
    fs::path path = file;
    std::string name;
    for (const fs::path& part : path.replace_extension()) {
        if (part == "models" || part == "..") continue;
        name += (name.empty() ? "" : "-") + part.string();
    }
    return name;
}

std::string picture_of(const fs::path& manual, const std::string& name, const std::string& title,
                       const fs::path& from) {
    for (const char* folder : {"pictures/gallery", "pictures/reference"}) {
        const fs::path picture = fs::path(folder) / (name + ".png");
        if (!fs::exists(manual / picture)) continue;
        return fmt::format("![{}]({})\n\n", title, picture.lexically_relative(from).generic_string());
    }
    return "";
}

std::string link_from(const fs::path& from, const fs::path& file) {
    return file.lexically_relative("docs" / from).generic_string();
}

ManualPages manual_pages(const fs::path& manual, const fs::path& models) {
    std::vector<fs::path> files;
    for (const PartDescription& model : models_of(model_library(models))) files.push_back(model.name);
    const Manual all{manual, scenes_of(manual), examples_of(files), own_pages(manual)};
    ManualPages pages = model_pages(manual, models);
    std::string index = head_of("Reference", "Every part with its parameters, from the part's own help.", "");
    for (const ReferenceKind& kind : reference_kinds()) index += add_parts(all, kind, pages);
    index += add_symbols(all, pages);
    pages["reference/scene.md"] = single_page(all, "scene");
    pages["reference/shapes.md"] = single_page(all, "shapes");
    pages["reference/README.md"] = index + index_table("Files", {{"[scene](scene.md)", "the keys of a scene file"},
                                                                 {"[shapes](shapes.md)", "the solids of processes"},
                                                                 {"[models](../models.md)", "the library of models"}});
    return pages;
}

}  // namespace espalier::app
