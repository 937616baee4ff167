// Worlds and their frames.
#include "espalier/simulation/simulation.h"
#include "espalier/simulation/staged_world.h"

#include "python/bindings.h"

#include <array>
#include <atomic>
#include <optional>

namespace espalier::python {

namespace {

/// A world that one thread of Python uses at a time.
struct BoundWorld : std::enable_shared_from_this<BoundWorld> {
    explicit BoundWorld(const Scene& scene) : world(scene, default_memory()) {}

    StagedWorld world;
    std::atomic<bool> busy = false;
    bool started = false;
};

class Turn {
public:
    explicit Turn(BoundWorld& bound) : bound_(bound) {
        if (bound.busy.exchange(true)) throw UserError("another thread uses this world");
    }
    ~Turn() { bound_.busy = false; }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

private:
    BoundWorld& bound_;
};

/// What a turtle drew of one plant. It shares the values of its step, which the world does not write while they are
/// held.
struct BoundPlant {
    std::string name;
    BoundString string;
    std::shared_ptr<const Interpretation> interpretation;

    const Column<Internode>& internodes() const { return interpretation->geometry.internodes; }
    py::array vectors(const glm::dvec3 Internode::*member) const {
        const double* first = internodes().empty() ? nullptr : &(internodes().data()->*member).x;
        return view(interpretation, first, {rows(), 3}, {sizeof(Internode), sizeof(double)});
    }
    template <class T>
    py::array numbers(const T Internode::*member) const {
        const T* first = internodes().empty() ? nullptr : &(internodes().data()->*member);
        return view(interpretation, first, {rows()}, {sizeof(Internode)});
    }
    py::ssize_t rows() const { return static_cast<py::ssize_t>(internodes().size()); }
};

py::array_t<std::uint64_t> internode_identities(const BoundPlant& plant) {
    py::array_t<std::uint64_t> values(plant.rows());
    std::uint64_t* value = values.mutable_data();
    for (const Internode& one : plant.internodes()) *value++ = plant.string.string->identity(one.module);
    return values;
}

py::array_t<double> internode_parameters(const BoundPlant& plant, const std::string& name) {
    const auto [symbol, number] = parameter_named(name);
    py::array_t<double> values(plant.rows());
    double* value = values.mutable_data();
    for (const Internode& one : plant.internodes()) *value++ = plant.string.parameter(one.module, symbol, number);
    return values;
}

struct BoundFrame {
    std::shared_ptr<BoundWorld> bound;
    int step;
    double time;
    std::vector<BoundPlant> plants;
};

BoundFrame frame_of(BoundWorld& bound) {
    const Turn turn(bound);
    if (!bound.started) throw UserError("the world has no frame yet: call start()");
    const Frame frame = bound.world.frame();
    BoundFrame result{bound.shared_from_this(), frame.step, frame.time, {}};
    for (const PlantFrame& plant : frame.plants) {
        // The model of a plant that grows anew in every step is gone with the step.
        const auto model = std::make_shared<const Model>(*plant.model);
        result.plants.push_back({plant.name, BoundString(plant.string, model), plant.interpretation});
    }
    return result;
}

py::object field_in(const BoundFrame& frame, const std::string& name) {
    const Turn turn(*frame.bound);
    if (frame.bound->world.steps_done() != frame.step) {
        throw UserError("the fields of step " + std::to_string(frame.step) + " are gone: the world is at step " +
                        std::to_string(frame.bound->world.steps_done()) + "; take field(\"" + name +
                        "\") before the next step");
    }
    return field_of(frame.bound->world.environment().fields(), name);
}

py::dict quantities_in(const BoundFrame& frame, std::uint32_t plant) {
    const Turn turn(*frame.bound);
    if (frame.bound->world.steps_done() != frame.step) {
        throw UserError("the quantities of step " + std::to_string(frame.step) + " are gone: ask before the next step");
    }
    if (plant >= frame.plants.size()) {
        throw UserError("there is no plant " + std::to_string(plant) + ": they count from 0 to " +
                        std::to_string(frame.plants.size() - 1));
    }
    py::dict values;
    for (const Quantity& one : frame.bound->world.environment().statistics(plant)) {
        values[py::str(one.name)] = one.value;
    }
    return values;
}

std::shared_ptr<BoundWorld> world_of(const BoundScene& scene) {
    const py::gil_scoped_release free;
    return std::make_shared<BoundWorld>(scene.scene);
}

void start(BoundWorld& bound, const std::optional<int>& steps) {
    const py::gil_scoped_release free;
    const Turn turn(bound);
    if (bound.started) throw UserError("the world has begun to grow");
    if (steps) bound.world.set_steps(*steps);
    bound.world.start();
    bound.started = true;
}

void advance(BoundWorld& bound) {
    const py::gil_scoped_release free;
    const Turn turn(bound);
    if (!bound.started) throw UserError("the world has not begun to grow: call start()");
    bound.world.step();
}

std::optional<std::array<double, 3>> origin_of(const BoundWorld& bound) {
    const std::shared_ptr<MapOrigin>& origin = bound.world.scene().origin;
    if (!origin || !origin->value()) return std::nullopt;
    return std::array{origin->value()->x, origin->value()->y, origin->value()->z};
}

py::dict stage_seconds(const BoundWorld& bound) {
    const StageTimes& times = bound.world.times();
    py::dict seconds;
    seconds["derive"] = times.derive;
    seconds["interpret"] = times.interpret;
    seconds["exchange"] = times.exchange;
    return seconds;
}

void bind_frame(py::module_& module) {
    py::class_<BoundPlant>(module, "PlantFrame",
                           "One plant of a frame; arrays of its internodes are views that stay valid and unchanged.")
        .def_readonly("name", &BoundPlant::name, "Name of the plant in the scene.")
        .def_readonly("string", &BoundPlant::string, "The string of its modules.")
        .def("__len__", &BoundPlant::rows)
        .def_property_readonly(
            "base", [](const BoundPlant& p) { return p.vectors(&Internode::base); }, "(n, 3), metres")
        .def_property_readonly(
            "tip", [](const BoundPlant& p) { return p.vectors(&Internode::tip); }, "(n, 3), metres")
        .def_property_readonly(
            "radius", [](const BoundPlant& p) { return p.numbers<double>(&Internode::tip_radius); },
            "Radius at the tip, (n,), metres")
        .def_property_readonly(
            "order", [](const BoundPlant& p) { return p.numbers<std::uint16_t>(&Internode::order); },
            "Depth of branching, (n,), 0: the main axis")
        .def_property_readonly("identity", internode_identities, "Identities of the modules, uint64 (n,)")
        .def("column", internode_parameters, py::arg("name"), "Parameter \"I.3\", float64 (n,); NaN: none");

    py::class_<BoundFrame>(module, "Frame", "One step of a world, after its exchange.")
        .def_readonly("step", &BoundFrame::step)
        .def_readonly("time", &BoundFrame::time, "In the scene's unit.")
        .def_readonly("plants", &BoundFrame::plants)
        .def("field", field_in, py::arg("name"), "A field by name, until the world's next step.")
        .def("quantities", quantities_in, py::arg("plant") = 0,
             "What the processes tell of a plant and of the world, by name, until the world's next step.");
}

}  // namespace

void bind_world(py::module_& module) {
    bind_frame(module);
    py::class_<BoundWorld, std::shared_ptr<BoundWorld>>(module, "World")
        .def(py::init(&world_of), py::arg("scene"))
        .def("start", start, py::arg("steps") = py::none(), "Frame 0: every axiom, interpreted and exchanged.")
        .def("step", advance, "Derives, interprets and exchanges once; other threads of Python go on meanwhile.")
        .def("frame", frame_of, "The frame of the current step.")
        .def_readonly("started", &BoundWorld::started)
        .def_property_readonly("steps_done", [](const BoundWorld& bound) { return bound.world.steps_done(); })
        .def_property_readonly("stage_seconds", stage_seconds)
        .def_property_readonly("origin", origin_of)
        .def_property_readonly("last_step", [](const BoundWorld& bound) { return bound.world.last_step(); })
        .def_property_readonly("at_end", [](const BoundWorld& bound) { return bound.world.at_end(); });
}

}  // namespace espalier::python
