// Which L-system each module of a string belongs to, where several are nested in it.
#pragma once

#include "lsystem/compile/compiled_model.h"

#include <cstdint>
#include <vector>

namespace espalier::lsystem {

/// One occurrence of ?(id, scale) ... $ and what is between; scope 0 is the main L-system's.
struct Scope {
    const CompiledSystem* system = nullptr;
    std::uint32_t parent = 0;
    Identity identity = 0;    ///< identity of the `?`
    std::uint32_t level = 0;  ///< branches around the `?`
    std::uint32_t depth = 0;  ///< scopes around it
    bool cut = false;         ///< a `%` cuts the `?` off
    bool left = false;        ///< its end has been found
};

/// What a walk along the string meets, in order. The modules `?` and `$` belong to the scope around.
struct Passage {
    enum class Kind : std::uint8_t { rewrite, cut_off, enter, leave };
    Kind kind = Kind::rewrite;
    std::uint32_t scope = 0;
    std::size_t begin = 0, end = 0;  ///< modules to be rewritten, or that a `%` cuts off
    std::size_t parameters_at = 0;   ///< where the parameters of `begin` begin
};

/// Brackets save and restore which L-system applies: a scope ends with its `$`, with its branch, or with the string.
class Scopes {
public:
    /// Throws RunError for an L-system that does not exist or stands inside itself.
    void find(const CompiledModel& model, const ModuleString& string, std::uint32_t step);

    const std::vector<Scope>& all() const { return scopes_; }
    const std::vector<Passage>& passages() const { return passages_; }
    /// The scope of a module, also of one that a `%` cuts off: it is still drawn.
    std::uint32_t of_module(std::size_t module) const;

private:
    void open(const CompiledModel& model, double id, Identity identity, std::uint32_t step);
    void close_scope();
    void close_branch();
    void leave(std::uint32_t scope);
    void end_run(std::size_t module, std::size_t parameters_at);

    std::vector<Scope> scopes_;
    std::vector<Passage> passages_;
    // State of the walk.
    std::uint32_t current_ = 0;
    std::vector<std::uint32_t> saved_;  ///< scope of each open branch
    std::size_t run_ = 0, run_parameters_ = 0;
    bool cutting_ = false;
    std::uint32_t cut_scope_ = 0;
    std::size_t cut_level_ = 0;
};

}  // namespace espalier::lsystem
