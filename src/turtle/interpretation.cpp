// The walk over a string: look each letter up, let it act, draw pictures in place of modules that have one.
#include "espalier/turtle/interpretation.h"

#include "turtle/symbol_table.h"

#include <cassert>

namespace espalier {

/// Drives one walk. Modules that neither act nor have a picture cost one look-up.
class StringWalk {
public:
    StringWalk(const Model& model, const SymbolTable& symbols, const ModuleString& string,
               const TurtleSettings& settings, const Derivation* derivation, std::uint32_t plant,
               Interpretation& result)
        : model_(model),
          symbols_(symbols),
          string_(string),
          derivation_(derivation && derivation->has_homomorphism() ? derivation : nullptr),
          walk_(model, string, settings, plant, result) {
        walk_.processes_ = &symbols.processes;
        if (!derivation_) return;
        pictured_.resize(model.alphabet.size());
        for (std::size_t letter = 0; letter < pictured_.size(); ++letter) {
            pictured_[letter] = derivation_->may_have_picture(LetterId(letter));
        }
    }

    void run() {
        if (derivation_) {
            walk_string<true>();
        } else {
            walk_string<false>();
        }
        walk_.finish();
    }

private:
    /// A symbol found in a string: its last module, where that one's parameters begin, and what it does.
    struct Match {
        std::size_t module;
        LetterMeaning meaning;
    };

    template <bool with_pictures>
    void walk_string() {
        const std::vector<LetterMeaning>& meanings = symbols_.levels[0];
        const std::size_t size = string_.size();
        std::size_t at = 0;
        for (std::size_t i = 0; i < size && !walk_.stopped; ++i) {
            const LetterId letter = string_.letters[i];
            assert(letter < meanings.size());
            const LetterMeaning& meaning = meanings[letter];
            if constexpr (with_pictures) {
                if (const std::size_t replaced = pictured_[letter] ? draw_picture(i, at) : 0) {
                    i += replaced - 1;
                    at = offsets_[i + 1];
                    continue;
                }
            }
            if (meaning.level) {
                const Match match = find_symbol(string_, i);
                i = match.module;
                act(match, string_, at);
                at += match.meaning.arity;
                continue;
            }
            if (meaning.action) act({i, meaning}, string_, at);
            at += meaning.arity;
        }
    }

    /// The longest symbol that begins at module i. Only its last module may have parameters.
    Match find_symbol(const ModuleString& string, std::size_t i) const {
        Match match{i, symbols_.levels[0][string.letters[i]]};
        while (match.meaning.level && match.module + 1 < string.size()) {
            const LetterMeaning& next = symbols_.levels[match.meaning.level][string.letters[match.module + 1]];
            if (!next.belongs) break;
            match = {match.module + 1, next};
        }
        return match;
    }

    void act(const Match& match, const ModuleString& string, std::size_t at) {
        if (!match.meaning.action) return;
        if (!walk_.in_picture_) {
            walk_.module_ = std::uint32_t(match.module);
            walk_.parameters_at_ = at;
        }
        walk_.letter_ = string.letters[match.module];
        match.meaning.action(walk_, {string.parameters.data() + at, match.meaning.arity});
    }

    /// Returns how many modules the picture stands for, 0 if there is none.
    std::size_t draw_picture(std::size_t module, std::size_t at) {
        if (!linked_) {
            link_branches(string_, links_);
            offsets_ = parameter_offsets(string_, model_.alphabet);
            linked_ = true;
        }
        picture_.clear();
        const std::size_t replaced = derivation_->picture(string_, &offsets_, links_, module, at, picture_);
        if (replaced == 0) return 0;

        walk_.module_ = std::uint32_t(module);
        walk_.parameters_at_ = at;
        walk_.in_picture_ = true;
        std::size_t picture_at = 0;
        for (std::size_t i = 0; i < picture_.size() && !walk_.stopped; ++i) {
            const Match match = find_symbol(picture_, i);
            i = match.module;
            act(match, picture_, picture_at);
            picture_at += match.meaning.arity;
        }
        walk_.in_picture_ = false;
        return replaced;
    }

    const Model& model_;
    const SymbolTable& symbols_;
    const ModuleString& string_;
    const Derivation* derivation_;
    Walk walk_;
    std::vector<char> pictured_;  // by letter
    bool linked_ = false;
    BranchLinks links_;
    std::vector<std::size_t> offsets_;
    ModuleString picture_;
};

void Interpretation::clear() {
    geometry.clear();
    queries.clear();
}

void interpret(const Model& model, const SymbolTable& symbols, const ModuleString& string,
               const TurtleSettings& settings, const Derivation* derivation, const InterpretOptions& options,
               Interpretation& result) {
    result.clear();
    StringWalk(model, symbols, string, settings, derivation, options.plant, result).run();
}

Interpretation interpret(const Model& model, const ModuleString& string, const TurtleSettings& settings,
                         const Derivation* derivation) {
    Interpretation result;
    interpret(model, *symbol_table(model), string, settings, derivation, {}, result);
    return result;
}

}  // namespace espalier
