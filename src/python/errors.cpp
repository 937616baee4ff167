// Errors of the library as exceptions of Python, with the place of the first mistake.
#include "espalier/base/error.h"
#include "espalier/base/stop.h"

#include "base/reason.h"
#include "python/bindings.h"

namespace espalier::python {

namespace {

PyObject* error_type = nullptr;  // live as long as the interpreter
PyObject* run_error_type = nullptr;

py::object none_or(int number) {
    return number > 0 ? py::object(py::int_(number)) : py::object(py::none());
}

void raise(PyObject* type, const char* message, const Place& place) {
    const py::object error = py::reinterpret_borrow<py::object>(type)(message);
    error.attr("file") = place.known() ? py::object(py::str(place.file)) : py::object(py::none());
    error.attr("line") = none_or(place.line);
    error.attr("column") = none_or(place.column);
    PyErr_SetObject(type, error.ptr());
}

void translate(std::exception_ptr thrown) {
    try {
        std::rethrow_exception(thrown);
    } catch (const UserError& error) {
        raise(error_type, error.what(), error.diagnostics().empty() ? Place{} : error.diagnostics().front().place);
    } catch (const RunError& error) {
        if (const auto cause = std::move(error_of_process())) {
            cause->restore();
        } else {
            raise(run_error_type, error.what(), {});
        }
    } catch (const std::system_error& error) {
        raise(run_error_type, reason_of(error).c_str(), {});
    }
}

}  // namespace

void bind_errors(py::module_& module) {
    error_type = PyErr_NewExceptionWithDoc("espalier.Error",
                                           "A mistake in a model, a scene or a call; `file`, `line` and `column` (from "
                                           "1) say where, None where that is unknown.",
                                           PyExc_RuntimeError, nullptr);
    run_error_type = PyErr_NewExceptionWithDoc(
        "espalier.RunError", "A growth that cannot go on: memory, disk, a parameter that is no number.", error_type,
        nullptr);
    for (const char* attribute : {"file", "line", "column"}) py::handle(error_type).attr(attribute) = py::none();
    module.add_object("Error", error_type);
    module.add_object("RunError", run_error_type);
    py::register_exception_translator(translate);
}

}  // namespace espalier::python
