// What the user sees of the measured rows: the table, the list of goals, and a file that says all of it.
#pragma once

#include "measuring.h"

#include <filesystem>
#include <vector>

namespace espalier::bench {

void print_heading();
void print_line(const Measured& measured);
/// The goals themselves.
void print_goals(const std::vector<const Row*>& chosen);
/// Machine, compiler, version and every row with both of its sides.
void write_json(const std::vector<Measured>& all, double seconds, const std::filesystem::path& file);

}  // namespace espalier::bench
