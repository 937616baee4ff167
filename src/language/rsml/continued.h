// Roots that go on behind a gap.
#pragma once

#include "language/measured/notes.h"
#include "language/rsml/raw_file.h"

#include <cstddef>
#include <map>

namespace espalier::language::rsml {

/// A root with a property `continues` is a further piece of the root of that ID, which stands before it: both become
/// one, with a gap between their points.
void join_continued(RawFile& file, const std::map<double, std::size_t>& root_of_id, measured::Notes& notes);

}  // namespace espalier::language::rsml
