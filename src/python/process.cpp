// A process of the environment that is written in Python, and answers a batch of queries as arrays.
#include "espalier/environment/environment_process.h"

#include "python/bindings.h"

#include <algorithm>
#include <limits>
#include <map>

namespace espalier::python {

namespace {

std::map<std::int64_t, py::object>& offered() {
    static auto* processes = new std::map<std::int64_t, py::object>;  // outlives the interpreter, which frees nothing
    return *processes;
}

using Rows = py::array_t<double>;

Rows rows_of(std::size_t rows, std::size_t columns) {
    return Rows(std::vector<py::ssize_t>{static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns)});
}

Rows vectors_of(Queries queries, const glm::dvec3 Pose::*member) {
    Rows array = rows_of(queries.size(), 3);
    double* value = array.mutable_data();
    for (const Query& query : queries) {
        const glm::dvec3& vector = query.pose.*member;
        value = std::copy_n(&vector.x, 3, value);
    }
    return array;
}

template <class T>
py::array_t<T> numbers_of(Queries queries, const T Query::*member) {
    py::array_t<T> array(static_cast<py::ssize_t>(queries.size()));
    std::transform(queries.begin(), queries.end(), array.mutable_data(), [&](const Query& q) { return q.*member; });
    return array;
}

Rows values_of(std::span<const Answer> answers) {
    std::size_t columns = 0;
    for (const Answer& answer : answers) columns = std::max(columns, answer.size());
    Rows array = rows_of(answers.size(), columns);
    double* row = array.mutable_data();
    for (const Answer& answer : answers) {
        double* end = std::copy(answer.begin(), answer.end(), row);
        row += columns;
        std::fill(end, row, std::numeric_limits<double>::quiet_NaN());
    }
    return array;
}

class PythonProcess final : public EnvironmentProcess {
public:
    PythonProcess(Settings& settings, const EnvironmentContext&, Fields&) {
        const std::int64_t number = settings.integer("number");
        const py::gil_scoped_acquire held;
        const auto found = offered().find(number);
        if (found == offered().end()) throw UserError("the process in Python of this scene is gone");
        process_ = found->second;
    }
    ~PythonProcess() override {
        const py::gil_scoped_acquire held;
        process_ = py::object();
    }

    // All arrays are copies: Python may keep them, and the queries do not last.
    void answer(const WorldView& world, Queries queries, std::span<Answer> answers, Fields&) override {
        if (queries.empty()) return;
        const py::gil_scoped_acquire held;
        const Rows values = values_of(answers);
        const py::object batch = py::module_::import("types").attr("SimpleNamespace")(
            py::arg("position") = vectors_of(queries, &Pose::position),
            py::arg("heading") = vectors_of(queries, &Pose::heading),
            py::arg("identity") = numbers_of(queries, &Query::identity),
            py::arg("plant") = numbers_of(queries, &Query::plant), py::arg("parameters") = values_of(answers),
            py::arg("step") = world.step, py::arg("time") = world.time, py::arg("dt") = world.dt);
        const py::ssize_t columns = values.shape(1);  // as they are: Python may give the array another shape
        const double* row = values.data();
        ask(batch, values);
        for (const Answer& answer : answers) {
            std::copy_n(row, answer.size(), answer.begin());
            row += columns;
        }
    }
    std::pair<int, int> query_arity() const override { return {1, std::numeric_limits<int>::max()}; }

private:
    static void refuse(const py::object& returned) {
        const std::string type = py::str(py::type::of(returned).attr("__name__"));
        PyErr_SetString(PyExc_TypeError, ("answer() returned " + type +
                                          ", which nothing uses: write into `answers`, as in answers[:, 0] = ...")
                                             .c_str());
        throw py::error_already_set();
    }

    // The exchange tells what failed as text; the exception itself, with its traceback, is raised by the caller.
    void ask(const py::object& batch, const Rows& values) {
        error_of_process().reset();
        try {
            const py::object returned = process_.attr("answer")(batch, values);
            if (!returned.is_none() && !returned.is(values)) refuse(returned);
        } catch (const py::error_already_set& error) {
            error_of_process() = std::make_unique<py::error_already_set>(error);
            const std::string told = error.what();
            throw std::runtime_error(told.substr(0, told.find("\n\nAt:")));
        }
    }

    py::object process_;
};

const Registered<ProcessType> python_entry{{"python", "a process that a program in Python brings",
                                            "number (integer): which of the program's processes",
                                            construct<PythonProcess>}};

}  // namespace

std::unique_ptr<py::error_already_set>& error_of_process() {
    thread_local std::unique_ptr<py::error_already_set> error;
    return error;
}

OfferedProcess::OfferedProcess(py::object process) {
    static std::int64_t last = 0;  // guarded by the lock of the interpreter
    number_ = ++last;
    offered().emplace(number_, std::move(process));
}

OfferedProcess::~OfferedProcess() {
    offered().erase(number_);
}

}  // namespace espalier::python
