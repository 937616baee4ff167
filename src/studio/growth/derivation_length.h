// Whether what grows depends on how far it is to grow.
#pragma once

#include "espalier/simulation/scene.h"

namespace espalier::studio {

/// True if a model reads or sets its derivation length, does something at its end, or has a length that varies: then a
/// growth to a later step is another growth, and not the same one continued.
bool depends_on_length(const Scene& scene);

}  // namespace espalier::studio
