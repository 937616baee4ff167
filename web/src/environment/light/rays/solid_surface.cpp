#include "environment/light/rays/solid_surface.h"

#include "espalier/base/error.h"

namespace espalier::environment {

TriangleMesh surface_of(const Shape&, double) {
    throw RunError("a page cannot trace rays: this needs the program that is installed, with Embree");
}

}  // namespace espalier::environment
