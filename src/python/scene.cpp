// Scenes: read from files, or put together in Python; and recording them.
#include "espalier/base/stop.h"
#include "espalier/simulation/simulation.h"

#include "python/bindings.h"
#include "simulation/run/named_programs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace espalier::python {

namespace {

/// Keys and values, these as TOML.
using Values = std::vector<std::pair<std::string, std::string>>;

// A file may be anybody's; what a program in Python adds itself is its own.
void require_trust(const Scene& scene) {
    for (const NamedProgram& program : programs_of(scene)) {
        if (is_trusted(program.folder)) continue;
        throw UserError(program.place,
                        fmt::format("the process '{}' starts a program, which may do all that you may do: {}. Look at "
                                    "it; if you trust the files in {}, say Scene.of(file, trust=True)",
                                    program.process, fmt::join(program.command, " "), program.folder.string()));
    }
}

BoundScene scene_of_file(const std::filesystem::path& path, const SceneOptions& options, bool trust) {
    BoundScene bound{path.extension() == ".toml" ? read_scene(path, options) : scene_of_model(path, options)};
    if (!trust) require_trust(bound.scene);
    return bound;
}

BoundScene scene_at(const std::optional<std::filesystem::path>& path, const std::optional<std::uint64_t>& seed,
                    const std::optional<int>& steps, const Values& overrides, bool trust) {
    const py::gil_scoped_release free;
    SceneOptions options;
    options.seed = seed;
    options.steps = steps;
    options.overrides = overrides;
    if (path) return scene_of_file(*path, options, trust);
    BoundScene bound;
    bound.scene.seed = seed.value_or(0);
    bound.scene.steps = steps;
    return bound;
}

void add_plant(BoundScene& bound, Plant plant, const std::array<double, 3>& at, const std::string& name) {
    plant.turtle.pose.position = {at[0], at[1], at[2]};
    if (!name.empty()) plant.name = name;
    bound.scene.plants.push_back(std::move(plant));
}

void set_time(BoundScene& bound, double dt, const std::string& unit) {
    if (!(dt > 0 && std::isfinite(dt))) throw UserError("dt must be above 0");
    bound.scene.dt = dt;
    bound.scene.time_unit = unit;
}

void add_process(BoundScene& bound, const std::string& name, const std::string& kind, const Values& values) {
    Settings settings;
    for (const auto& [key, value] : values) settings.set(key, value);
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
        .def(py::init(&scene_at), py::arg("path") = py::none(), py::arg("seed") = py::none(),
             py::arg("steps") = py::none(), py::arg("overrides") = Values{}, py::arg("trust") = false)
        .def("set_time", set_time)
        .def("add_plant", add_plant)
        .def("add_process", add_process)
        .def("add_python_process", add_python_process)
        .def("record", record, py::arg("output"), py::arg("overwrite") = false, py::arg("steps") = py::none());
}

}  // namespace espalier::python
