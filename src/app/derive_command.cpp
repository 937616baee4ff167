#include "espalier/lsystem/derivation.h"
#include "espalier/simulation/simulation.h"
#include "espalier/simulation/staged_world.h"
#include "espalier/turtle/interpretation.h"

#include "base/excerpt.h"
#include "base/json_text.h"
#include "base/text.h"
#include "command.h"
#include "lsystem/derive/explanation.h"
#include "options.h"
#include "simulation/object/plain_lines.h"
#include "simulation/run/allowed_memory.h"
#include "simulation/scene/insertion.h"
#include "trust.h"
#include "turtle/asking.h"
#include "turtle/terminals.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <sstream>

namespace espalier::app {
namespace {

struct DeriveArguments {
    ModelArguments model;
    std::optional<int> steps;
    std::optional<std::uint64_t> seed;
    std::string format = "text";
    bool before_exchange = false;
    bool without_nonterminals = false;
    std::filesystem::path files;  ///< where files go that the model writes; empty: nowhere
    bool quiet = false;
    std::size_t memory = 0;
    KeyValues overrides;    ///< settings of a scene
    std::string plant;      ///< its name; empty: the only one
    std::string explained;  ///< a symbol: what became of its modules is told instead; empty: none
    bool trust = false;     ///< the programs that the files name may be started
};

// Answers ?P ?H ?L ?U ?Q; queries to processes are answered the defaults of the model, or keep their parameters.
class AnswersAlone {
public:
    explicit AnswersAlone(const Plant& plant)
        : model_(source_of(*plant.model)),
          turtle_(plant.turtle),
          symbols_(symbol_table(model_)),
          asks_(has_queries(model_.alphabet)) {}

    bool asks() const { return asks_; }
    std::vector<Diagnostic> warnings() const { return warnings_of_ignored(ignored_by_turtle(*symbols_), model_); }

    void answer(ModuleString& string, const Derivation& derivation, bool only_turtle) {
        if (!asks_) return;
        interpret(model_, *symbols_, string, turtle_, &derivation, {}, interpretation_);
        if (!only_turtle) turtle::write_default_answers(model_, interpretation_.queries, string);
        write_turtle_answers(interpretation_, string);
        if (model_.arithmetic == Arithmetic::double_precision) return;
        for (double& value : string.parameters) value = stored(value, model_.arithmetic);
    }

private:
    const Model& model_;
    const TurtleSettings& turtle_;
    std::shared_ptr<const SymbolTable> symbols_;
    bool asks_;
    Interpretation interpretation_;
};

/// Which queries of the last string are answered.
enum class LastAnswers { all, of_turtle, none };

// cpfg answers the others before the next step, if there is one. Its turtle walks the last string to find the view, and
// answers what it meets, unless the view file has a box.
LastAnswers last_answers(const Plant& plant, bool before_exchange) {
    if (!before_exchange || (plant.view && plant.view->exchanges_first)) return LastAnswers::all;
    return plant.view && plant.view->camera.box ? LastAnswers::none : LastAnswers::of_turtle;
}

/// Who lets a string grow: a derivation alone, whose turtle answers, or a whole world.
struct Growth {
    std::function<bool()> done;  ///< asked anew after every step: a model may stop, or change its length
    std::function<void()> plant_axiom, derive, exchange;
    std::function<void()> answer_turtle;  ///< answers only what the turtle answers in an exchange
};

void grow(const Growth& growth, LastAnswers last) {
    const auto exchange = [&] {
        if (last == LastAnswers::all || !growth.done()) return growth.exchange();
        if (last == LastAnswers::of_turtle) growth.answer_turtle();
    };
    growth.plant_axiom();
    exchange();
    while (!growth.done()) {
        growth.derive();
        exchange();
    }
}

ModuleString derive_alone(const Scene& scene, const DeriveArguments& arguments) {
    const Plant& plant = scene.plants.front();
    DerivationSettings settings;
    settings.seed = scene.seed;
    // Old and new string, and the text they are printed as.
    settings.memory = allowed_memory(arguments.memory, arguments.model.file) / 2;
    settings.input_folder = folder_with(source_of(*plant.model));
    settings.output_folder = arguments.files;
    Derivation derivation(plant.model, settings);
    const auto limit = [&](const ModuleString& string) {
        derivation.set_memory(settings.memory - std::min(settings.memory, derivation.working_memory(string)));
    };
    derivation.set_length(scene.steps.value_or(derivation.length()));

    AnswersAlone answers(plant);
    ModuleString string, next;
    const simulation::Insertions insertions(plant);
    grow({[&] { return derivation.stopped() || derivation.steps_done() >= derivation.length(); },
          [&] {
              limit({});
              derivation.start(string);
              insertions.apply(0, string);
          },
          [&] {
              limit(string);
              derivation.step(string, next);
              std::swap(string, next);
              insertions.apply(derivation.steps_done(), string);
          },
          [&] { answers.answer(string, derivation, false); }, [&] { answers.answer(string, derivation, true); }},
         last_answers(plant, arguments.before_exchange));
    print_warnings(answers.warnings(), arguments.quiet);
    return string;
}

/// Makes the last step again, and says which production replaced each module of a symbol.
class Explanation {
public:
    Explanation(const Scene& scene, const Plant& plant, const std::string& symbol)
        : model_(source_of(*plant.model)), plant_(plant) {
        if (plant.in_time) throw UserError("a plant that regrows has no last step to explain");
        const std::optional<SymbolId> found = model_.alphabet.find_symbol(symbol);
        if (!found) throw UserError(fmt::format("--explain: the model {} has no module '{}'", model_.name, symbol));
        symbol_ = *found;
        settings_.seed = scene.seed;
        settings_.plant = *plant.stream;
        settings_.lineage = settings_.one_by_one = true;
        settings_.input_folder = folder_with(model_);
        settings_.printout = std::make_shared<Printout>([](const std::string&) {});
    }

    /// Returns the text of the step that comes next.
    std::string text(const DerivedStep& before, std::size_t number) const {
        const DerivedStep::OfPlant& plant = before.plants.at(number);
        Derivation derivation(plant_.model, settings_);
        std::istringstream memory(plant.memory);
        derivation.restore(memory);
        std::string text;
        std::size_t i = 0, parameters_at = 0;
        for (const ExplainedModule& module : lsystem::explain_step(*plant_.model, derivation, *plant.string, symbol_)) {
            for (; i < module.module; ++i) parameters_at += arity(*plant.string, i);
            ModuleString one;
            one.append(plant.string->letters[i],
                       {plant.string->parameters.data() + parameters_at, arity(*plant.string, i)});
            text += fmt::format("step {}: {}, module {}\n", before.step + 1, to_text(one, model_.alphabet), i);
            text += told(module, plant.string->letters[i]);
        }
        return text.empty()
                   ? fmt::format("step {}: there is no {}\n", before.step + 1, model_.alphabet.symbol_name(symbol_))
                   : text;
    }

private:
    std::size_t arity(const ModuleString& string, std::size_t module) const {
        return static_cast<std::size_t>(model_.alphabet.arity(string.letters[module]));
    }

    std::string told(const ExplainedModule& module, LetterId letter) const {
        if (!module.is_rewritten) {
            const bool has_any = std::any_of(model_.systems.begin(), model_.systems.end(), [&](const LSystem& system) {
                return std::any_of(
                    system.productions.begin(), system.productions.end(),
                    [&](const Production& production) { return production.strict.front().letter == letter; });
            });
            return has_any ? "  it is cut off, or replaced together with a module before it\n"
                           : "  no production begins with it: it stays\n";
        }
        std::string text;
        bool is_replaced = false;
        for (const ExplainedProduction& production : module.productions) {
            is_replaced = is_replaced || production.is_chosen;
            text += fmt::format("  {} {}: {}\n      {}\n", production.is_chosen ? "*" : "-",
                                to_string(production.production->place), reason(production),
                                trimmed(source_line(production.production->place), " \t"));
        }
        return is_replaced ? text : text + "  no production applies: it stays, or is decomposed\n";
    }

    static std::string reason(const ExplainedProduction& production) {
        if (!production.is_tried) return "not tried, because one before it applies";
        switch (production.trial.verdict) {
            case Trial::Verdict::strict:
                return "the modules behind it are others";
            case Trial::Verdict::right_context:
                return "its right context is not there";
            case Trial::Verdict::left_context:
                return "its left context is not there";
            case Trial::Verdict::condition:
                return "its condition is 0";
            case Trial::Verdict::applies:
                break;
        }
        const std::string condition =
            production.production->condition
                ? fmt::format(", its condition is {}", format_general(production.trial.condition))
                : "";
        const std::string chance = production.probability == 1
                                       ? ""
                                       : fmt::format(", of probability {}", format_general(production.probability));
        return (production.is_chosen ? "applied" : "not drawn") + condition + chance;
    }

    const Model& model_;
    const Plant& plant_;
    SymbolId symbol_ = 0;
    DerivationSettings settings_;
};

std::size_t number_of_plant(const World& world, const std::string& name) {
    std::vector<std::string> names;
    for (const Plant& plant : world.scene().plants) names.push_back(plant.name);
    if (name.empty() && names.size() == 1) return 0;
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    constexpr std::size_t most_named = 20;
    const std::size_t others = names.size() - std::min(names.size(), most_named);
    const std::string hint = did_you_mean(name, names);
    names.resize(names.size() - others);
    throw UserError(fmt::format("{}{}: the plants are {}{}; --plant NAME chooses one",
                                name.empty() ? "the scene has several plants" : "no plant is called '" + name + "'",
                                hint, fmt::join(names, ", "), others > 0 ? fmt::format(" and {} others", others) : ""));
}

/// What is printed of a world at its end: the string of a plant, or what the last step did.
struct Derived {
    ModuleString string;
    std::string explanation;
    std::shared_ptr<const CompiledModel> model;
};

Derived derive_in_world(const Scene& scene, const DeriveArguments& arguments) {
    StagedWorld world(scene, allowed_memory(arguments.memory, arguments.model.file), arguments.files);
    print_warnings(world.warnings(), arguments.quiet);
    const std::size_t told = world.warnings().size();
    const std::size_t plant = number_of_plant(world, arguments.plant);
    std::optional<Explanation> explanation;
    if (!arguments.explained.empty()) explanation.emplace(scene, world.scene().plants[plant], arguments.explained);
    std::optional<DerivedStep> before;
    grow({[&] { return world.at_end(); }, [&] { world.write_axioms(); },
          [&] {
              if (explanation) before = world.derived();
              world.derive();
          },
          [&] {
              world.interpret();
              world.exchange();
          },
          [&] {
              world.interpret();
              world.answer_turtle_queries();
          }},
         last_answers(world.scene().plants[plant], arguments.before_exchange));
    const std::vector<Diagnostic>& warnings = world.warnings();
    print_warnings({warnings.begin() + static_cast<std::ptrdiff_t>(told), warnings.end()}, arguments.quiet);
    const auto& model = world.scene().plants[plant].model;
    if (!explanation) return {world.string(plant), "", model};
    return {{}, before ? explanation->text(*before, plant) : "step 0: the axiom is no step of productions\n", model};
}

void write_out(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
        throw RunError("cannot write the string to standard output");
    }
}

// One line per symbol in order of first mention, whatever its number of parameters.
std::string counts_text(const ModuleString& string, const Alphabet& alphabet) {
    std::vector<std::size_t> counts(alphabet.symbol_count());
    for (const LetterId letter : string.letters) ++counts[alphabet.symbol_of(letter)];
    std::string text;
    for (SymbolId symbol = 0; symbol < counts.size(); ++symbol) {
        if (counts[symbol] > 0) text += fmt::format("{} {}\n", alphabet.symbol_name(symbol), counts[symbol]);
    }
    return text + fmt::format("total {}\n", string.size());
}

std::string string_as_json(const ModuleString& string, const Alphabet& alphabet) {
    nlohmann::ordered_json modules = nlohmann::ordered_json::array();
    const double* parameter = string.parameters.data();
    for (const LetterId letter : string.letters) {
        const int arity = alphabet.arity(letter);
        modules.push_back(
            {{"symbol", alphabet.name(letter)}, {"parameters", std::vector<double>(parameter, parameter + arity)}});
        parameter += arity;
    }
    const nlohmann::ordered_json json = {{"modules", string.size()}, {"string", std::move(modules)}};
    return json_text(json, -1) + "\n";
}

Scene scene_of(const DeriveArguments& arguments) {
    const SceneOptions options{arguments.overrides, arguments.steps, arguments.seed};
    if (is_scene(arguments.model.file)) {
        reject_side_files(arguments.model);
        return read_scene(arguments.model.file, options);
    }
    ObjectFiles object = object_of(arguments.model);
    object.animation.clear();  // the derivation length decides
    return scene_of_object(object, options);
}

int derive(const DeriveArguments& arguments) {
    const Scene scene = scene_of(arguments);
    require_trust(programs_of(scene), arguments.trust);
    print_warnings(scene.notes.diagnostics, arguments.quiet);
    const bool is_alone = !is_scene(arguments.model.file) && scene.environment.processes.empty() &&
                          arguments.plant.empty() && arguments.explained.empty();

    Derived derived = is_alone ? Derived{derive_alone(scene, arguments), "", scene.plants.front().model}
                               : derive_in_world(scene, arguments);
    if (!arguments.explained.empty()) {
        write_out(derived.explanation);
        return exit_code::done;
    }
    const Model& model = source_of(*derived.model);
    ModuleString& string = derived.string;
    if (arguments.without_nonterminals) string = turtle::terminals_of(model, *symbol_table(model), string);
    const Alphabet& alphabet = model.alphabet;
    if (arguments.format == "counts") {
        write_out(counts_text(string, alphabet));
    } else if (arguments.format == "json") {
        write_out(string_as_json(string, alphabet));
    } else {
        write_out(to_text(string, alphabet) + "\n");
    }
    return exit_code::done;
}

class Derive final : public Command {
public:
    explicit Derive(CLI::App& program)
        : Command(program, "derive", "print the string of a plant after a number of steps"),
          model_(app(), "what", "a scene (.toml), a model (.l), or the folder of an object",
                 ModelOptions::Files::reading_and_drawing),
          sets_(app()),
          growth_(app()) {
        app()
            .add_option("--format", format_, "text (cpfg's notation), counts (per symbol) or json")
            ->check(CLI::IsMember({"text", "counts", "json"}));
        app().add_option("--plant", plant_, "the name of the plant of a scene; default: the only one");
        app().add_option(
            "--explain", explained_,
            "print which production the last step applied to each module of this symbol, and why the others "
            "did not apply");
        app().add_flag("--before-exchange", before_exchange_,
                       "print the string before the queries of the last step are answered, like cpfg");
        app().add_flag("--without-nonterminals", without_nonterminals_,
                       "delete modules that the turtle does not know and no homomorphism replaces, such as apices");
        app().add_option("--files", files_, "folder for files that the model writes; default: they are discarded");
        app().add_flag("--quiet", quiet_, quiet_growth_help);
        app().footer(
            R"(The default number of steps is the derivation length, not that of an animation. The turtle answers ?P ?H ?L ?U ?Q, with the
settings of the view file. ?E and named queries keep their parameters, unless an environment file or a scene has a process.
Examples:
  espalier derive models/course/02-branching.l --steps 3
  espalier derive models/course/03-parameters.l --format counts
  espalier derive models/organs/shoot.l --view models/organs/shoot.v
  espalier derive models/language/shoot --before-exchange
  espalier derive environments/course-light.toml --steps 3 --explain A)");
    }

    int run() override {
        return derive({model_.arguments(), growth_.steps(), growth_.seed(), format_, before_exchange_,
                       without_nonterminals_, files_, quiet_, growth_.memory(), sets_.overrides(), plant_, explained_,
                       growth_.trust()});
    }

private:
    ModelOptions model_;
    SetOptions sets_;
    GrowthOptions growth_;
    std::string format_ = "text", plant_, explained_;
    bool before_exchange_ = false, without_nonterminals_ = false, quiet_ = false;
    std::filesystem::path files_;
};

const RegisteredCommand<Derive> derive_entry{30};

}  // namespace
}  // namespace espalier::app
