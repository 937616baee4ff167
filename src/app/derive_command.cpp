#include "espalier/language/reader.h"
#include "espalier/lsystem/derivation.h"
#include "espalier/simulation/simulation.h"
#include "espalier/turtle/interpretation.h"

#include "commands.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace espalier {
namespace {

bool has_queries(const Alphabet& alphabet) {
    for (std::size_t symbol = 0; symbol < alphabet.symbol_count(); ++symbol) {
        if (alphabet.symbol_name(static_cast<SymbolId>(symbol)).starts_with('?')) return true;
    }
    return false;
}

// Answers ?P ?H ?L ?U ?Q. Without a scene nobody else answers: those queries keep their parameters.
class TurtleAnswers {
public:
    explicit TurtleAnswers(const Model& model)
        : model_(model), symbols_(symbol_table(model)), asks_(has_queries(model.alphabet)) {}

    void exchange(ModuleString& string, const Derivation& derivation) {
        if (!asks_) return;
        interpret(model_, *symbols_, string, {}, &derivation, {}, interpretation_);
        for (const Query& query : interpretation_.queries) {
            answer_from_turtle(query, Answer(string.parameters.data() + query.parameters_at, query.parameters.size()));
        }
    }

private:
    const Model& model_;
    std::shared_ptr<const SymbolTable> symbols_;
    bool asks_;
    Interpretation interpretation_;
};

ModuleString derive(const CompiledModel& compiled, Derivation derivation, bool before_exchange) {
    TurtleAnswers answers(source_of(compiled));
    ModuleString string, next;
    derivation.start(string);
    // Asked anew after every step: a model may stop, or change its length.
    const auto done = [&] { return derivation.stopped() || derivation.steps_done() >= derivation.length(); };
    if (!done() || !before_exchange) answers.exchange(string, derivation);
    while (!done()) {
        derivation.step(string, next);
        std::swap(string, next);
        if (!done() || !before_exchange) answers.exchange(string, derivation);
    }
    return string;
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

}  // namespace

int derive_command(const DeriveArguments& arguments) {
    const Defines defines(arguments.defines.begin(), arguments.defines.end());
    const auto compiled = compile(read_model(arguments.model, {defines, arguments.quirks}));
    DerivationSettings settings;
    settings.seed = arguments.seed.value_or(0);
    // Old and new string, and the text they are printed as.
    settings.memory = (arguments.memory == 0 ? default_memory() : arguments.memory) / 2;
    Derivation derivation(compiled, settings);
    if (arguments.steps) derivation.set_length(*arguments.steps);

    const ModuleString string = derive(*compiled, std::move(derivation), arguments.before_exchange);
    const Alphabet& alphabet = source_of(*compiled).alphabet;
    if (arguments.format == "counts") {
        write_out(counts_text(string, alphabet));
    } else if (arguments.format == "json") {
        write_out(json_text(string, alphabet));
    } else {
        write_out(to_text(string, alphabet) + "\n");
    }
    return exit_code::done;
}

}  // namespace espalier
