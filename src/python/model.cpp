// Models and the strings that they derive.
#include "espalier/simulation/simulation.h"

#include "base/text.h"
#include "python/bindings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace espalier::python {

namespace {

Plant read_plant(const std::optional<std::filesystem::path>& path, const std::optional<std::string>& text,
                 const py::kwargs& values) {
    if (path.has_value() == text.has_value()) throw UserError("a Model takes either a path or text=...");
    Defines defines;
    for (const auto& [name, value] : values) defines[py::str(name)] = py::str(value);
    const py::gil_scoped_release free;
    return path ? plant_of_file(*path, defines) : plant_of_text(*text, "text", defines);
}

BoundString derive(const Plant& plant, std::optional<int> steps, std::uint64_t seed) {
    if (steps && *steps < 0) throw UserError("the number of steps must not be negative");
    const Model& model = source_of(*plant.model);
    auto now = std::make_shared<ModuleString>();
    {
        const py::gil_scoped_release free;
        DerivationSettings settings;
        settings.seed = seed;
        settings.lineage = true;
        settings.memory = default_memory();
        settings.input_folder = folder_with(model);
        Derivation derivation(plant.model, settings);
        if (steps) derivation.set_length(*steps);
        ModuleString next;
        derivation.start(*now);
        while (!derivation.stopped() && derivation.steps_done() < derivation.length()) {
            derivation.step(*now, next);
            std::swap(*now, next);
        }
    }
    return {now, std::shared_ptr<const Model>(plant.model, &model)};
}

/// One module of a string, taken out of it.
struct Module {
    std::string symbol;
    std::vector<double> parameters;
    std::uint64_t identity;
};

std::size_t index_in(const BoundString& bound, py::ssize_t index) {
    const auto size = static_cast<py::ssize_t>(bound.string->size());
    if (index < 0) index += size;
    if (index < 0 || index >= size) throw py::index_error("the string has " + std::to_string(size) + " modules");
    return static_cast<std::size_t>(index);
}

Module module_at(const BoundString& bound, py::ssize_t index) {
    const std::size_t i = index_in(bound, index);
    const ModuleString& string = *bound.string;
    const double* first = string.parameters.data();
    return {bound.model->alphabet.name(string.letters[i]),
            {first + bound.offsets[i], first + bound.offsets[i + 1]},
            string.has_lineage() ? string.identity(i) : 0};
}

BoundString slice_of(const BoundString& bound, const py::slice& slice) {
    std::size_t start = 0, stop = 0, step = 0, count = 0;
    if (!slice.compute(bound.string->size(), &start, &stop, &step, &count)) throw py::error_already_set();
    const ModuleString& string = *bound.string;
    auto part = std::make_shared<ModuleString>();
    if (string.has_lineage()) part->siblings = string.siblings;
    for (std::size_t n = 0, i = start; n < count; ++n, i += step) {
        part->append(string.letters[i],
                     {string.parameters.data() + bound.offsets[i], bound.offsets[i + 1] - bound.offsets[i]});
        if (string.has_lineage()) part->births.push_back(string.births[i]);
    }
    return {part, bound.model};
}

py::array_t<double> column(const BoundString& bound, const std::string& name) {
    const auto [symbol, number] = parameter_named(name);
    py::array_t<double> values(static_cast<py::ssize_t>(bound.string->size()));
    double* value = values.mutable_data();
    for (std::size_t i = 0; i < bound.string->size(); ++i) value[i] = bound.parameter(i, symbol, number);
    return values;
}

py::array_t<std::uint64_t> identities(const BoundString& bound) {
    py::array_t<std::uint64_t> values(static_cast<py::ssize_t>(bound.string->size()));
    std::uint64_t* value = values.mutable_data();
    for (std::size_t i = 0; i < bound.string->size(); ++i) {
        value[i] = bound.string->has_lineage() ? bound.string->identity(i) : 0;
    }
    return values;
}

std::vector<std::string> symbols(const BoundString& bound) {
    std::vector<std::string> names;
    for (const LetterId letter : bound.string->letters) names.push_back(bound.model->alphabet.name(letter));
    return names;
}

/// The columns of a string by name.
struct Parameters {
    BoundString string;
    std::vector<std::string> names;  ///< in the order of their first module
};

Parameters parameters_of(const BoundString& bound) {
    Parameters parameters{bound, {}};
    std::map<LetterId, std::size_t> known;
    for (std::size_t i = 0; i < bound.string->size(); ++i) {
        const LetterId letter = bound.string->letters[i];
        const std::size_t count = bound.offsets[i + 1] - bound.offsets[i];
        std::size_t& so_far = known[letter];
        for (; so_far < count; ++so_far) {
            parameters.names.push_back(bound.model->alphabet.name(letter) + "." + std::to_string(so_far + 1));
        }
    }
    return parameters;
}

bool has_parameter(const Parameters& parameters, const std::string& name) {
    return std::find(parameters.names.begin(), parameters.names.end(), name) != parameters.names.end();
}

py::array_t<double> parameter(const Parameters& parameters, const std::string& name) {
    if (!has_parameter(parameters, name)) throw py::key_error(name);
    return column(parameters.string, name);
}

void bind_parameters(py::module_& module) {
    py::class_<Parameters>(module, "Parameters", "Columns of a string by name: parameters[\"A.1\"], as of column().")
        .def("__len__", [](const Parameters& parameters) { return parameters.names.size(); })
        .def("__iter__", [](const Parameters& parameters) { return py::iter(py::cast(parameters.names)); })
        .def("__contains__", has_parameter)
        .def("__getitem__", parameter)
        .def("keys", [](const Parameters& parameters) { return parameters.names; });
}

std::string text_of(const BoundString& bound) {
    return to_text(*bound.string, bound.model->alphabet);
}

std::string shown(const Module& module) {
    std::string text = module.symbol;
    for (std::size_t k = 0; k < module.parameters.size(); ++k) {
        text += (k == 0 ? "(" : ", ") + format_general(module.parameters[k]);
    }
    return module.parameters.empty() ? text : text + ")";
}

/// So much that a cell of a notebook is not flooded.
std::string shown(const BoundString& bound) {
    constexpr std::size_t most_letters = 400, most_modules = 100;
    const std::size_t modules = bound.string->size();
    std::string text = text_of(modules > most_modules ? slice_of(bound, py::slice(0, most_modules, 1)) : bound);
    if (modules <= most_modules && text.size() <= most_letters) return text;
    text.resize(std::min(text.size(), most_letters));
    return text + "... (" + std::to_string(modules) + " modules)";
}

}  // namespace

BoundString::BoundString(std::shared_ptr<const ModuleString> modules, std::shared_ptr<const Model> of)
    : string(std::move(modules)), model(std::move(of)), offsets(parameter_offsets(*string, model->alphabet)) {}

double BoundString::parameter(std::size_t place, const std::string& symbol, int number) const {
    const std::size_t at = offsets[place] + static_cast<std::size_t>(number) - 1;
    const bool has_it = at < offsets[place + 1] && model->alphabet.name(string->letters[place]) == symbol;
    return has_it ? string->parameters[at] : std::numeric_limits<double>::quiet_NaN();
}

std::pair<std::string, int> parameter_named(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    int number = 0;
    if (dot != std::string::npos) std::from_chars(name.data() + dot + 1, name.data() + name.size(), number);
    if (number < 1) throw UserError("'" + name + "' names no parameter: write symbol and number, \"I.3\"");
    return {name.substr(0, dot), number};
}

void bind_model(py::module_& module) {
    bind_parameters(module);
    py::class_<Module>(module, "Module", "One module: its symbol, its parameters and its identity for life.")
        .def_readonly("symbol", &Module::symbol, "Its letter, or several: \"F\", \"?light\".")
        .def_readonly("parameters", &Module::parameters, "Its parameters, a list of numbers.")
        .def_readonly("identity", &Module::identity, "A number that it alone has, for life.")
        .def("__repr__", [](const Module& one) { return shown(one); });

    py::class_<BoundString>(module, "ModuleString", "A string of modules; it does not change.")
        .def("__len__", [](const BoundString& bound) { return bound.string->size(); })
        .def("__getitem__", module_at)
        .def("__getitem__", slice_of)
        .def("__str__", text_of, "The string in cpfg's notation.")
        .def("__repr__", [](const BoundString& bound) { return shown(bound); })
        .def_property_readonly("symbols", symbols, "Symbols of the modules, a list of n texts.")
        .def_property_readonly("identity", identities, "Identities of the modules, uint64 (n,).")
        .def_property_readonly("parameters", parameters_of, "Columns by name: parameters[\"A.1\"]; dict() takes all.")
        .def("column", column, py::arg("name"),
             "Parameter \"A.1\" (symbol, number from 1) of every module, float64 (n,); NaN where a module has none.");

    py::class_<Plant>(module, "Model", "A model, read and compiled: Model(path) or Model(text=...), with defines.")
        .def(py::init(&read_plant), py::arg("path") = py::none(), py::arg("text") = py::none())
        .def("derive", derive, py::arg("steps") = py::none(), py::arg("seed") = 0,
             "The string after so many derivation steps; default: the model's derivation length.")
        .def_property_readonly("name", [](const Plant& plant) { return source_of(*plant.model).name; });
}

}  // namespace espalier::python
