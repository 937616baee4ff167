// The rows of frames as columns of numpy.
#pragma once

#include "espalier/archive/recorded_run.h"

#include "python/bindings.h"

namespace espalier::python {

/// A dict of arrays, a row for each internode, organ and answered query of the frames: what `espalier export` has as
/// CSV. `name`, `kind` and `symbol` are pairs: numbers, and the texts that they number.
py::dict organs_of(const RecordedRun& run, const std::vector<int>& steps);

}  // namespace espalier::python
