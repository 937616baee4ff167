// Scenes: read from files, or put together in Python; and recording them.
#include "espalier/base/stop.h"
#include "espalier/simulation/simulation.h"

#include "python/bindings.h"

namespace espalier::python {

namespace {

SettingValue value_of(const py::handle& value) {
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
    if (py::isinstance<py::int_>(value)) return value.cast<std::int64_t>();
    if (py::isinstance<py::float_>(value)) return value.cast<double>();
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    return value.cast<std::vector<double>>();
}

BoundScene scene_at(const std::optional<std::filesystem::path>& path, const std::optional<std::uint64_t>& seed) {
    const py::gil_scoped_release free;
    SceneOptions options;
    options.seed = seed;
    if (path) return {path->extension() == ".toml" ? read_scene(*path, options) : scene_of_model(*path, options)};
    BoundScene bound;
    bound.scene.seed = seed.value_or(0);
    return bound;
}

void add_plant(BoundScene& bound, Plant plant, const std::array<double, 3>& at, const std::string& name) {
    plant.turtle.pose.position = {at[0], at[1], at[2]};
    if (!name.empty()) plant.name = name;
    bound.scene.plants.push_back(std::move(plant));
}

void add_process(BoundScene& bound, const std::string& name, const std::string& kind, const py::dict& values) {
    Settings settings;
    for (const auto& [key, value] : values) settings.put(key.cast<std::string>(), value_of(value));
    bound.scene.environment.add(name, kind, settings);
}

void add_python_process(BoundScene& bound, const std::string& name, py::object process) {
    bound.processes.push_back(std::make_shared<OfferedProcess>(std::move(process)));
    bound.scene.environment.add(name, "python", {{"number", bound.processes.back()->number()}});
}

int record(const BoundScene& bound, const std::filesystem::path& output, bool overwrite, std::optional<int> steps) {
    Scene scene = bound.scene;
    if (steps) scene.steps = *steps;
    StopRequest request;
    bool interrupted = false;
    RunOptions options;
    options.output = output;
    options.overwrite = overwrite;
    options.progress = [&](const Progress&) {
        const py::gil_scoped_acquire held;
        interrupted = interrupted || PyErr_CheckSignals() != 0;
        if (interrupted) request.ask(patience_with_steps);
    };
    int done = 0;
    {
        const py::gil_scoped_release free;
        const StopRequest::Scope scope(&request);
        done = run(scene, options).steps;
    }
    if (interrupted) throw py::error_already_set();
    return done;
}

}  // namespace

void bind_scene(py::module_& module) {
    py::class_<BoundScene>(module, "Scene")
        .def(py::init(&scene_at), py::arg("path") = py::none(), py::arg("seed") = py::none())
        .def("set_steps", [](BoundScene& bound, int steps) { bound.scene.steps = steps; })
        .def("add_plant", add_plant)
        .def("add_process", add_process)
        .def("add_python_process", add_python_process)
        .def("record", record, py::arg("output"), py::arg("overwrite") = false, py::arg("steps") = py::none());
}

}  // namespace espalier::python
