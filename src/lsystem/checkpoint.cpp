// A derivation's memory as bytes, in the machine's own byte order: checkpoints do not travel.
#include "derivation_state.h"

#include <istream>
#include <ostream>

namespace espalier {
namespace {

constexpr std::uint64_t signature = 0x31'6576'6972'6544;  // "Derive1"

template <class T>
void put(std::ostream& out, const T& value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
T get(std::istream& in, T value = {}) {
    if (!in.read(reinterpret_cast<char*>(&value), sizeof value)) throw RunError("the checkpoint ends too early");
    return value;
}

void put_values(std::ostream& out, const std::vector<double>& values) {
    put(out, static_cast<std::uint64_t>(values.size()));
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(double)));
}

void get_values(std::istream& in, std::vector<double>& values) {
    if (get<std::uint64_t>(in) != values.size()) throw RunError("the checkpoint belongs to another model");
    const auto bytes = static_cast<std::streamsize>(values.size() * sizeof(double));
    if (!in.read(reinterpret_cast<char*>(values.data()), bytes)) throw RunError("the checkpoint ends too early");
}

}  // namespace

void Derivation::save(std::ostream& out) const {
    const State& state = *state_;
    put(out, signature);
    put(out, state.step);
    put(out, static_cast<std::int32_t>(state.length));
    put(out, static_cast<std::uint8_t>(state.services.stopped));
    put(out, state.services.salt);
    put(out, state.block_draws);
    put_values(out, state.variables.globals);
    put(out, static_cast<std::uint64_t>(state.variables.arrays.size()));
    for (const std::vector<double>& array : state.variables.arrays) put_values(out, array);
}

void Derivation::restore(std::istream& in) {
    State& state = *state_;
    if (get<std::uint64_t>(in) != signature) throw RunError("this is not the checkpoint of a derivation");
    const auto step = get<std::uint32_t>(in);
    const auto length = get<std::int32_t>(in);
    const auto stopped = get<std::uint8_t>(in);
    const auto salt = get<std::uint64_t>(in);
    const auto draws = get(in, RandomDraws(RandomKey(), 0, 0));
    Variables variables = state.variables;
    get_values(in, variables.globals);
    if (get<std::uint64_t>(in) != variables.arrays.size()) throw RunError("the checkpoint belongs to another model");
    for (std::vector<double>& array : variables.arrays) get_values(in, array);
    state.variables = std::move(variables);
    state.step = step;
    state.length = length;
    state.services.stopped = stopped != 0;
    state.services.salt = salt;
    state.block_draws = draws;
}

}  // namespace espalier
