#include "environment/leaf/gas/stomata.h"

#include "environment/leaf/gas/leaf_equations.h"

namespace espalier::environment::leaf {

double Stomata::by_potential(double potential) const {
    return OpenedStomata<double>(*this, slope, potential).factor;
}

double Stomata::opening(const AtSurface& at, double potential) const {
    return OpenedStomata<double>(*this, slope, potential)
        .at({at.assimilation, at.carbon_dioxide, at.deficit, at.saturation, at.compensation});
}

}  // namespace espalier::environment::leaf
