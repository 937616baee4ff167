#include "lsystem/derive/scratch_lease.h"

#include "lsystem/derive/step.h"

#include <algorithm>

namespace espalier::lsystem {
namespace {

constexpr std::size_t most_kept = std::size_t{1} << 22;  // bytes of pieces that a thread keeps for the next plant

struct ThreadScratch {
    Scratch scratch;
    bool lent = false;
};

ThreadScratch& of_this_thread() {
    static thread_local ThreadScratch scratch;
    return scratch;
}

}  // namespace

Machine& Machines::local() const {
    // Among many small plants the next mostly has the same L-system. A machine ends with its system, so that another
    // system in the same place is not mistaken for it.
    struct Last {
        const CompiledSystem* system = nullptr;
        std::weak_ptr<Machine> owned;
        Machine* machine = nullptr;
    };
    static thread_local Last last;
    if (last.system != &system_ || last.owned.expired()) {
        std::shared_ptr<Machine>& machine = system_.machines.local();
        if (!machine) machine = std::make_shared<Machine>(system_.machine());
        last = {&system_, machine, machine.get()};
    }
    last.machine->attach(&variables_, &services_, Stream::derivation);
    return *last.machine;
}

ScratchLease::ScratchLease(std::size_t modules, std::unique_ptr<Scratch>& own) {
    ThreadScratch& thread = of_this_thread();
    of_thread_ = modules <= grain && !thread.lent;
    if (!of_thread_ && !own) own = std::make_unique<Scratch>();
    scratch_ = of_thread_ ? &thread.scratch : own.get();
    thread.lent = thread.lent || of_thread_;
}

ScratchLease::~ScratchLease() {
    if (!of_thread_) return;
    of_this_thread().lent = false;
    const auto large = [](const ModuleString& piece) { return piece.bytes() > most_kept; };
    if (std::any_of(scratch_->pieces.begin(), scratch_->pieces.end(), large)) scratch_->pieces.clear();
}

}  // namespace espalier::lsystem
