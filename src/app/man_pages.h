// Man pages of the program and its commands, made from their help.
#pragma once

#include <CLI/CLI.hpp>

#include <map>
#include <string>

namespace espalier::app {

/// Texts by the names of their files: "espalier-run.1".
std::map<std::string, std::string> man_pages(const CLI::App& program);

}  // namespace espalier::app
