// What lies between two frames: plants whose organs unfold rather than appear.
#pragma once

#include "espalier/archive/recorded_run.h"

#include <cstdint>
#include <vector>

namespace espalier::archive {

/// Geometry at times between two frames that follow each other. A module that is drawn in both is matched by its
/// identity. Lengths and radii of internodes change linearly, their directions along great circles, and everything
/// stands on what bears it, so that axes stay whole. What is new grows from a point at its base. What the later frame
/// lacks is gone at once: it was shed, or has become something else.
class Unfolding {
public:
    Unfolding(const FrameGeometry& early, FrameGeometry late);

    /// `share` of the time has passed, in (0, 1]; at 1 everything is where the later frame has it.
    FrameGeometry at(double share) const;

private:
    /// An internode of the later frame, and what it was.
    struct Growing {
        FrameInternode late;
        glm::vec3 was_base{0}, was{0};  ///< base, and from base to tip
        float was_base_radius = 0, was_tip_radius = 0;
        bool is_new = true;
    };
    /// A point of an organ relative to the tip of an internode nearby; of the plant's origin where there is none.
    struct OrganPoint {
        PointIndex point;
        InternodeIndex bearer;  ///< among `internodes_`, or none
        glm::vec3 from, to;     ///< in the early and in the late frame
    };

    void match_internodes(const std::vector<FrameInternode>& before);
    void match_organs(const FrameGeometry& early, const std::vector<FrameInternode>& before);

    FrameGeometry late_;
    RowsOf<FrameInternode, Growing> internodes_;
    std::vector<OrganPoint> organ_points_;
};

}  // namespace espalier::archive
