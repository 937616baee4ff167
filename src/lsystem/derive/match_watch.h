// Hears which productions are tried on modules, and why they do not apply.
#pragma once

#include <utility>

namespace espalier::lsystem {

struct CompiledProduction;
struct CompiledRules;
struct Site;

/// What trying a production gave, in the order of the tests.
struct Trial {
    enum class Verdict { strict, right_context, left_context, condition, applies };
    Verdict verdict = Verdict::applies;  ///< else the first test that fails
    double condition = 1;                ///< where it was evaluated
};

class MatchWatch {
public:
    virtual ~MatchWatch() = default;

    virtual void begins(const CompiledRules& rules, const Site& site) = 0;
    virtual void tried(const CompiledProduction& production, const Trial& trial) = 0;
    /// Called for each that applies, before one of them is drawn.
    virtual void weighed(const CompiledProduction& production, double probability) = 0;
    virtual void chose(const CompiledProduction* production) = 0;  ///< null: none

    /// What matchers made on this thread tell; null: they are not watched.
    static MatchWatch* current() { return current_; }

    class Scope {
    public:
        explicit Scope(MatchWatch& watch) : before_(std::exchange(current_, &watch)) {}
        ~Scope() { current_ = before_; }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        MatchWatch* before_;
    };

private:
    static inline thread_local MatchWatch* current_ = nullptr;
};

}  // namespace espalier::lsystem
