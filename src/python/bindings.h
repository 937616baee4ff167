// What the files of the extension share: each binds one subject.
#pragma once

#include "espalier/geometry/field.h"
#include "espalier/lsystem/derivation.h"
#include "espalier/simulation/scene.h"
#include "espalier/turtle/interpretation.h"

#include <memory>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <string>
#include <vector>

namespace espalier::python {

namespace py = pybind11;

/// A string of modules that nothing writes any more, with the alphabet that names its letters.
struct BoundString {
    BoundString(std::shared_ptr<const ModuleString> modules, std::shared_ptr<const Model> of);

    std::shared_ptr<const ModuleString> string;
    std::shared_ptr<const Model> model;
    std::vector<std::size_t> offsets;  ///< where parameters begin

    /// Parameter `number`, from 1, of the module at `place`; NaN unless its symbol is `symbol`.
    double parameter(std::size_t place, const std::string& symbol, int number) const;
};

/// A process in Python that scenes may name by its number while this lives.
class OfferedProcess {
public:
    explicit OfferedProcess(py::object process);
    ~OfferedProcess();
    OfferedProcess(const OfferedProcess&) = delete;
    OfferedProcess& operator=(const OfferedProcess&) = delete;

    std::int64_t number() const { return number_; }

private:
    std::int64_t number_;
};

/// The exception of a process in Python that ended this thread's work, until it is raised again; null: none.
std::unique_ptr<py::error_already_set>& error_of_process();

/// A scene, and the processes in Python that it names.
struct BoundScene {
    Scene scene;
    std::vector<std::shared_ptr<OfferedProcess>> processes = {};
};

/// "I.3": symbol and number of a parameter, counted from 1. Throws UserError for other texts.
std::pair<std::string, int> parameter_named(const std::string& name);

/// An array that reads memory which `owner` keeps; no copy, and not writeable.
template <class T, class Owner>
py::array view(const std::shared_ptr<Owner>& owner, const T* first, std::vector<py::ssize_t> shape,
               std::vector<py::ssize_t> strides) {
    if (shape[0] == 0) return py::array_t<T>(shape);
    py::capsule keeper(new std::shared_ptr<Owner>(owner),
                       [](void* held) { delete static_cast<std::shared_ptr<Owner>*>(held); });
    py::array array = py::array_t<T>(std::move(shape), std::move(strides), first, keeper);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

/// Lets the classes of a module refuse objects whose __init__ never ran, as `Class.__new__(Class)` gives them: pybind11
/// would hand out memory that nothing was made in.
inline void refuse_unmade(const py::module_& module) {
    for (const auto& [name, value] : py::cast<py::dict>(module.attr("__dict__"))) {
        if (!PyType_Check(value.ptr())) continue;
        auto* const bound = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(value.ptr()));
        if (bound == nullptr) continue;
        bound->operator_new = [](std::size_t) -> void* {
            throw py::type_error("the object was never made: its __init__ did not run");
        };
    }
}

void bind_errors(py::module_& module);
void bind_model(py::module_& module);
void bind_field(py::module_& module);
void bind_scene(py::module_& module);
void bind_world(py::module_& module);

/// numpy and the rest of one field, as it is now. Throws UserError if it is not there.
py::object field_of(const Fields& fields, const std::string& name);

}  // namespace espalier::python
