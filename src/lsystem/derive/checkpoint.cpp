// A derivation's memory as bytes.
#include "lsystem/derive/derivation_state.h"

namespace espalier::lsystem {
namespace {

constexpr std::uint64_t signature = 0x32'6576'6972'6544;  // "Derive2"

}  // namespace

void Derivation::save(std::ostream& out) const {
    const State& state = *state_;
    put(out, signature);
    put(out, state.step);
    put(out, static_cast<std::int32_t>(state.length));
    put(out, static_cast<std::uint8_t>(state.services.stopped));
    put(out, state.services.salt);
    put(out, state.block_random);
    put_variables(out, state.variables);
    state.sub_systems.save(out);
    state.files.save(out);
}

void Derivation::restore(std::istream& in) {
    State& state = *state_;
    if (get<std::uint64_t>(in) != signature) throw RunError("this is not the checkpoint of a derivation");
    const auto step = get<std::uint32_t>(in);
    const auto length = get<std::int32_t>(in);
    const auto stopped = get<std::uint8_t>(in);
    const auto salt = get<std::uint64_t>(in);
    const auto random = get(in, RandomSamples(RandomKey(), 0, 0));
    Variables variables = state.variables;
    get_variables(in, variables);
    state.sub_systems.restore(in, *state.model);
    state.files.restore(in);
    state.variables = std::move(variables);
    state.step = step;
    state.length = length;
    state.services.stopped = stopped != 0;
    state.services.salt = salt;
    state.block_random = random;
    ++state.generation;
}

}  // namespace espalier::lsystem
