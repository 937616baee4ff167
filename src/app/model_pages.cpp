// The pages of models, from the comments they begin with and from their settings.
#include "espalier/base/file.h"
#include "espalier/language/model_settings.h"

#include "manual_pages.h"
#include "markdown_help.h"
#include "model_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

/// The comment of a model: text, then "Source:", "Check:" and "Try:", each with what follows it.
struct ModelComment {
    std::string text, source, check, attempt;
};

std::string without_indent(const std::string& line) {
    return line.substr(std::min(line.find_first_not_of(' '), line.size()));
}

ModelComment comment_of(const PartDescription& model) {
    ModelComment comment;
    std::string* part = &comment.text;
    std::istringstream in(model.help);
    for (std::string line; std::getline(in, line);) {
        line = without_indent(line);
        for (const auto& [label, place] : {std::pair("Source: ", &comment.source), std::pair("Check: ", &comment.check),
                                           std::pair("Try: ", &comment.attempt)}) {
            if (!line.starts_with(label)) continue;
            part = place;
            line = line.substr(std::string(label).size());
        }
        *part += line + (line.empty() || part == &comment.attempt ? "\n" : " ");
    }
    comment.source.resize(comment.source.find_last_not_of(" \n.") + 1);
    return comment;
}

std::string paragraphs(const std::string& text) {
    std::string markdown;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        if (line.find_first_not_of(' ') != line.npos)
            markdown += markdown_text(line.substr(0, line.find_last_not_of(' ') + 1)) + "\n\n";
    }
    return markdown;
}

std::string settings_table(const fs::path& model) {
    std::vector<std::vector<std::string>> rows;
    try {
        const ModelSettings settings = ModelSettings::read(model);
        for (const ModelSetting& setting : settings.list()) {
            rows.push_back({markdown_code(setting.name), markdown_code(setting.text), markdown_text(setting.range()),
                            markdown_text(setting.unit), markdown_text(setting.group), markdown_text(setting.summary)});
        }
    } catch (const UserError&) {
        return "";  // a model with mistakes is told of all the same
    }
    if (rows.empty()) return "";
    return markdown_table({"setting", "default", "range", "unit", "group", "meaning"}, rows) + "\n";
}

/// A line of the comment that is a command, or words that go with it.
std::string attempts(const std::string& text) {
    return text.empty() ? "" : fmt::format("Try:\n\n```\n{}```\n\n", text);
}

struct ModelFolder {
    std::string name;  ///< below the library
    std::vector<PartDescription> models;
};

std::vector<ModelFolder> folders_of(const fs::path& library) {
    std::vector<ModelFolder> folders;
    for (const PartDescription& model : models_of(library)) {
        const std::string name = fs::path(model.name).lexically_relative(library).begin()->string();
        if (folders.empty() || folders.back().name != name) folders.push_back({name, {}});
        folders.back().models.push_back(model);
    }
    return folders;
}

/// The file README.md of a folder, without its title, with links as from the index of models.
std::string words_about(const fs::path& folder) {
    if (!fs::exists(folder / "README.md")) return "";
    const std::string text = read_text(folder / "README.md");
    std::string words = text.starts_with("# ") ? text.substr(std::min(text.find('\n') + 1, text.size())) : text;
    for (std::size_t at = 0; (at = words.find("](", at)) != words.npos;) {
        const std::size_t begin = at += 2, end = words.find(')', begin);
        if (end == words.npos || words.compare(begin, 4, "http") == 0) continue;
        const std::string link = words.substr(begin, end - begin),
                          mark = link.substr(std::min(link.find('#'), link.size()));
        const fs::path file = (folder / link.substr(0, link.size() - mark.size())).lexically_normal();
        words.replace(begin, end - begin, link_from("", file) + mark);
    }
    return words.substr(std::min(words.find_first_not_of('\n'), words.size()));
}

std::string model_section(const fs::path& manual, const PartDescription& model, const fs::path& library,
                          const fs::path& from) {
    const fs::path file = model.name;
    const std::string name =
        file.lexically_relative(library / *file.lexically_relative(library).begin()).generic_string();
    const ModelComment comment = comment_of(model);
    std::string text = fmt::format("## {}\n\n", name) + picture_of(manual, picture_name(file), name, from);
    text +=
        fmt::format("[`{}`]({}): {}\n\n", file.generic_string(), link_from(from, file), markdown_text(model.summary));
    text += paragraphs(comment.text);
    if (!comment.source.empty()) text += "Source: " + paragraphs(comment.source + ".");
    if (!comment.check.empty()) text += "What the test proves: " + paragraphs(comment.check);
    return text + settings_table(file) + attempts(comment.attempt);
}

/// The name that a heading has in links.
std::string anchor(const std::string& heading) {
    std::string name;
    for (const char c : heading) {
        if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
            name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return name;
}

std::string index_of(const ModelFolder& folder, const fs::path& library) {
    std::vector<std::vector<std::string>> rows;
    for (const PartDescription& model : folder.models) {
        const std::string name = fs::path(model.name).lexically_relative(library / folder.name).generic_string();
        rows.push_back({fmt::format("[{}](reference/models/{}.md#{})", name, folder.name, anchor(name)),
                        markdown_text(model.summary), markdown_text(comment_of(model).source)});
    }
    return fmt::format("## {}\n\n{}\n{}\n", folder.name, words_about(library / folder.name),
                       markdown_table({"model", "title", "source"}, rows));
}

}  // namespace

ManualPages model_pages(const fs::path& manual, const fs::path& models) {
    const fs::path library = model_library(models), from = "reference/models";
    ManualPages pages;
    std::string index = fmt::format("{}\n# Models\n\n{}\n", made_by, words_about(library));
    for (const ModelFolder& folder : folders_of(library)) {
        index += index_of(folder, library);
        std::string page =
            fmt::format("{}\n# Models: {}\n\nThe [library](../../models.md#{}) tells what they are about.\n\n", made_by,
                        folder.name, folder.name);
        for (const PartDescription& model : folder.models) page += model_section(manual, model, library, from);
        pages[from / (folder.name + ".md")] = page;
    }
    pages["models.md"] = index;
    return pages;
}

}  // namespace espalier::app
