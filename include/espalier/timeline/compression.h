// How files of the timeline pack their arrays.
#pragma once

#include "espalier/base/stations.h"

namespace espalier::timeline {

/// zlib takes longer and makes smaller files, which viewers in a browser read, too.
enum class Compression { lz4, zlib };

}  // namespace espalier::timeline
