#include "espalier/language/model_settings.h"

#include "base/text.h"
#include "command.h"
#include "manual_pages.h"
#include "model_library.h"
#include "part_kinds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Parts = std::vector<PartDescription>;

struct ListArguments {
    std::string kind;                ///< "" for everything
    std::string name;                ///< "" for all of a kind
    std::filesystem::path models;    ///< the library of models; empty: where it is usually found
    std::filesystem::path markdown;  ///< a folder for the pages of the manual; empty: none
    bool check = false;
    bool json = false;
};

// Models of different folders may have the same name.
Parts only(const Parts& parts, const std::string& name, const std::string& kind) {
    Parts found;
    std::vector<std::string> names;
    for (const PartDescription& part : parts) {
        const fs::path path(part.name);
        if (part.name == name || path.filename() == name || path.stem() == name) found.push_back(part);
        names.push_back(part.name);
        names.push_back(path.stem().string());
    }
    if (!found.empty()) return found;
    throw UserError(fmt::format("there is no '{}' among the {}{}", name, kind, did_you_mean(name, names)));
}

// Those of the folders of that name, if there are any.
Parts of_folder(const Parts& models, const std::string& name) {
    const fs::path folder = (fs::path(name) / "").parent_path();
    Parts found;
    for (const PartDescription& model : models) {
        const fs::path path = fs::path(model.name).parent_path();
        if (path == folder || std::find(path.begin(), path.end(), folder) != path.end()) found.push_back(model);
    }
    return found;
}

// The library as a newcomer browses it: a heading for each folder, and what its models are about.
void print_folders(const Parts& models) {
    std::size_t width = 0;
    for (const PartDescription& model : models)
        width = std::max(width, fs::path(model.name).filename().string().size());
    std::string folder;
    for (const PartDescription& model : models) {
        const fs::path path(model.name);
        if (path.parent_path().string() != folder || &model == &models.front()) {
            folder = path.parent_path().string();
            fmt::print("{}{}\n", &model == &models.front() ? "" : "\n", folder);
        }
        fmt::print("  {:{}}  {}\n", path.filename().string(), width, model.summary);
    }
}

// A model with mistakes is listed all the same; `espalier check` tells of them.
std::vector<ModelSetting> settings_of(const fs::path& model) {
    try {
        return ModelSettings::read(model).list();
    } catch (const UserError&) {
        return {};
    }
}

void print_settings(const std::vector<ModelSetting>& settings) {
    std::vector<std::vector<std::string>> rows{{"setting", "default", "range", "unit", "meaning"}};
    for (const ModelSetting& setting : settings) {
        rows.push_back({setting.name, setting.text, setting.range(), setting.unit, setting.summary});
    }
    std::vector<std::size_t> widths(rows.front().size(), 0);
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    fmt::print("\n");
    std::string group;
    for (std::size_t r = 0; r < rows.size(); ++r) {
        if (r > 0 && settings[r - 1].group != group) fmt::print("  {}\n", group = settings[r - 1].group);
        fmt::print("    ");
        for (std::size_t i = 0; i + 1 < rows[r].size(); ++i) fmt::print("{:{}}  ", rows[r][i], widths[i]);
        fmt::print("{}\n", rows[r].back());
    }
}

Json json_of(const ModelSetting& setting) {
    const auto end = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
    return {{"name", setting.name},          {"default", setting.value},
            {"lowest", end(setting.lowest)}, {"highest", end(setting.highest)},
            {"whole", setting.whole},        {"unit", setting.unit},
            {"group", setting.group},        {"summary", setting.summary}};
}

void print_models_as_json(const Parts& models) {
    Json list = json_of(models);
    for (std::size_t i = 0; i < models.size(); ++i) {
        list[i]["settings"] = Json::array();
        for (const ModelSetting& setting : settings_of(models[i].name)) list[i]["settings"].push_back(json_of(setting));
    }
    print_json(list);
}

void print_model(const PartDescription& model) {
    print_part(model);
    const std::vector<ModelSetting> settings = settings_of(model.name);
    if (!settings.empty()) print_settings(settings);
}

int list_models(const ListArguments& arguments) {
    const Parts all = models_of(model_library(arguments.models));
    const Parts folder = arguments.name.empty() ? all : of_folder(all, arguments.name);
    const Parts models = folder.empty() ? only(all, arguments.name, arguments.kind) : folder;
    if (arguments.json) {
        print_models_as_json(models);
    } else if (!folder.empty()) {
        print_folders(models);
    } else {
        for (const PartDescription& model : models) print_model(model);
    }
    return exit_code::done;
}

std::vector<std::string> list_kinds() {
    std::vector<std::string> names;
    for (const PartKind& kind : part_kinds()) names.push_back(kind.name);
    return names;
}

int write_pages(const ListArguments& arguments) {
    if (!arguments.kind.empty() || arguments.json)
        throw UserError("--markdown writes the pages of all parts: give it neither a kind nor --json");
    const ManualPages pages = manual_pages(arguments.markdown, arguments.models);
    if (arguments.check) {
        check_manual(pages, arguments.markdown);
    } else {
        write_manual(pages, arguments.markdown);
    }
    fmt::print("{} pages in {}\n", pages.size(), arguments.markdown.string());
    return exit_code::done;
}

int list(const ListArguments& arguments) {
    if (!arguments.markdown.empty()) return write_pages(arguments);
    if (arguments.check) throw UserError("--check compares the pages of --markdown FOLDER; name the folder");
    if (arguments.kind.empty()) {
        Parts overview;
        for (const PartKind& kind : part_kinds()) overview.push_back({kind.name, kind.summary, ""});
        arguments.json ? print_json(json_of(overview)) : print_parts(overview);
        return exit_code::done;
    }
    const PartKind* kind = find_part_kind(arguments.kind);
    if (!kind) {
        throw UserError(fmt::format("there is no kind '{}'; the kinds are {}{}", arguments.kind,
                                    fmt::join(list_kinds(), ", "), did_you_mean(arguments.kind, list_kinds())));
    }
    if (!kind->parts) return list_models(arguments);
    Parts parts = kind->parts();
    if (!arguments.name.empty()) parts = only(parts, arguments.name, arguments.kind);
    if (arguments.json) {
        print_json(json_of(parts));
    } else if (parts.size() == 1) {
        print_part(parts.front());
    } else {
        print_parts(parts);
    }
    return exit_code::done;
}

class List final : public Command {
public:
    explicit List(CLI::App& program)
        : Command(program, "list", "print the documentation of processes, symbols, recorders, models and scenes") {
        app().add_option("kind", kind_, fmt::format("{}", fmt::join(list_kinds(), ", ")));
        app().add_option("name", name_, "one of them; prints its complete documentation");
        app().add_option("--models", models_, "the library of models; default: ./models, or the installed library");
        app().add_option(
            "--markdown", markdown_,
            "write a page for each part and each folder of models below this folder, as the manual has them; "
            "run it where models and environments are");
        app().add_flag("--check", check_,
                       "with --markdown: write nothing, and say which pages are not what the parts say");
        add_json_flag("print as JSON");
        app().footer(
            "Examples:\n  espalier list processes\n  espalier list processes voxel-shade\n  espalier list scene\n"
            "  espalier list models\n  espalier list models trees\n  espalier list models koch");
    }

    int run() override { return list({kind_, name_, models_, markdown_, check_, wants_json()}); }

private:
    std::string kind_, name_;
    std::filesystem::path models_, markdown_;
    bool check_ = false;
};

const RegisteredCommand<List> list_entry{50};

}  // namespace
}  // namespace espalier::app
