// Writes the pictures of modules, which the homomorphism makes: one writer per model and thread, whoever's plant it is.
#pragma once

#include "lsystem/derive/derivation_state.h"
#include "lsystem/derive/expansion.h"

#include <memory>
#include <vector>

namespace espalier::lsystem {

/// What one L-system's homomorphism needs.
struct SystemPictures {
    explicit SystemPictures(const CompiledSystem& system);
    SystemPictures(const SystemPictures&) = delete;

    /// The production's successor has no picture in turn: it is laid out as it is.
    bool is_final(const CompiledProduction& production) const {
        return final[static_cast<std::size_t>(&production - rules.productions.data())];
    }

    const CompiledRules& rules;
    std::vector<bool> final;  ///< by production
    Machine machine;
    Matcher matcher;
    Expansion expansion;
};

/// A module whose picture is wanted, and the string it stands in.
struct Subject {
    const ModuleString& string;
    StringView view;
    Site site;
};

class PictureWriter {
public:
    explicit PictureWriter(const CompiledModel& model);

    /// Writes for this plant from now on.
    void work_for(Derivation::State& state);
    /// Appends the picture to `picture`; returns how many modules it replaces, 0 if no production applies.
    /// Throws EvaluationError.
    std::size_t write(const Subject& subject, ModuleString& picture);

private:
    /// A sub-L-system that the picture itself opens.
    struct Inner {
        const CompiledSystem* system;
        std::unique_ptr<Variables> variables;
        int level;
    };

    SystemPictures& pictures_of(const CompiledSystem& system) { return *systems_[system.index]; }
    void prepare(const CompiledSystem& system, Variables& variables, const StringView& view);
    void require_bounds(const ModuleString& picture, const CompiledProduction& production) const;
    /// Lays out the successor of a final production.
    void lay_out(SystemPictures& used, const CompiledProduction& production, ModuleString& picture) const;
    /// Lays out what is on the stack.
    void expand(const Subject& subject, const CompiledProduction& production, ModuleString& picture);
    void expand_nested(const Subject& subject, const CompiledProduction& production, ModuleString& picture);
    void pass(LetterId letter, const double* values, const Subject& subject);
    void open(double id, const Subject& subject);
    const CompiledSystem& current() const {
        return inner_.empty() ? *scopes_.all()[scope_].system : *inner_.back().system;
    }

    void look_at(const ModuleString& string);
    Variables& variables_of(std::uint32_t scope);
    void run_start(const CompiledSystem& system, Variables& variables);
    void forget_variables();

    Derivation::State* state_ = nullptr;
    std::uint64_t serial_ = 0;  ///< serial number of the plant's state: another may come to lie where one was
    const CompiledModel& model_;
    std::vector<std::unique_ptr<SystemPictures>> systems_;  ///< one for each L-system
    bool changes_ = false;                                  ///< homomorphisms assign, or more
    ModuleStack stack_;
    std::vector<Lineage> strict_;
    // What the blocks of a picture assign, seed or stop holds for that picture only.
    Variables copy_;
    Services services_;

    // Where L-systems are nested: of the string that was looked at last.
    const void* string_ = nullptr;
    std::size_t size_ = 0;
    std::uint64_t generation_ = 0;
    Scopes scopes_;
    std::uint32_t scope_ = 0;                            ///< scope of the subject
    std::vector<std::unique_ptr<Variables>> variables_;  ///< copies, for each scope that was asked for
    std::vector<std::uint32_t> made_;
    std::vector<Inner> inner_;
    int level_ = 0;
};

}  // namespace espalier::lsystem
