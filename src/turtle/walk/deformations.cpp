// Free-form deformations as a walk meets them: of all that is drawn between their beginning and their end.
#include "espalier/turtle/walk.h"

#include <utility>

namespace espalier::turtle {

void Walk::begin_deformation(FreeForm form) {
    form.pose = turtle().pose;
    form.scale = turtle().scale;
    deformations.push_back({std::move(form), internodes_.size(), DrawnSoFar::of(*geometry_)});
}

void Walk::end_deformation() {
    if (deformations.empty()) return;
    const OpenDeformation& open = deformations.back();
    deform(open.form, internodes_.from(open.internodes), *geometry_, open.others);
    deformations.pop_back();
    is_deformed = true;
}

}  // namespace espalier::turtle
