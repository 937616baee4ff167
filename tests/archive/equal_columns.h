// Checks that two frames have the same columns.
#pragma once

#include "espalier/geometry/frame_geometry.h"

#include "catch.h"

namespace espalier {

inline void check_equal(const FrameAttributes& a, const FrameAttributes& b) {
    CHECK(a.identities == b.identities);
    CHECK(a.parents == b.parents);
    CHECK(a.plants == b.plants);
    CHECK(a.symbols == b.symbols);
    CHECK(a.births == b.births);
    CHECK(a.orders == b.orders);
    CHECK(a.colours == b.colours);
    CHECK(a.kinds == b.kinds);
    CHECK(a.rgb == b.rgb);
}

inline void check_equal(const FrameCells& a, const FrameCells& b) {
    CHECK(a.offsets == b.offsets);
    CHECK(a.connectivity == b.connectivity);
    CHECK(a.first == b.first);
}

}  // namespace espalier
