#include "espalier/simulation/world.h"
#include "espalier/timeline/timeline.h"

#include "base/json_text.h"
#include "base/text.h"
#include "command.h"
#include "model_library.h"
#include "options.h"
#include "simulation/object/panels.h"
#include "simulation/object/side_file_check.h"
#include "temporary_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct CheckArguments {
    ModelArguments model;  ///< or a side file alone
    KeyValues overrides;   ///< settings of a scene
    bool json = false;
};

void describe_model(const std::shared_ptr<const CompiledModel>& compiled, Findings& findings) {
    const Model& model = source_of(*compiled);
    const LSystem& system = model.main();
    findings.facts.push_back(fmt::format(
        "{}: {} production{}, {} of decomposition, {} of homomorphism; derivation length {}; {}{}{}",
        model.path.string(), system.productions.size(), system.productions.size() == 1 ? "" : "s",
        system.decomposition.productions.size(), system.homomorphism.productions.size(), Derivation(compiled).length(),
        has_order(*compiled) ? "derived by one thread, because its productions assign variables, print or read files"
                             : "derived in parallel",
        uses_random_numbers(*compiled) ? "; uses random numbers" : "",
        model.arithmetic == Arithmetic::cpfg ? "; computes with the arithmetic of cpfg" : ""));
}

// What the models ask and no process of the scene answers.
void note_defaults(const Scene& scene, const Environment& environment, Findings& findings) {
    std::set<const CompiledModel*> seen;
    for (const Plant& plant : scene.plants) {
        if (!seen.insert(plant.model.get()).second) continue;
        const Model& model = source_of(*plant.model);
        for (const std::string& name : environment.answered_by_default(model)) {
            std::vector<std::string> values;
            for (const double value : model.default_answers.at(name)) values.push_back(format_general(value));
            findings.facts.push_back(fmt::format("{}: no process '{}', so queries ?{} are answered its default, {}",
                                                 model.path.string(), name, name, fmt::join(values, ", ")));
        }
    }
}

void review_notes(const SceneNotes& notes, Findings& findings) {
    findings.diagnostics.insert(findings.diagnostics.end(), notes.diagnostics.begin(), notes.diagnostics.end());
    std::vector<std::string> files;
    for (const fs::path& file : notes.files) files.push_back(file.string());
    if (!files.empty()) findings.facts.push_back(fmt::format("side files: {}", fmt::join(files, ", ")));
    for (const std::string& settings : notes.unused)
        findings.facts.push_back(settings + " (read, but they only affect a window)");
}

// Makes everything a run would make, except steps.
void review_scene(const Scene& scene, Findings& findings) {
    const World world(scene);
    const TemporaryFolder folder("check");  // for the recorders to be made in
    const Timeline timeline(folder.path(), scene.timeline, world.last_step());
    timeline.require(world.environment().fields());
    std::set<const CompiledModel*> seen;
    for (const Plant& plant : scene.plants) {
        if (seen.insert(plant.model.get()).second) describe_model(plant.model, findings);
        if (plant.view && seen.size() == 1) review_view(*plant.view, findings);
    }
    std::string processes;
    for (std::size_t i = 0; i < world.environment().size(); ++i)
        processes += (i ? ", " : "") + world.environment().name(i);
    note_defaults(scene, world.environment(), findings);
    review_notes(scene.notes, findings);
    findings.diagnostics.insert(findings.diagnostics.end(), world.warnings().begin(), world.warnings().end());
    const std::string name = scene.path.empty() ? scene.name : scene.path.string();
    findings.facts.push_back(fmt::format("{}: {} plant{}, {} steps, processes: {}", name, scene.plants.size(),
                                         scene.plants.size() == 1 ? "" : "s", world.last_step(),
                                         processes.empty() ? "none" : processes));
}

void review_object(const CheckArguments& arguments, Findings& findings) {
    const ObjectFiles object = object_of(arguments.model);
    if (fs::is_directory(arguments.model.file)) {
        findings.facts.push_back(fmt::format("{}: {}", object.name, taken_files(object)));
    }
    review_scene(scene_of_object(object, {arguments.overrides, {}, {}}), findings);
    for (const std::string& name : unused_files(object)) {
        findings.facts.push_back(name + " is listed, but nothing uses it");
    }
}

Json diagnostics_json(const Findings& findings, Diagnostic::Severity severity) {
    Json list = Json::array();
    for (const Diagnostic& diagnostic : findings.diagnostics) {
        if (diagnostic.severity != severity) continue;
        list.push_back({{"file", diagnostic.place.file},
                        {"line", diagnostic.place.line},
                        {"column", diagnostic.place.column},
                        {"message", diagnostic.message}});
    }
    return list;
}

// What a file says twice, or two plants share, is told once.
void remove_repeated(Findings& findings) {
    std::set<std::string> said;
    std::erase_if(findings.diagnostics,
                  [&](const auto& diagnostic) { return !said.insert(to_string(diagnostic)).second; });
    said.clear();
    std::erase_if(findings.facts, [&](const auto& fact) { return !said.insert(fact).second; });
}

/// Finds the models, scenes and objects below a folder. Who names a folder of everything, such as a home, is told so
/// instead of waiting: all its files would be looked at.
class Collection {
public:
    explicit Collection(const fs::path& folder) : folder_(folder) {}

    /// False for an object, and for what is no folder; true for one that holds several models, or scenes, or folders.
    bool is_one() { return fs::is_directory(folder_) && kind_of(folder_) == Kind::collection; }
    /// Sorted.
    std::vector<fs::path> members() {
        std::vector<fs::path> members;
        add_members(folder_, members);
        std::sort(members.begin(), members.end());
        return members;
    }

private:
    static constexpr std::size_t most_looked_at = 20000;

    enum class Kind { collection, object, other };

    void count(std::size_t entries) {
        looked_at_ += entries;
        if (looked_at_ <= most_looked_at) return;
        throw UserError(fmt::format("more than {} files and folders lie below {}: name the folder of the models",
                                    most_looked_at, folder_.string()));
    }

    // Links are not followed: they may lead round in a circle, or anywhere. What may not be read holds nothing.
    std::vector<fs::directory_entry> entries_of(const fs::path& folder) {
        std::vector<fs::directory_entry> entries;
        std::error_code error;
        for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
            count(1);
            const bool is_hidden = entry->path().filename().string().starts_with('.');
            std::error_code unknown;
            const bool is_linked_folder = entry->is_symlink(unknown) && entry->is_directory(unknown);
            if (!is_hidden && !is_linked_folder) entries.push_back(*entry);
        }
        return entries;
    }

    Kind kind_of(const fs::path& folder) {
        std::error_code unknown;
        if (fs::exists(folder / "specifications", unknown)) return Kind::object;
        std::size_t models = 0, others = 0;
        for (const fs::directory_entry& entry : entries_of(folder)) {
            models += describes_model(entry.path());
            others += entry.is_directory(unknown) || is_scene(entry.path());
        }
        if (models == 1) return Kind::object;
        return models > 1 || others > 0 ? Kind::collection : Kind::other;
    }

    void add_members(const fs::path& folder, std::vector<fs::path>& members) {
        for (const fs::directory_entry& entry : entries_of(folder)) {
            const fs::path& path = entry.path();
            std::error_code unknown;
            if (!entry.is_directory(unknown)) {
                if (describes_model(path) || describes_scene(path)) members.push_back(path);
                continue;
            }
            const Kind kind = kind_of(path);
            if (kind == Kind::object) members.push_back(path);
            if (kind == Kind::collection) add_members(path, members);
        }
    }

    fs::path folder_;
    std::size_t looked_at_ = 0;
};

Findings findings_of(const CheckArguments& arguments);

void add(const UserError& error, Findings& findings) {
    findings.diagnostics.insert(findings.diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
}

// A model or an object grows in spite of mistakes in its panels.
void review_panels(const fs::path& opened, Findings& findings) {
    const fs::path panels = simulation::panel_file_of(opened);
    if (!fs::exists(opened) || !fs::is_regular_file(panels)) return;
    try {
        check_side_file(panels, findings);
    } catch (const UserError& error) {
        add(error, findings);
    }
}

// A model is read with the view file beside it. What is wrong with one file does not keep the others from being read.
void review_collection(Collection& collection, const CheckArguments& arguments, Findings& findings) {
    const std::vector<fs::path> members = collection.members();
    for (const fs::path& member : members) {
        CheckArguments one = arguments;
        one.model.file = member;
        const fs::path view = fs::path(member).replace_extension(".v");
        if (member.extension() == ".l" && fs::is_regular_file(view)) one.model.view = view;
        try {
            Findings of_one = findings_of(one);
            findings.diagnostics.insert(findings.diagnostics.end(), of_one.diagnostics.begin(),
                                        of_one.diagnostics.end());
            findings.facts.insert(findings.facts.end(), of_one.facts.begin(), of_one.facts.end());
        } catch (const UserError& error) {
            add(error, findings);
        }
    }
    findings.facts.push_back(
        fmt::format("{}: {} models, scenes and objects", arguments.model.file.string(), members.size()));
}

Findings findings_of(const CheckArguments& arguments) {
    Findings findings;
    if (Collection collection(arguments.model.file); collection.is_one()) {
        review_collection(collection, arguments, findings);
        remove_repeated(findings);
        return findings;
    }
    if (is_scene(arguments.model.file)) {
        reject_side_files(arguments.model);
        review_scene(read_scene(arguments.model.file, {arguments.overrides, {}, {}}), findings);
    } else if (is_side_file(arguments.model.file)) {
        check_side_file(arguments.model.file, findings);
    } else {
        review_object(arguments, findings);
        review_panels(arguments.model.file, findings);
    }
    remove_repeated(findings);
    return findings;
}

int check(const CheckArguments& arguments) {
    const Findings findings = findings_of(arguments);
    const auto is_error = [](const Diagnostic& diagnostic) {
        return diagnostic.severity == Diagnostic::Severity::error;
    };
    const bool failed = std::any_of(findings.diagnostics.begin(), findings.diagnostics.end(), is_error);
    const int code = failed ? exit_code::user_error : exit_code::done;
    if (arguments.json) {
        Json json = {{"exit", failed ? "failed" : "done"}};
        if (failed) json["code"] = code;
        if (failed) json["message"] = "the files have mistakes";
        json["errors"] = diagnostics_json(findings, Diagnostic::Severity::error);
        json["warnings"] = diagnostics_json(findings, Diagnostic::Severity::warning);
        json["facts"] = findings.facts;
        fmt::print("{}\n", json_text(json));
        return code;
    }
    for (const Diagnostic& diagnostic : findings.diagnostics) {
        fmt::print(is_error(diagnostic) ? stderr : stdout, "{}\n", to_string(diagnostic));
    }
    for (const std::string& fact : findings.facts) fmt::print("{}\n", fact);
    return code;
}

class Check final : public Command {
public:
    explicit Check(CLI::App& program)
        : Command(program, "check", "find mistakes in a model, a scene or a side file"),
          model_(
              app(), "what",
              "a scene (.toml), a model (.l), the folder of an object or of models, or a side file (.v, .a, .e, ...)",
              ModelOptions::Files::reading_and_drawing),
          sets_(app()) {
        add_json_flag("print the findings as JSON");
        app().footer(R"(Mistakes are errors, and the exit code is 1. Warnings report what is legal but looks wrong.
Examples:
  espalier check models/course/02-branching.l
  espalier check models/organs/shoot.l --view models/organs/shoot.v
  espalier check models/organs/shoot.v
  espalier check models/trees              every model of the folder
  espalier check models/language/shoot     every file of the object, and the files that nothing uses)");
    }

    int run() override { return check({model_.arguments(), sets_.overrides(), wants_json()}); }

private:
    ModelOptions model_;
    SetOptions sets_;
};

const RegisteredCommand<Check> check_entry{20};

}  // namespace
}  // namespace espalier::app
