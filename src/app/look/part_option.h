// --list and --part: work that several processes share, on a cluster for instance.
#pragma once

#include <CLI/CLI.hpp>

#include <cstddef>
#include <string>

namespace espalier::app {

class PartOption {
public:
    /// `work`: what a command of the list does with its part, "simulate".
    PartOption(CLI::App& command, const std::string& work, const std::string& group = "Options");

    bool wants_list() const { return list_ > 0; }
    int parts() const { return list_; }
    // What to do here: every of()-th, from number() on, which counts from 0. Throw UserError for another text than
    // NUMBER/OF.
    std::size_t number() const { return part().first; }
    std::size_t of() const { return part().second; }
    bool is_part() const { return !part_.empty(); }

private:
    std::pair<std::size_t, std::size_t> part() const;

    std::string part_;
    int list_ = 0;
};

}  // namespace espalier::app
