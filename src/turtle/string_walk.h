// Leads a walk along modules: looks each letter up, lets it act, draws pictures in place of modules that have one.
#pragma once

#include "turtle/symbol_table.h"

#include <cassert>

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
    void run(std::size_t begin, std::size_t end, std::size_t at) {
        if (input_.derivation) {
            run<true>(begin, end, at);
        } else {
            run<false>(begin, end, at);
        }
    }
    void finish() { walk_.finish(); }

    Walk& walk() { return walk_; }
    /// Where the walk is; it goes on from what is put there.
    WalkState& state() { return walk_; }
    /// True if as many rows were written as there was room for.
    bool filled_room() const { return walk_.internodes_.full() && walk_.queries_.full(); }

private:
    template <bool with_pictures>
    void run(std::size_t begin, std::size_t end, std::size_t at) {
        const ModuleString& string = input_.string;
        const LetterId* letters = string.letters.data();
        const double* values = string.parameters.data();
        const LetterMeaning* meanings = input_.symbols.levels[0].data();
        if (begin == end) return;
        const LetterMeaning* next = &meanings[letters[begin]];
        for (std::size_t i = begin; i < end && !walk_.stopped; ++i) {
            assert(letters[i] < input_.symbols.levels[0].size());
            const LetterMeaning& meaning = *next;
            // Known before this one acts: then the processor need not wait to know where it goes on.
            if (i + 1 < end) next = &meanings[letters[i + 1]];
            if constexpr (with_pictures) {
                if (const std::size_t replaced = pictured_[letters[i]] ? draw_picture(i, at) : 0) {
                    for (std::size_t k = 0; k < replaced; ++k) at += meanings[letters[i + k]].arity;
                    i += replaced - 1;
                    if (i + 1 < end) next = &meanings[letters[i + 1]];
                    continue;
                }
            }
            if (meaning.level) {
                const SymbolMatch match = input_.symbols.match(string, i);
                if (match.module > i) {
                    i = match.module;
                    if (i + 1 < end) next = &meanings[letters[i + 1]];
                }
                if (match.meaning.action) act(match, letters[i], values, at);
                at += match.meaning.arity;
                continue;
            }
            if (meaning.action) act({i, meaning}, letters[i], values, at);
            at += meaning.arity;
        }
    }

    void act(const SymbolMatch& match, LetterId letter, const double* values, std::size_t at) {
        walk_.module_ = std::uint32_t(match.module);
        walk_.parameters_at_ = at;
        walk_.letter_ = letter;
        match.meaning.action(walk_, {values + at, match.meaning.arity});
    }

    /// Returns how many modules the picture stands for, 0 if there is none.
    std::size_t draw_picture(std::size_t module, std::size_t at) {
        const ModuleString& string = input_.string;
        const bool looks_around = input_.symbols.pictures_look_around;
        if (looks_around && offsets_.empty()) {
            link_branches(string, links_);
            offsets_ = parameter_offsets(string, input_.model.alphabet);
        }
        picture_.clear();
        const std::size_t replaced =
            input_.derivation->picture(string, looks_around ? &offsets_ : nullptr, links_, module, at, picture_);
        if (replaced == 0) return 0;

        walk_.module_ = std::uint32_t(module);
        walk_.parameters_at_ = at;
        walk_.in_picture_ = true;
        const double* values = picture_.parameters.data();
        for (std::size_t i = 0; i < picture_.size() && !walk_.stopped; ++i) {
            const SymbolMatch match = input_.symbols.match(picture_, i);
            i = match.module;
            walk_.letter_ = picture_.letters[i];
            if (match.meaning.action) match.meaning.action(walk_, {values, match.meaning.arity});
            values += match.meaning.arity;
        }
        walk_.in_picture_ = false;
        return replaced;
    }

    WalkInput input_;
    Walk walk_;
    std::vector<char> pictured_;  // by letter
    BranchLinks links_;
    std::vector<std::size_t> offsets_;
    ModuleString picture_;
};

}  // namespace espalier
