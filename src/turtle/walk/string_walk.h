// Leads a walk along modules: looks each letter up, lets it act, draws pictures in place of modules that have one.
#pragma once

#include "turtle/walk/symbol_table.h"

#include <memory>

namespace espalier::turtle {

/// Whose string is walked along.
struct WalkInput {
    const Model& model;
    const SymbolTable& symbols;
    const ModuleString& string;
    const TurtleSettings& settings;
    const Derivation* derivation;  ///< null where no module has a picture
    std::uint32_t plant;
    const FieldValues* fields;  ///< null: vector fields read none
};

class StringWalk {
public:
    /// Stands at the beginning of a string. With `room`, rows that were counted go there.
    void begin(const WalkInput& input, Interpretation& result, const Walk::Room* room);
    /// Walks from module `begin`, whose parameters begin at `at`, to module `end`.
    void run(std::size_t begin, std::size_t end, std::size_t at);
    void finish() { walk_.finish(); }
    /// Leaves the result as it is, and gives back what memory is much.
    void end();

    Walk& walk() { return walk_; }
    /// Where the walk is; it goes on from what is put there.
    WalkState& state() { return walk_; }
    /// True if as many rows were written as there was room for.
    bool filled_room() const { return walk_.internodes_.full() && walk_.queries_.full() && walk_.answers_.full(); }

private:
    class Ahead;
    /// Returns where it stands, at or behind `end`: letters that form one symbol are not parted.
    template <bool with_pictures>
    std::size_t run_along(std::size_t begin, std::size_t end, std::size_t& at);
    std::size_t next_action(std::size_t begin, std::size_t end) const;
    /// False if tropisms bend what is drawn, or a polygon takes its vertices.
    bool draws_plainly() const { return walk_.settings_->tropisms.empty() && walk_.polygons.empty(); }
    /// Walks along letters that need no action; returns where one does.
    std::size_t go_ahead(std::size_t begin, std::size_t end, std::size_t& at);
    void act(std::size_t module, LetterId letter, const LetterMeaning& meaning, std::size_t at) {
        walk_.acting_.module = std::uint32_t(module);
        walk_.acting_.parameters_at = at;
        walk_.acting_.letter = letter;
        meaning.action(walk_, {string_->parameters.data() + at, meaning.arity});
    }
    /// Returns how many modules the picture stands for, 0 if there is none.
    std::size_t draw_picture(std::size_t module, std::size_t at);

    const ModuleString* string_ = nullptr;
    const SymbolTable* symbols_ = nullptr;
    const Derivation* derivation_ = nullptr;
    const Model* model_ = nullptr;
    Walk walk_;
    BranchLinks links_;
    std::vector<std::size_t> offsets_;
    ModuleString picture_;
};

/// A walk of this thread's: plants are many, and its memory and the angles it knows are those of the next.
class PooledWalk {
public:
    PooledWalk(const WalkInput& input, Interpretation& result, const Walk::Room* room = nullptr);
    ~PooledWalk();
    PooledWalk(const PooledWalk&) = delete;
    PooledWalk& operator=(const PooledWalk&) = delete;

    StringWalk& operator*() const { return *walk_; }
    StringWalk* operator->() const { return walk_.get(); }

private:
    std::unique_ptr<StringWalk> walk_;
};

}  // namespace espalier::turtle
