// Scripts that complete the command line in shells, made from its options.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace espalier::app {

std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);
std::string fish_completion(const CLI::App& program);

}  // namespace espalier::app
