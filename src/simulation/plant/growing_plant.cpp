#include "simulation/plant/growing_plant.h"

#include "base/prefetch.h"
#include "simulation/scene/keyframes.h"
#include "simulation/scene/scene_keyframes.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace espalier::simulation {
namespace {

// A column's beginning; what follows the processor asks for itself.
template <class Column>
void prefetch_column(const Column& column) {
    constexpr std::size_t most = 1024;
    prefetch(column.data(), std::min(column.size() * sizeof(column[0]), most));
}

}  // namespace

void round_as_stored(ModuleString& string, Arithmetic arithmetic) {
    if (arithmetic == Arithmetic::double_precision) return;
    for (double& value : string.parameters) value = stored(value, arithmetic);
}

GrowingPlant::GrowingPlant(std::uint32_t plant, const Plant& from, std::shared_ptr<const SymbolTable> symbols,
                           const DerivationSettings& settings)
    : description(&from),
      derivation(from.model, settings),
      number(plant),
      is_plain_(!derivation.has_homomorphism() && from.stages.empty() && !from.in_time && !from.drawing_in_time),
      model_(&source_of(*from.model)),
      symbols_(std::move(symbols)),
      insertions_(from),
      stage_key_(settings.seed, settings.plant, Stream::stage) {
    if (from.in_time) {
        numbers = std::make_unique<lsystem::KeptNumbers>();
        regrowth_ = std::make_unique<DerivationSettings>(settings);
    }
    note_derived();
}

void GrowingPlant::count_births() {
    born = 0;
    births_before = unknown;
    is_numbered = !string->has_lineage();
    if (is_numbered) return;
    const auto step = static_cast<std::uint32_t>(derivation.steps_done());
    born = numbers ? numbers->unknown(*string) : lsystem::births_in(*string, step);
}

void GrowingPlant::number_births() {
    if (is_numbered || births_before == unknown) return;
    if (numbers)
        numbers->number(*string, births_before);
    else if (born > 0)
        lsystem::number_births(*string, static_cast<std::uint32_t>(derivation.steps_done()), births_before);
}

void GrowingPlant::note_derived() {
    modules = string->size();
    length = derivation.length();
    stopped = derivation.stopped();
}

void GrowingPlant::note_received() {
    modules = string->size();
    asks_ = interpretation->asks();
    is_staged_ = false;
}

void GrowingPlant::become_remote() {
    is_local = false;
    memory = {};
    born = 0;
    is_numbered = true;
    free_received();
}

void GrowingPlant::free_received() {
    hold(std::make_shared<const ModuleString>(), std::make_shared<const Interpretation>());
    note_received();
}

void GrowingPlant::hold(std::shared_ptr<const ModuleString> other_string,
                        std::shared_ptr<const Interpretation> other_interpretation) {
    string.release();
    string.hold(std::move(other_string));
    previous_.release();
    keeps_previous_ = false;
    interpretation.release();
    interpretation.hold(std::move(other_interpretation));
    staged_.release();
    is_staged_ = false;
    asks_ = interpretation->asks();
}

void GrowingPlant::set_length(int steps) {
    derivation.set_length(steps);
    note_derived();
}

void GrowingPlant::write_axiom(ModuleString* spare) {
    rewrite(
        [&](const ModuleString&, ModuleString& to) {
            derivation.start(to);
            if (description->in_time) regrow(to);
        },
        spare);
}

void GrowingPlant::derive(ModuleString* spare) {
    if (is_plain_ || !description->in_time) {
        return rewrite([&](const ModuleString& from, ModuleString& to) { derivation.step(from, to); }, spare);
    }
    rewrite(
        [&](const ModuleString& from, ModuleString& to) {
            const ModuleString nothing;
            derivation.step(nothing, to);  // counts the step
            if (regrown_ && description->in_time->is_constant()) {
                to = from;
            } else {
                regrow(to);
            }
        },
        spare);
}

// The seed and the steps are those of every other time, so that an organ keeps its identity and its random numbers.
void GrowingPlant::regrow(ModuleString& to) {
    regrown_ = std::make_unique<Derivation>(description->in_time->at_step(derivation.steps_done()), *regrowth_);
    regrown_->set_lineage(true);
    ModuleString from;
    regrown_->start(to);
    while (regrown_->steps_done() < regrown_->length() && !regrown_->stopped()) {
        std::swap(from, to);
        regrown_->step(from, to);
    }
}

template <class Rewrite>
void GrowingPlant::rewrite(const Rewrite& rewrite, ModuleString* spare) {
    modules_before = modules;
    if (spare && modules <= PlantMemory::most_of_small && !string.is_shared()) {
        // What a large plant left is too much for a small one.
        if (spare->letters.capacity() > 64 + 4 * modules) *spare = {};
        if (std::exchange(keeps_previous_, false)) previous_ = {};
        rewrite(*string, *spare);
        std::swap(*string, *spare);
    } else {
        rewrite(*string, previous_.for_writing());
        std::swap(string, previous_);
        keeps_previous_ = true;
    }
    insertions_.apply(derivation.steps_done(), *string);
    note_derived();
}

void GrowingPlant::interpret(const FieldValues& fields, double time) {
    Interpretation& result = interpretation.for_writing();
    const Derivation* pictures = !is_plain_ && derivation.has_homomorphism() ? &drawing() : nullptr;
    const bool changes = !is_plain_ && description->drawing_in_time;
    const std::shared_ptr<const Drawing> now =
        changes ? description->drawing_in_time->at_step(derivation.steps_done()) : nullptr;
    std::optional<TurtleSettings> turtle_now;
    if (now) {
        turtle_now = now->turtle;
        turtle_now->pose = description->turtle.pose;
    }
    espalier::interpret(model(), *symbols_, *string, turtle_now ? *turtle_now : description->turtle, pictures,
                        {number, &fields}, result);
    asks_ = result.asks();
    has_shown_ = has_shown_ || !result.queries.empty() || !result.geometry.is_empty();
    if (is_plain_ || description->stages.empty()) return;
    Interpretation& staged = staged_.for_writing();
    staged = result;
    StagedPlant plant{staged.geometry, *string, stage_key_, description->turtle.pose.heading, time};
    apply(now ? now->stages : description->stages, plant);
    is_staged_ = true;
}

void GrowingPlant::prefetch_itself() const {
    constexpr std::size_t often_read = 4 * 64;
    prefetch(this, often_read);
}

void GrowingPlant::prefetch_string() const {
    prefetch(&*string, sizeof(ModuleString));
}

void GrowingPlant::prefetch_values() const {
    prefetch(&*string, sizeof(ModuleString));
    prefetch(&*interpretation, sizeof(Interpretation));
    prefetch(&description->turtle, sizeof(TurtleSettings));
}

void GrowingPlant::prefetch_for_derivation() const {
    derivation.prefetch();
    prefetch_column(string->letters);
    prefetch_column(string->parameters);
    prefetch_column(string->births);
}

void GrowingPlant::prefetch_for_interpretation() const {
    prefetch_column(string->letters);
    prefetch_column(string->parameters);
    prefetch_column(interpretation->geometry.internodes);
}

PlantFrame GrowingPlant::frame(std::vector<Quantity> quantities) const {
    return {number,
            description->name,
            &model(),
            string.share(),
            shown().share(),
            std::move(quantities),
            description->palette.get(),
            description->view ? description->view->background.get() : nullptr};
}

}  // namespace espalier::simulation
