#include "espalier/lsystem/derivation.h"
#include "espalier/simulation/simulation.h"
#include "espalier/turtle/interpretation.h"

#include "command.h"
#include "options.h"
#include "simulation/world/insertion.h"
#include "turtle/asking.h"
#include "turtle/terminals.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>

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
};

// Answers ?P ?H ?L ?U ?Q; queries to processes keep their parameters.
class TurtleAnswers {
public:
    explicit TurtleAnswers(const Plant& plant)
        : model_(source_of(*plant.model)),
          turtle_(plant.turtle),
          symbols_(symbol_table(model_)),
          asks_(has_queries(model_.alphabet)) {}

    bool asks() const { return asks_; }

    void exchange(ModuleString& string, const Derivation& derivation) {
        if (!asks_) return;
        interpret(model_, *symbols_, string, turtle_, &derivation, {}, interpretation_);
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

/// Who lets a string grow: a derivation alone, whose turtle answers, or a whole world.
struct Growth {
    std::function<bool()> done;  ///< asked anew after every step: a model may stop, or change its length
    std::function<void()> plant_axiom, derive, exchange;
    std::function<void()> answer_turtle;  ///< of an exchange, only what the turtle answers
};

void grow(const Growth& growth, bool before_exchange) {
    const auto exchange = [&] { growth.done() && before_exchange ? growth.answer_turtle() : growth.exchange(); };
    growth.plant_axiom();
    exchange();
    while (!growth.done()) {
        growth.derive();
        exchange();
    }
}

ModuleString derive_alone(const Scene& scene, const DeriveArguments& arguments, bool before_exchange) {
    const Plant& plant = scene.plants.front();
    DerivationSettings settings;
    settings.seed = scene.seed;
    // Old and new string, and the text they are printed as.
    settings.memory = (arguments.memory == 0 ? default_memory() : arguments.memory) / 2;
    settings.input_folder = folder_with(source_of(*plant.model));
    settings.output_folder = arguments.files;
    Derivation derivation(plant.model, settings);
    const auto limit = [&](const ModuleString& string) {
        derivation.set_memory(settings.memory - std::min(settings.memory, derivation.working_memory(string)));
    };
    derivation.set_length(scene.steps.value_or(derivation.length()));

    TurtleAnswers answers(plant);
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
          [&] { answers.exchange(string, derivation); }, [&] { answers.exchange(string, derivation); }},
         before_exchange);
    return string;
}

ModuleString derive_in_world(const Scene& scene, const DeriveArguments& arguments, bool before_exchange) {
    World world(scene, arguments.memory == 0 ? default_memory() : arguments.memory, arguments.files);
    if (!arguments.quiet) print_warnings(world.warnings());
    grow({[&] { return world.at_end(); }, [&] { world.write_axioms(); }, [&] { world.derive(); },
          [&] {
              world.interpret();
              world.exchange();
          },
          [&] {
              world.interpret();
              world.answer_turtle_queries();
          }},
         before_exchange);
    return world.string(0);
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

std::string json_text(const ModuleString& string, const Alphabet& alphabet) {
    nlohmann::ordered_json modules = nlohmann::ordered_json::array();
    const double* parameter = string.parameters.data();
    for (const LetterId letter : string.letters) {
        const int arity = alphabet.arity(letter);
        modules.push_back(
            {{"symbol", alphabet.name(letter)}, {"parameters", std::vector<double>(parameter, parameter + arity)}});
        parameter += arity;
    }
    const nlohmann::ordered_json json = {{"modules", string.size()}, {"string", std::move(modules)}};
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

int derive(const DeriveArguments& arguments) {
    if (is_scene(arguments.model.file)) {
        throw UserError("derive accepts a model or the folder of an object; use `espalier run` for a scene");
    }
    ObjectFiles object = object_of(arguments.model);
    object.animation.clear();  // the derivation length decides
    const Scene scene = scene_of_object(object, {{}, arguments.steps, arguments.seed});
    if (!arguments.quiet) print_warnings(scene.notes.diagnostics);

    const Plant& plant = scene.plants.front();
    // "environment display: before" makes cpfg, too, answer the last queries.
    const bool before_exchange = arguments.before_exchange && !(plant.view && plant.view->exchanges_first);
    ModuleString string = scene.environment.processes.empty() ? derive_alone(scene, arguments, before_exchange)
                                                              : derive_in_world(scene, arguments, before_exchange);
    const Model& model = source_of(*plant.model);
    if (arguments.without_nonterminals) string = turtle::terminals_of(model, *symbol_table(model), string);
    const Alphabet& alphabet = model.alphabet;
    if (arguments.format == "counts") {
        write_out(counts_text(string, alphabet));
    } else if (arguments.format == "json") {
        write_out(json_text(string, alphabet));
    } else {
        write_out(to_text(string, alphabet) + "\n");
    }
    return exit_code::done;
}

class Derive final : public Command {
public:
    explicit Derive(CLI::App& program)
        : Command(program, "derive", "print the string of a model after a number of steps"),
          model_(app(), "model", "a model (.l), or the folder of an object", ModelOptions::Files::reading_and_drawing),
          growth_(app()) {
        app()
            .add_option("--format", format_, "text (cpfg's notation), counts (per symbol) or json")
            ->check(CLI::IsMember({"text", "counts", "json"}));
        app().add_flag("--before-exchange", before_exchange_,
                       "print the string before the queries of the last step are answered, like cpfg");
        app().add_flag("--without-nonterminals", without_nonterminals_,
                       "delete modules that the turtle does not know and no homomorphism replaces, such as apices");
        app().add_option("--files", files_, "folder for files that the model writes; default: they are discarded");
        app().add_flag("--quiet", quiet_, "print no warnings");
        app().footer(
            R"(The default number of steps is the derivation length, not that of an animation. The turtle answers ?P ?H ?L ?U ?Q, with the
settings of the view file. ?E and named queries keep their parameters, unless an environment file names a process.
Examples:
  espalier derive models/course/02-branching.l --steps 3
  espalier derive models/course/03-parameters.l --format counts
  espalier derive models/organs/shoot.l --view models/organs/shoot.v
  espalier derive models/language/shoot --before-exchange)");
    }

    int run() override {
        return derive({model_.arguments(), growth_.steps(), growth_.seed(), format_, before_exchange_,
                       without_nonterminals_, files_, quiet_, growth_.memory()});
    }

private:
    ModelOptions model_;
    GrowthOptions growth_;
    std::string format_ = "text";
    bool before_exchange_ = false, without_nonterminals_ = false, quiet_ = false;
    std::filesystem::path files_;
};

const RegisteredCommand<Derive> derive_entry{30};

}  // namespace
}  // namespace espalier::app
