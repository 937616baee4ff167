#include "espalier/simulation/world.h"
#include "espalier/timeline/timeline.h"
#include "espalier/turtle/symbol.h"

#include "commands.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <set>
#include <unistd.h>

namespace espalier {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::vector<std::string> turtle_symbols() {
    std::vector<std::string> names;
    for (const auto& entry : symbols()) names.push_back(entry.first);
    return names;
}

// A folder for the recorders to be made in, and gone afterwards.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "espalier-check-XXXXXX").string();
        if (!mkdtemp(name.data())) throw RunError("cannot make a folder in " + fs::temp_directory_path().string());
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

struct Findings {
    std::vector<Diagnostic> warnings;
    std::vector<std::string> facts;  ///< lines that say what was read
};

void review_model(const std::shared_ptr<const CompiledModel>& compiled, Findings& findings) {
    const Model& model = source_of(*compiled);
    for (Diagnostic& warning : review(model, turtle_symbols())) findings.warnings.push_back(std::move(warning));
    const LSystem& system = model.main();
    findings.facts.push_back(fmt::format(
        "{}: {} production{}, {} of decomposition, {} of homomorphism; derivation length {}; {}{}", model.path.string(),
        system.productions.size(), system.productions.size() == 1 ? "" : "s", system.decomposition.productions.size(),
        system.homomorphism.productions.size(), Derivation(compiled).length(),
        has_order(*compiled) ? "derived in order, because its productions assign globals, print or read files"
                             : "derived in parallel",
        draws_random_numbers(*compiled) ? "; draws random numbers" : ""));
}

// Makes everything a run would make, except steps.
void review_scene(const CheckArguments& arguments, Findings& findings) {
    const Scene scene = read_scene(arguments.file, {arguments.overrides, {}, {}});
    const World world(scene);
    const TemporaryFolder folder;
    const Timeline timeline(folder.path(), scene.timeline, scene.steps);
    std::set<const CompiledModel*> seen;
    for (const PlantDescription& plant : scene.plants) {
        if (seen.insert(plant.model.get()).second) review_model(plant.model, findings);
    }
    std::string processes;
    for (std::size_t i = 0; i < world.environment().size(); ++i)
        processes += (i ? ", " : "") + world.environment().name(i);
    findings.facts.push_back(fmt::format("{}: {} plant{}, {} steps, processes: {}", scene.path.string(),
                                         scene.plants.size(), scene.plants.size() == 1 ? "" : "s", scene.steps,
                                         processes.empty() ? "none" : processes));
}

Json warnings_json(const std::vector<Diagnostic>& warnings) {
    Json list = Json::array();
    for (const Diagnostic& warning : warnings) {
        list.push_back({{"file", warning.place.file},
                        {"line", warning.place.line},
                        {"column", warning.place.column},
                        {"message", warning.message}});
    }
    return list;
}

}  // namespace

int check_command(const CheckArguments& arguments) {
    Findings findings;
    if (arguments.file.extension() == ".toml") {
        review_scene(arguments, findings);
    } else {
        const Defines defines(arguments.defines.begin(), arguments.defines.end());
        const auto compiled = compile(read_model(arguments.file, {defines, arguments.quirks}));
        review_model(compiled, findings);
    }
    if (arguments.json) {
        const Json json = {{"exit", "done"}, {"warnings", warnings_json(findings.warnings)}, {"facts", findings.facts}};
        fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
        return exit_code::done;
    }
    for (const Diagnostic& warning : findings.warnings) fmt::print("{}\n", to_string(warning));
    for (const std::string& fact : findings.facts) fmt::print("{}\n", fact);
    return exit_code::done;
}

}  // namespace espalier
