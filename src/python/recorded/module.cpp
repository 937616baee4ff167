// The extension _recorded: runs read back through the library's own reader. It links what looks, so that only programs
// that open runs load that.
#include "espalier/archive/organ_history.h"
#include "espalier/base/error.h"

#include "archive/chosen_frames.h"
#include "python/bindings.h"
#include "python/recorded/organs.h"

namespace espalier::python {

namespace {

/// A recorded frame in memory; arrays read it for as long as they live.
struct LoadedFrame : std::enable_shared_from_this<LoadedFrame> {
    std::vector<FrameInternode> internodes;
    FrameGeometry geometry;
};

py::ssize_t rows_of(const LoadedFrame& frame) {
    return static_cast<py::ssize_t>(frame.internodes.size());
}

template <class Of>
const std::int32_t* number_of(const Index<Of>& index) {
    return &index.number;
}
template <class T>
const T* number_of(const T& value) {
    return &value;
}

template <class T>
auto numbers(const T FrameInternode::*member) {
    return [member](const LoadedFrame& frame) {
        const auto* first = frame.internodes.empty() ? nullptr : number_of(frame.internodes.data()->*member);
        return view(frame.shared_from_this(), first, {rows_of(frame)}, {sizeof(FrameInternode)});
    };
}

auto vectors(const glm::vec3 FrameInternode::*member) {
    return [member](const LoadedFrame& frame) {
        const float* first = frame.internodes.empty() ? nullptr : &(frame.internodes.data()->*member).x;
        return view(frame.shared_from_this(), first, {rows_of(frame), 3}, {sizeof(FrameInternode), sizeof(float)});
    };
}

std::vector<std::string> symbols_in(const LoadedFrame& frame) {
    std::vector<std::string> names;
    for (const FrameInternode& one : frame.internodes) names.push_back(frame.geometry.symbol_names[one.symbol]);
    return names;
}

std::vector<std::string> parameter_names(const LoadedFrame& frame) {
    std::vector<std::string> names;
    for (const auto& [name, values] : frame.geometry.parameters) names.push_back(name);
    return names;
}

py::array_t<double> parameter_in(const LoadedFrame& frame, const std::string& name) {
    const auto found = frame.geometry.parameters.find(name);
    if (found == frame.geometry.parameters.end()) throw py::key_error(name);
    py::array_t<double> values(rows_of(frame));
    double* value = values.mutable_data();
    for (const FrameInternode& one : frame.internodes) {
        *value++ = found->second[one.tip_point.row()];
    }
    return values;
}

std::shared_ptr<LoadedFrame> frame_at(const RecordedRun& run, int step) {
    const py::gil_scoped_release free;
    auto frame = std::make_shared<LoadedFrame>();
    frame->geometry = run.geometry(run.frame(step));
    frame->internodes = internodes_of(frame->geometry);
    return frame;
}

/// Values (nx, ny, nz), lower corner, size of a voxel, unit.
py::tuple field_at(const RecordedRun& run, const std::string& name, int step) {
    auto field = std::make_shared<RecordedField>();
    {
        const py::gil_scoped_release free;
        *field = run.field(run.frame(step), name);
    }
    const py::ssize_t x = field->size.x, y = field->size.y, z = field->size.z;
    const py::ssize_t bytes = sizeof(float);
    const py::array values = view(std::shared_ptr<const RecordedField>(field), field->values.data(), {x, y, z},
                                  {bytes, bytes * x, bytes * x * y});
    const glm::dvec3 corner = field->origin - 0.5 * field->voxel;
    return py::make_tuple(values, std::array{corner.x, corner.y, corner.z},
                          std::array{field->voxel.x, field->voxel.y, field->voxel.z}, field->unit);
}

std::array<double, 3> values_of(const glm::vec3& place) {
    return {place.x, place.y, place.z};
}

py::dict row_of(const OrganHistory& history, const OrganMoment& moment) {
    py::dict row;
    row["step"] = moment.step;
    row["time"] = moment.time;
    row["base"] = values_of(moment.base);
    row["tip"] = values_of(moment.tip);
    row["length"] = moment.length;
    row["base_radius"] = moment.base_radius;
    row["tip_radius"] = moment.tip_radius;
    row["area"] = moment.area;
    for (std::size_t i = 0; i < history.parameters.size(); ++i) {
        row[py::str(history.parameters[i])] = moment.parameters[i];
    }
    return row;
}

/// What lasts, and a row for each frame that has the organ; None if none has.
py::object history_of(const RecordedRun& run, std::uint64_t identity, std::uint32_t plant) {
    std::optional<OrganHistory> history;
    {
        const py::gil_scoped_release free;
        history = OrganReader().history(run, {plant, identity});
    }
    if (!history) return py::none();
    py::dict lasting;
    lasting["identity"] = identity;
    lasting["plant"] = plant;
    lasting["symbol"] = history->symbol;
    lasting["parent"] = history->parent;
    lasting["order"] = history->order;
    lasting["birth"] = history->birth;
    lasting["death"] = history->death();
    py::list rows;
    for (const OrganMoment& moment : history->moments) rows.append(row_of(*history, moment));
    return py::make_tuple(lasting, rows);
}

std::vector<std::pair<int, double>> frames_in(const RecordedRun& run) {
    std::vector<std::pair<int, double>> frames;
    for (const RecordedFrame& frame : run.frames()) frames.emplace_back(frame.step, frame.time);
    return frames;
}

std::vector<int> steps_named(const RecordedRun& run, const std::string& text) {
    std::vector<int> steps;
    for (const RecordedFrame* frame : chosen_frames(run, text)) steps.push_back(frame->step);
    return steps;
}

void bind_frame(py::module_& module) {
    py::class_<LoadedFrame, std::shared_ptr<LoadedFrame>>(module, "LoadedFrame", "The internodes of a recorded frame.")
        .def("__len__", rows_of)
        .def_property_readonly("base", vectors(&FrameInternode::base))
        .def_property_readonly("tip", vectors(&FrameInternode::tip))
        .def_property_readonly("base_radius", numbers<float>(&FrameInternode::base_radius))
        .def_property_readonly("radius", numbers<float>(&FrameInternode::tip_radius))
        .def_property_readonly("identity", numbers<std::uint64_t>(&FrameInternode::identity))
        .def_property_readonly("parent", numbers<std::uint64_t>(&FrameInternode::parent))
        .def_property_readonly("plant", numbers<std::uint32_t>(&FrameInternode::plant))
        .def_property_readonly("order", numbers<std::uint16_t>(&FrameInternode::order))
        .def_property_readonly("birth", numbers<std::int32_t>(&FrameInternode::birth))
        .def_property_readonly("bearer", numbers<InternodeIndex>(&FrameInternode::bearer))
        .def_property_readonly("symbols", symbols_in)
        .def_property_readonly("parameter_names", parameter_names)
        .def("parameter", parameter_in, py::arg("name"));
}

}  // namespace

PYBIND11_MODULE(_recorded, module) {
    module.doc() = "Espalier's reader of recorded runs; use espalier.open() instead";
    bind_frame(module);
    py::class_<RecordedRun>(module, "RecordedRun")
        .def(py::init<const std::filesystem::path&>(), py::arg("path"))
        .def_property_readonly("frames", frames_in, "Step and time of each.")
        .def_property_readonly("exit", &RecordedRun::exit)
        .def_property_readonly("field_names", &RecordedRun::field_names)
        .def("plant", &RecordedRun::plant, py::arg("name"))
        .def("frame", frame_at, py::arg("step"))
        .def("field", field_at, py::arg("name"), py::arg("step"))
        .def("organs", organs_of, py::arg("steps"))
        .def("chosen_steps", steps_named, py::arg("text"))
        .def("history", history_of, py::arg("identity"), py::arg("plant"));
    refuse_unmade(module);
}

}  // namespace espalier::python
