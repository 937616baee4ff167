// The fields of a growth as pages draw them, at every step that was grown.
#pragma once

#include "espalier/geometry/field.h"

#include "studio/growth/spool.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace espalier::studio {

/// Written by the thread that grows, read by the one that serves. The messages lie in a file; one that is equal to that
/// of the step before lies there once.
class KeptFields {
public:
    KeptFields(std::uint32_t growth, std::filesystem::path file) : growth_(growth), file_(std::move(file)) {}

    /// Throws RunError if the disk is full.
    void add(const Fields& fields, int step);
    /// The message `ESF1` of docs/developer/studio-protocol.md. Throws UserError if there is no such field at this
    /// step.
    std::string message(int step, const std::string& name) const;

private:
    struct History {
        std::string last;                   ///< the message of the last step that was added, as if of step 0
        std::map<int, Spool::Place> steps;  ///< where those of all steps lie
    };

    const std::uint32_t growth_;
    const std::filesystem::path file_;
    mutable std::mutex mutex_;
    std::unique_ptr<Spool> spool_;
    std::map<std::string, History> histories_;  ///< by names
};

}  // namespace espalier::studio
