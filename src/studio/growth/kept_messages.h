// Binary messages of every step that was grown, by names: fields as pages draw them, and what processes know of organs.
#pragma once

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
class KeptMessages {
public:
    explicit KeptMessages(std::filesystem::path file) : file_(std::move(file)) {}

    /// A message of docs/developer/studio-protocol.md that tells its step behind its growth, as if of step 0. Throws
    /// RunError if the disk is full.
    void add(const std::string& name, int step, std::string message);
    /// Any step has a message of this name.
    bool has(const std::string& name) const;
    /// As of this growth. Throws UserError if there is none of this name and step.
    std::string message(const std::string& name, int step, std::uint32_t growth) const;

private:
    struct History {
        std::string last;                   ///< the message of the last step that was added
        std::map<int, Spool::Place> steps;  ///< where those of all steps lie
    };

    const std::filesystem::path file_;
    mutable std::mutex mutex_;
    std::unique_ptr<Spool> spool_;
    std::map<std::string, History> histories_;
};

}  // namespace espalier::studio
