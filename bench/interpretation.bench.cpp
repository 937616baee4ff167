// Interpretation of two plants beside a turtle written for their symbols and beside a bare scan of their columns, and
// what questions at every apex add to a step.
#include "espalier/turtle/interpretation.h"

#include "espalier/environment/environment.h"

#include "growing.h"

#include <glm/common.hpp>

namespace espalier::bench {
namespace {

using namespace test;

constexpr int steps = 16, bare_steps = 8, bush_steps = 13;

/// A plant after so many steps.
struct Grown {
    Grown(void (*make)(ModelBuilder&), int grown_steps) {
        make(model);
        compiled = model.compiled();
        derivation.emplace(compiled);
        string = grow(*derivation, grown_steps);
        symbols = symbol_table(model.model());
    }

    ModelBuilder model;
    std::shared_ptr<const CompiledModel> compiled;
    std::optional<Derivation> derivation;
    std::shared_ptr<const SymbolTable> symbols;
    ModuleString string;
    TurtleSettings settings;
    Interpretation interpretation;
};

/// Honda's tree with ?P(0, 0, 0) behind every apex, of branches, too.
void make_asking_honda(ModelBuilder& model) {
    make_honda(model);
    for (Production& production : model.system().productions) {
        std::vector<ModuleTemplate> asking;
        for (ModuleTemplate& module : production.successor) {
            const bool apex = std::string("ABC").find(model.model().alphabet.name(module.letter)) != std::string::npos;
            asking.push_back(std::move(module));
            if (!apex) continue;
            asking.push_back(model.module("?", {}));
            asking.push_back(model.module("P", {number(0), number(0), number(0)}));
        }
        production.successor = std::move(asking);
    }
    model.rule(std::vector<Pattern>{{"?", 0}, {"P", 3}}, {});
}

/// The tree of 2^16 apices.
struct Tree : Grown {
    explicit Tree(bool asks = false) : Grown(asks ? make_asking_honda : make_honda, steps) {}
};

void interpret_again(benchmark::State& state, Grown& grown) {
    const tbb::global_control control = threads(state);
    for (auto _ : state) {
        interpret(grown.model.model(), *grown.symbols, grown.string, grown.settings, nullptr, {}, grown.interpretation);
        benchmark::DoNotOptimize(grown.interpretation.geometry.bounds);
    }
    state.SetItemsProcessed(state.iterations() * std::int64_t(grown.string.size()));
}

void interpretation(benchmark::State& state) {
    Tree tree;
    interpret_again(state, tree);
}
BENCHMARK(interpretation)->Arg(1)->Arg(2)->UseRealTime();

void bare_interpretation(benchmark::State& state) {
    Grown plant(make_bare_plant, bare_steps);
    interpret_again(state, plant);
}
BENCHMARK(bare_interpretation)->Arg(1)->UseRealTime();

/// A bush of which each branch has an angle of its own.
struct Bush : Grown {
    Bush() : Grown([](ModelBuilder& model) { make_bush(model, false); }, bush_steps) {}
};

void interpretation_of_angles(benchmark::State& state) {
    Bush bush;
    interpret_again(state, bush);
}
BENCHMARK(interpretation_of_angles)->Arg(1)->UseRealTime();

/// The same with one angle for all.
void interpretation_of_one_angle(benchmark::State& state) {
    Bush bush;
    const Alphabet& alphabet = bush.model.model().alphabet;
    double* values = bush.string.parameters.data();
    for (const LetterId letter : bush.string.letters) {
        if (alphabet.name(letter) == "+") *values = 30;
        values += alphabet.arities()[letter];
    }
    interpret_again(state, bush);
}
BENCHMARK(interpretation_of_one_angle)->Arg(1)->UseRealTime();

/// A turtle that knows F ! + - & / [ ] and nothing else, written by hand into the rows that an interpretation has.
class PlainTurtle {
public:
    explicit PlainTurtle(Grown& grown) : string_(grown.string), geometry_(grown.interpretation.geometry), stack_(256) {
        const Alphabet& alphabet = grown.model.model().alphabet;
        arities_.assign(alphabet.arities().begin(), alphabet.arities().end());
        for (std::size_t letter = 0; letter < arities_.size(); ++letter) {
            symbols_.push_back(alphabet.name(LetterId(letter))[0]);
        }
    }

    void walk() {
        turtle_ = stack_.data();
        *turtle_ = {};
        geometry_.bounds = {};
        geometry_.axes = 0;
        geometry_.internodes.resize(geometry_.internodes.capacity());
        rows_ = 0;
        const double* values = string_.parameters.data();
        for (std::size_t i = 0; i < string_.size(); ++i) {
            const int arity = arities_[string_.letters[i]];
            act(i, arity, values);
            values += arity;
        }
        geometry_.internodes.resize(rows_);
    }

private:
    void act(std::size_t module, int arity, const double* values) {
        switch (symbols_[string_.letters[module]]) {
            case 'F':
                draw(module, arity > 0 ? *values : 1);
                break;
            case '!':
                turtle_->width = *values;
                break;
            case '+':
                turn_left(turtle_->pose, rotation(arity, values));
                break;
            case '-':
                turn_left(turtle_->pose, rotation(arity, values).inverse());
                break;
            case '&':
                pitch_down(turtle_->pose, rotation(arity, values));
                break;
            case '/':
                roll_left(turtle_->pose, rotation(arity, values));
                break;
            case '[':
                turtle_[1] = turtle_[0];
                ++(++turtle_)->order;
                turtle_->on_axis = false;
                break;
            case ']':
                --turtle_;
                break;
            default:
                break;
        }
    }
    void draw(std::size_t module, double length) {
        if (rows_ == geometry_.internodes.size()) geometry_.internodes.resize(2 * rows_ + 16);
        const double radius = turtle_->width / 2;
        if (!turtle_->on_axis) {
            turtle_->axis = geometry_.axes++;
            turtle_->node_radius = radius;
            turtle_->on_axis = true;
        }
        const glm::dvec3 base = turtle_->pose.position;
        const glm::dvec3 tip = turtle_->pose.position += turtle_->pose.heading * length;
        geometry_.internodes[rows_++] = {std::uint32_t(module), turtle_->axis, turtle_->order, 128, 0, base, tip,
                                         turtle_->node_radius,  radius};
        turtle_->node_radius = radius;
        geometry_.bounds.lower = glm::min(geometry_.bounds.lower, tip - radius);
        geometry_.bounds.upper = glm::max(geometry_.bounds.upper, tip + radius);
    }
    Rotation rotation(int arity, const double* values) {
        if (arity == 0) return default_;
        if (*values == last_degrees_) return last_;
        last_degrees_ = *values;
        return last_ = rotation_of_degrees(*values);
    }

    const ModuleString& string_;
    PlantGeometry& geometry_;
    std::vector<std::uint16_t> arities_;
    std::vector<char> symbols_;
    std::vector<TurtleState> stack_;
    TurtleState* turtle_ = nullptr;
    std::size_t rows_ = 0;
    Rotation default_ = rotation_of_degrees(45), last_;
    double last_degrees_ = 0;
};

void walk_plainly(benchmark::State& state, Grown& grown) {
    PlainTurtle turtle(grown);
    for (auto _ : state) {
        turtle.walk();
        benchmark::DoNotOptimize(grown.interpretation.geometry.bounds);
    }
    state.SetItemsProcessed(state.iterations() * std::int64_t(grown.string.size()));
}

void plain_turtle(benchmark::State& state) {
    Tree tree;
    walk_plainly(state, tree);
}
BENCHMARK(plain_turtle)->UseRealTime();

void bare_plain_turtle(benchmark::State& state) {
    Grown plant(make_bare_plant, bare_steps);
    walk_plainly(state, plant);
}
BENCHMARK(bare_plain_turtle)->UseRealTime();

void plain_turtle_of_angles(benchmark::State& state) {
    Bush bush;
    walk_plainly(state, bush);
}
BENCHMARK(plain_turtle_of_angles)->UseRealTime();

void bare_scan(benchmark::State& state) {
    Tree tree;
    const auto arities = tree.model.model().alphabet.arities();
    for (auto _ : state) {
        const double* value = tree.string.parameters.data();
        double sum = 0;
        for (const LetterId letter : tree.string.letters) {
            for (const double* end = value + arities[letter]; value != end; ++value) sum += *value;
        }
        benchmark::DoNotOptimize(sum);
    }
    state.SetItemsProcessed(state.iterations() * std::int64_t(tree.string.size()));
}
BENCHMARK(bare_scan)->UseRealTime();

/// One whole step: derive, interpret, exchange.
void step_of(benchmark::State& state, bool asks) {
    Tree tree(asks);
    Environment environment({}, {});
    ModuleString next;
    for (auto _ : state) {
        state.PauseTiming();
        tree.derivation.emplace(tree.compiled);
        tree.string = grow(*tree.derivation, steps - 1);
        state.ResumeTiming();
        tree.derivation->step(tree.string, next);
        interpret(tree.model.model(), *tree.symbols, next, tree.settings, nullptr, {}, tree.interpretation);
        const PlantView view{0, &tree.model.model(), &next, &tree.interpretation};
        ModuleString* strings[] = {&next};
        environment.exchange({steps, steps, 1, {&view, 1}}, strings);
    }
}

void step_with_questions(benchmark::State& state) {
    step_of(state, true);
}
BENCHMARK(step_with_questions)->UseRealTime();

void step_without_questions(benchmark::State& state) {
    step_of(state, false);
}
BENCHMARK(step_without_questions)->UseRealTime();

using Measure = Row::Measure;
using Goal = Row::Goal;
const Row walk{"interpretation, against a bare scan of the columns",
               "interpretation/1/real_time",
               "bare_scan/real_time",
               Measure::rate,
               Goal::at_least,
               0.15};
const Row against_plain{"interpretation, against a turtle written for the tree's symbols",
                        "interpretation/1/real_time",
                        "plain_turtle/real_time",
                        Measure::rate,
                        Goal::at_least,
                        0.8};
const Row bare_against_plain{"interpretation of a bare D0L plant, against a turtle written for its symbols",
                             "bare_interpretation/1/real_time",
                             "bare_plain_turtle/real_time",
                             Measure::rate,
                             Goal::at_least,
                             0.8};
const Row angles{"interpretation of a bush with an angle for each branch, against a turtle written for its symbols",
                 "interpretation_of_angles/1/real_time",
                 "plain_turtle_of_angles/real_time",
                 Measure::rate,
                 Goal::at_least,
                 0.8};
const Row many_angles{"interpretation of a bush with an angle for each branch, against one angle for all",
                      "interpretation_of_angles/1/real_time",
                      "interpretation_of_one_angle/1/real_time",
                      Measure::time,
                      Goal::at_most,
                      2.0};
const Row walk_2{"interpretation with 2 threads, against one",
                 "interpretation/2/real_time",
                 "interpretation/1/real_time",
                 Measure::speedup,
                 Goal::at_least,
                 1.7};
const Row questions{"step with a question at each of 65,536 apices, against none",
                    "step_with_questions/real_time",
                    "step_without_questions/real_time",
                    Measure::time,
                    Goal::at_most,
                    1.5};

}  // namespace
}  // namespace espalier::bench
