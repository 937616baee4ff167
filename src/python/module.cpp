// The extension _espalier, which the package espalier wraps.
#include "python/bindings.h"

namespace espalier::python {

PYBIND11_MODULE(_espalier, module) {
    module.doc() = "Espalier's growing half; import espalier instead";
    module.attr("__version__") = ESPALIER_VERSION;
    bind_errors(module);
    bind_model(module);
    bind_field(module);
    bind_scene(module);
    bind_world(module);
    refuse_unmade(module);
}

}  // namespace espalier::python
