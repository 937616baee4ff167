// How a studio on a machine fits what it has open: as `espalier fit` does, by least squares.
#pragma once

#include "espalier/studio/fitting.h"

namespace espalier::app {

studio::Fitting studio_fitting();

}  // namespace espalier::app
