// What a derivation remembers between steps.
#pragma once

#include "espalier/lsystem/derivation.h"

#include "expansion.h"
#include "rewriting.h"

#include <atomic>
#include <functional>
#include <memory>

namespace espalier {

/// Draws the pictures of modules, one painter per thread.
struct Painter {
    explicit Painter(const CompiledModel& model)
        : machine(model.machine()), matcher(model, machine), expansion(model.homomorphism, matcher, machine) {}
    Painter(const Painter&) = delete;

    Machine machine;
    Matcher matcher;
    Expansion expansion;
    ModuleStack stack;
    // What the blocks of a picture assign, seed or stop holds for that picture only.
    Variables variables;
    Services services;
};

struct Derivation::State {
    State(std::shared_ptr<const CompiledModel> compiled, DerivationSettings given);

    void reset();
    void run_block(const Program& block, const char* name);
    void follow_length();
    /// Runs what belongs to no module; its draws form one sequence from the beginning of the growth.
    void in_block(const char* name, const std::function<void()>& work);
    RandomKey key(Stream stream) const { return RandomKey(settings.seed, settings.plant, stream, services.salt); }
    void evaluate_axiom(ModuleString& string);
    void find_kept(const ModuleString& from);
    StepInput prepare(const ModuleString& from);
    void warn_of_depth();

    std::shared_ptr<const CompiledModel> model;
    DerivationSettings settings;
    bool lineage;
    Services services;
    Variables variables;
    Machine block_machine;
    RandomDraws block_draws{RandomKey(), 0, 0};
    std::uint32_t step = 0;
    int length = 0;
    Scratch scratch;
    Machines machines;
    mutable tbb::enumerable_thread_specific<std::unique_ptr<Painter>> painters;
    std::atomic<bool> depth_limit{false};
    bool warned_of_depth = false;
};

}  // namespace espalier
