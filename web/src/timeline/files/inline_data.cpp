#include "timeline/files/inline_data.h"

#include "espalier/base/error.h"

namespace espalier::timeline {

void encode(const DataArray&, Compression, Column<char>&) {
    throw RunError("a page records no files for ParaView: the program that is installed does");
}

}  // namespace espalier::timeline
