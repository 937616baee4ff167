// Leads a walk along modules: looks each letter up, lets it act, draws pictures in place of modules that have one.
#pragma once

#include "turtle/symbol_table.h"

namespace espalier {

/// Whose string is walked along.
struct WalkInput {
    const Model& model;
    const SymbolTable& symbols;
    const ModuleString& string;
    const TurtleSettings& settings;
    const Derivation* derivation;  ///< null where no module has a picture
    std::uint32_t plant;
};

/// Modules that neither act nor have a picture cost one look-up.
class StringWalk {
public:
    StringWalk(const WalkInput& input, Interpretation& result, const Walk::Room* room = nullptr)
        : input_(input), walk_(input.model, input.string, input.settings, input.plant, result, room) {
        walk_.processes_ = &input.symbols.processes;
        if (!input.derivation) return;
        pictured_.resize(input.model.alphabet.size());
        for (std::size_t letter = 0; letter < pictured_.size(); ++letter) {
            pictured_[letter] = input.derivation->may_have_picture(LetterId(letter));
        }
    }

    /// Walks from module `begin`, whose parameters begin at `at`, to module `end`.
    void run(std::size_t begin, std::size_t end, std::size_t at);
    void finish() { walk_.finish(); }

    Walk& walk() { return walk_; }
    /// Where the walk is; it goes on from what is put there.
    WalkState& state() { return walk_; }
    /// True if as many rows were written as there was room for.
    bool filled_room() const { return walk_.internodes_.full() && walk_.queries_.full(); }

private:
    template <bool with_pictures>
    void run_along(std::size_t begin, std::size_t end, std::size_t at);
    void act(std::size_t module, LetterId letter, const LetterMeaning& meaning, std::size_t at) {
        walk_.module_ = std::uint32_t(module);
        walk_.parameters_at_ = at;
        walk_.letter_ = letter;
        meaning.action(walk_, {input_.string.parameters.data() + at, meaning.arity});
    }
    /// Returns how many modules the picture stands for, 0 if there is none.
    std::size_t draw_picture(std::size_t module, std::size_t at);

    WalkInput input_;
    Walk walk_;
    std::vector<char> pictured_;  // by letter
    BranchLinks links_;
    std::vector<std::size_t> offsets_;
    ModuleString picture_;
};

}  // namespace espalier
