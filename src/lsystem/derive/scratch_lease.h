// Memory and machines that steps need only while they run: a stand of ten thousand small plants has no more of them
// than threads.
#pragma once

#include "lsystem/compile/compiled_model.h"

#include <memory>

namespace espalier::lsystem {

struct Scratch;

/// The machines of an L-system as one plant uses them.
class Machines {
public:
    Machines(const CompiledSystem& system, Variables& variables, Services& services)
        : system_(system), variables_(variables), services_(services) {}

    /// The calling thread's machine, which works for this plant until the thread turns to another.
    Machine& local() const;

private:
    const CompiledSystem& system_;
    Variables& variables_;
    Services& services_;
};

/// Lends a scratch for one step: of a small string the thread's, else the plant's own, which is made if there is none.
/// For large strings the thread's would not do: while it waits for others it may begin another plant's step.
class ScratchLease {
public:
    ScratchLease(std::size_t modules, std::unique_ptr<Scratch>& own);
    ~ScratchLease();
    ScratchLease(const ScratchLease&) = delete;
    ScratchLease& operator=(const ScratchLease&) = delete;

    Scratch& scratch() const { return *scratch_; }

private:
    Scratch* scratch_;
    bool of_thread_ = false;
};

}  // namespace espalier::lsystem
