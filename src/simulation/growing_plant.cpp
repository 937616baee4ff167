#include "growing_plant.h"

#include "espalier/base/prefetch.h"

#include <algorithm>
#include <utility>

namespace espalier {
namespace {

// A column's beginning; what follows the processor asks for itself.
template <class Column>
void prefetch_column(const Column& column) {
    constexpr std::size_t most = 1024;
    prefetch(column.data(), std::min(column.size() * sizeof(column[0]), most));
}

}  // namespace

GrowingPlant::GrowingPlant(std::uint32_t plant, const Plant& from, std::shared_ptr<const SymbolTable> symbols,
                           const DerivationSettings& settings)
    : number(plant), description(&from), derivation(from.model, settings), symbols_(std::move(symbols)) {
    note_end();
}

void GrowingPlant::note_end() {
    length = derivation.length();
    stopped = derivation.stopped();
}

void GrowingPlant::set_length(int steps) {
    derivation.set_length(steps);
    note_end();
}

void GrowingPlant::write_axiom() {
    derivation.start(string.for_writing());
    note_end();
}

void GrowingPlant::derive() {
    derivation.step(*string, previous_.for_writing());
    std::swap(string, previous_);
    note_end();
}

void GrowingPlant::interpret() {
    Interpretation& result = interpretation.for_writing();
    const Derivation* pictures = derivation.has_homomorphism() ? &derivation : nullptr;
    espalier::interpret(model(), *symbols_, *string, description->turtle, pictures, {number}, result);
    asks_ = result.asks();
}

void GrowingPlant::prefetch_values() const {
    prefetch(&*string, sizeof(ModuleString));
    prefetch(&*previous_, sizeof(ModuleString));
    prefetch(&*interpretation, sizeof(Interpretation));
    prefetch(description, sizeof(Plant));
}

void GrowingPlant::prefetch_columns() const {
    derivation.prefetch();
    for (const ModuleString* modules : {&*string, &*previous_}) {
        prefetch_column(modules->letters);
        prefetch_column(modules->parameters);
        prefetch_column(modules->identities);
        prefetch_column(modules->parents);
        prefetch_column(modules->births);
    }
    prefetch_column(interpretation->geometry.internodes);
}

PlantFrame GrowingPlant::frame(std::vector<Quantity> quantities) const {
    return {number,
            description->name,
            &model(),
            string.share(),
            interpretation.share(),
            std::move(quantities),
            description->palette.get()};
}

}  // namespace espalier
