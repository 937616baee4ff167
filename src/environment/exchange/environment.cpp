#include "espalier/environment/environment.h"

#include "espalier/base/error.h"

#include "base/reason.h"
#include "base/registered_part.h"
#include "base/text.h"
#include "environment/exchange/answering.h"
#include "environment/exchange/communication.h"
#include "geometry/grid_operations.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <new>
#include <numeric>

namespace espalier::environment {
namespace {

std::string listed(const std::vector<std::string>& names) {
    return names.empty() ? "the scene has no processes" : fmt::format("the scene has: {}", fmt::join(names, ", "));
}

std::string parameters_text(const std::pair<int, int>& arity) {
    if (arity.first == arity.second) return fmt::format("{} parameter{}", arity.first, arity.first == 1 ? "" : "s");
    return fmt::format("{} to {} parameters", arity.first, arity.second);
}

/// Calls visit(module, is_unnamed) for every communication module a model may put into its string. `?E(...)` is two
/// modules, of which the second carries the parameters; `?light(...)` is one.
template <class Visit>
void visit_written_queries(const Model& model, const Visit& visit) {
    const auto visit_modules = [&](const std::vector<ModuleTemplate>& modules) {
        for (std::size_t i = 0; i < modules.size(); ++i) {
            const std::string& symbol = model.alphabet.name(modules[i].letter);
            const bool follows_mark = i > 0 && model.alphabet.name(modules[i - 1].letter) == "?";
            if (follows_mark && symbol == "E") visit(modules[i], true);
            if (symbol.size() > 1 && symbol[0] == '?') visit(modules[i], false);
        }
    };
    const auto visit_productions = [&](const std::vector<Production>& productions) {
        for (const Production& production : productions) visit_modules(production.successor);
    };
    for (const LSystem& system : model.systems) {
        visit_modules(system.axiom);
        visit_productions(system.productions);
        visit_productions(system.decomposition.productions);
    }
}

/// What is wrong is told with the place of the process, if not with a better one.
std::unique_ptr<EnvironmentProcess> made(const ProcessType& type, Settings& settings, const EnvironmentContext& context,
                                         Fields& fields) {
    const auto told = [&](const std::exception& error) {
        return UserError(settings.place(),
                         fmt::format("process '{}' ({}): {}", context.name, type.name, reason_of(error)));
    };
    try {
        return type.make(settings, context, fields);
    } catch (const UserError& error) {
        if (error.diagnostics().empty() || error.diagnostics().front().place.known()) throw;
        throw told(error);
    } catch (const RunError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw told(error);
    }
}

}  // namespace

bool needs_processes(const Model& model) {
    bool needs = std::any_of(model.processes.begin(), model.processes.end(),
                             [&](const std::string& name) { return !model.default_answers.contains(name); });
    visit_written_queries(model, [&](const ModuleTemplate&, bool is_unnamed) { needs = needs || is_unnamed; });
    return needs;
}

Environment::Environment(const std::vector<std::pair<std::string, Settings>>& tables,
                         const EnvironmentContext& context) {
    if (!tables.empty()) open_grid_library();
    for (const auto& [name, table] : tables) {
        Settings settings = table;
        communications_.emplace_back(table);
        EnvironmentContext own = context;
        own.name = name;
        note_memory();
        own.memory -= std::min(own.memory, memory_kept());
        const auto& type = registered_part<ProcessType>(settings, "process", "process");
        processes_.push_back(made(type, settings, own, fields_));
        names_.push_back(name);
        kinds_.push_back(type.name);
        arities_.push_back(processes_.back()->query_arity());
    }
    if (processes_.size() == 1) default_ = 0;
    note_memory();
    batches_.resize(processes_.size());
    asked_.resize(processes_.size());
    answering_ = std::make_unique<Answering>();
}

Environment::~Environment() = default;
Environment::Environment(Environment&&) noexcept = default;
Environment& Environment::operator=(Environment&&) noexcept = default;

Environment::Consultation Environment::consultation() const {
    return {answering_->process, answering_->number};
}

std::optional<std::size_t> Environment::find(const std::string& name) const {
    for (std::size_t process = 0; process < names_.size(); ++process) {
        if (names_[process] == name) return process;
    }
    return std::nullopt;
}

void Environment::set_default(const std::string& name) {
    default_ = find(name);
    if (!default_) {
        throw UserError(fmt::format("the default process '{}' is not in the scene{}; {}", name,
                                    did_you_mean(name, names_), listed(names_)));
    }
}

std::vector<std::string> Environment::answered_by_default(const Model& model) const {
    std::vector<std::string> names;
    for (const auto& [name, answer] : model.default_answers) {
        if (!find(name)) names.push_back(name);
    }
    return names;
}

void Environment::require_answers(const Model& model, const std::string& plant_name) const {
    for (const std::string& name : model.processes) {
        if (find(name) || keeps_unanswered_ || model.default_answers.contains(name)) continue;
        throw UserError(
            fmt::format("plant '{}': model {} declares `environment {};` but the scene has no process of "
                        "that name{}; {}",
                        plant_name, model.name, name, did_you_mean(name, names_), listed(names_)));
    }
    for (const std::string& field : fields_read_by(model)) {
        if (fields_.find(field) || keeps_unanswered_) continue;
        std::vector<std::string> known;
        for (const auto& entry : fields_.all()) known.push_back(entry.first);
        throw UserError(
            fmt::format("plant '{}': model {} reads the field '{}', which no process of the scene has{}; {}",
                        plant_name, model.name, field, did_you_mean(field, known),
                        known.empty() ? "there are no fields" : fmt::format("there are: {}", fmt::join(known, ", "))));
    }
    visit_written_queries(model, [&](const ModuleTemplate& module, bool is_unnamed) {
        if (is_unnamed && routed_) return;  // which process it asks is known only then
        if (is_unnamed && !default_ && !keeps_unanswered_) {
            throw UserError(module.place, fmt::format("plant '{}': model {} asks ?E, but the scene has no default "
                                                      "process; {}",
                                                      plant_name, model.name, listed(names_)));
        }
        const std::string& symbol = model.alphabet.name(module.letter);
        const std::optional<std::size_t> process = is_unnamed ? default_ : find(symbol.substr(1));
        if (!process) return;  // a name the model did not declare is no query
        const int given = model.alphabet.arity(module.letter);
        if (given >= arities_[*process].first && given <= arities_[*process].second) return;
        throw UserError(module.place,
                        fmt::format("plant '{}': model {} gives {} {}, but process '{}' ({}) takes {}", plant_name,
                                    model.name, is_unnamed ? "?E" : symbol, parameters_text({given, given}),
                                    names_[*process], kinds_[*process], parameters_text(arities_[*process])));
    });
}

std::set<std::size_t> Environment::may_ask(const Model& model) const {
    std::set<std::size_t> asked;
    visit_written_queries(model, [&](const ModuleTemplate& module, bool is_unnamed) {
        if (is_unnamed && routed_) {
            for (std::size_t process = 0; process < processes_.size(); ++process) asked.insert(process);
        }
        const auto process = is_unnamed ? default_ : find(model.alphabet.name(module.letter).substr(1));
        if (process) asked.insert(*process);
    });
    return asked;
}

// What a communication changes of a query, and how it is routed, its process does not know.
Spreading Environment::spreading(std::size_t process) const {
    const Spreading spreading = processes_[process]->spreading();
    const bool is_changed = routed_ || communications_[process].changes_queries();
    return spreading == Spreading::reach && is_changed ? Spreading::queries : spreading;
}

void Environment::note_memory() {
    kept_.clear();
    for (const auto& process : processes_) {
        const ProcessMemory memory = process->memory();
        kept_.push_back(memory.grows ? 2 * memory.held : memory.held);
    }
}

std::size_t Environment::memory_kept() const {
    return std::accumulate(kept_.begin(), kept_.end(), std::size_t{0});
}

void Environment::limit_memory(std::size_t bytes) {
    const std::size_t kept = memory_kept();
    for (std::size_t process = 0; process < processes_.size(); ++process) {
        const std::size_t others = kept - kept_[process];
        processes_[process]->limit_memory(bytes - std::min(bytes, others));
    }
}

std::vector<Quantity> Environment::statistics(std::uint32_t plant) const {
    std::vector<Quantity> all;
    for (std::size_t process = 0; process < processes_.size(); ++process) {
        for (Quantity& quantity : processes_[process]->statistics(plant)) {
            all.push_back({names_[process] + "." + quantity.name, quantity.value, std::move(quantity.unit)});
        }
    }
    return all;
}

double Environment::statistic(const std::string& name, std::uint32_t plant) const {
    const std::size_t dot = name.find('.');
    const auto process = find(name.substr(0, dot));
    if (!process || dot == std::string::npos) return std::nan("");
    for (const Quantity& quantity : processes_[*process]->statistics(plant)) {
        if (quantity.name == name.substr(dot + 1)) return quantity.value;
    }
    return std::nan("");
}

std::vector<OrganQuantity> Environment::organ_quantities() const {
    std::vector<OrganQuantity> all;
    for (std::size_t process = 0; process < processes_.size(); ++process) {
        for (OrganQuantity& quantity : processes_[process]->organ_quantities()) {
            quantity.name = names_[process] + "." + quantity.name;
            all.push_back(std::move(quantity));
        }
    }
    return all;
}

std::shared_ptr<const std::vector<float>> Environment::organ_values(const std::string& name,
                                                                    std::uint32_t plant) const {
    const auto process = find(name.substr(0, name.find('.')));
    if (!process || name.find('.') == std::string::npos) return nullptr;
    return processes_[*process]->organ_values(name.substr(name.find('.') + 1), plant);
}

}  // namespace espalier::environment
