// Which process is answering, for another thread that watches.
#pragma once

#include "espalier/environment/environment.h"

#include <atomic>

namespace espalier::environment {

struct Environment::Answering {
    /// A process answers while it lives.
    class Turn {
    public:
        Turn(Answering& answering, const std::string& process) : answering_(answering) {
            ++answering_.number;
            answering_.process = &process;
        }
        ~Turn() { answering_.process = nullptr; }
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;

    private:
        Answering& answering_;
    };

    std::atomic<const std::string*> process{nullptr};
    std::atomic<std::uint64_t> number{0};
};

}  // namespace espalier::environment
