// Homomorphism: the picture of a module, for interpretation. Looking never changes growth.
#include "lsystem/derive/lanes.h"
#include "lsystem/homomorphism/picture_writer.h"

namespace espalier::lsystem {
namespace {

bool has_picture(const CompiledSystem& system, LetterId letter) {
    return system.homomorphism.has(letter) && system.homomorphism.maximum_depth > 0;
}

/// Appends a picture that is always the same but for its values; false if one of them is not finite.
bool lay_out(const CompiledProduction& production, const double* values, ModuleString& picture) {
    const std::size_t first = picture.parameters.size();
    picture.parameters.resize(first + production.parameters);
    const bool finite = write_lanes_exactly(production.lanes, production.parameters, production.strict[0].arity > 0,
                                            values, picture.parameters.data() + first);
    if (!finite) {
        picture.parameters.resize(first);
        return false;
    }
    const LetterId* const letters = production.letters.data();
    picture.letters.insert(picture.letters.end(), letters, letters + production.length);
    return true;
}

}  // namespace

bool Derivation::has_homomorphism() const {
    const auto& systems = state_->model->systems;
    return std::any_of(systems.begin(), systems.end(),
                       [](const auto& system) { return !system->homomorphism.empty(); });
}

bool Derivation::may_have_picture(LetterId letter) const {
    const CompiledModel& model = *state_->model;
    if (!model.nested) return has_picture(model.main(), letter);
    return std::any_of(model.systems.begin(), model.systems.end(),
                       [&](const auto& system) { return has_picture(*system, letter); });
}

std::size_t Derivation::picture(const ModuleString& string, const std::vector<std::size_t>* offsets,
                                const BranchLinks& links, std::size_t module, std::size_t parameters_at,
                                ModuleString& picture) const {
    const LetterId letter = string.letters[module];
    if (!may_have_picture(letter)) return 0;
    State& state = *state_;
    const double* values = string.parameters.data() + parameters_at;
    if (!state.model->nested) {
        const CompiledProduction* simple = state.main.homomorphism.laid_out[letter];
        if (simple && lay_out(*simple, values, picture)) return 1;
    }
    std::shared_ptr<PictureWriter>& writer = state.model->picture_writers.local();
    if (!writer) writer = std::make_shared<PictureWriter>(*state.model);
    writer->work_for(state);
    const Identity identity = string.has_lineage() ? string.identity(module) : mix(module);
    const Subject subject{string,
                          {&string, links.partner.data(), offsets ? offsets->data() : nullptr},
                          {module, parameters_at, letter, values, identity}};
    try {
        return writer->write(subject, picture);
    } catch (const EvaluationError& error) {
        throw RunError(describe(error, state.model->source->alphabet, letter, values, state.step));
    }
}

}  // namespace espalier::lsystem
