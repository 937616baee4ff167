// What a function says at the nodes of its root.
#pragma once

#include "language/measured/notes.h"
#include "language/rsml/raw_file.h"

#include <vector>

namespace espalier::language::rsml {

/// The length of the line up to each point, without pieces between two polylines.
std::vector<double> arc_lengths(const RawRoot& root);

/// One value for each point, times the term's factor: linear between samples, and beyond them the nearest. None where
/// no sample has a value.
std::vector<double> values_at_nodes(const RawRoot& root, const RawFunction& function, measured::Notes& notes);

}  // namespace espalier::language::rsml
