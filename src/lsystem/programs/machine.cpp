#include "lsystem/programs/machine.h"

#include "espalier/base/math.h"
#include "espalier/base/stop.h"
#include "espalier/lsystem/expression.h"
#include "espalier/lsystem/resources.h"

#include "lsystem/programs/functions.h"
#include "lsystem/programs/limits.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <functional>
#include <span>

namespace espalier::lsystem {
namespace {

/// An element counted from 1 by a number that is truncated; null if there is none.
template <class T>
const T* numbered(const std::vector<T>& all, double id) {
    const double whole = std::trunc(id);
    return whole >= 1 && whole <= static_cast<double>(all.size()) ? &all[static_cast<std::size_t>(whole) - 1] : nullptr;
}

/// Extents are numbered vvXmin, vvXmax, vvYmin, vvYmax, vvZmin, vvZmax, vvScale.
double extent_of_view(const Resources& resources, std::uint32_t which) {
    const double extents[] = {resources.x_min, resources.x_max, resources.y_min,     resources.y_max,
                              resources.z_min, resources.z_max, resources.view_scale};
    return extents[which];
}

/// func, curveX, curveY, curveZ and curveGAL; `resources` may be null. A wrong id has the value 0, and `warn` is
/// called.
double side_value(const Resources* resources, Function function, std::span<const double> values,
                  const std::function<void(const std::string&)>& warn) {
    static const Resources none;
    const Resources& known = resources ? *resources : none;
    const FunctionCurve* const plane = function == Function::func ? numbered(known.functions, values[0]) : nullptr;
    const SpaceCurve* const space = function != Function::func ? numbered(known.curves, values[0]) : nullptr;
    if (!plane && !space) {
        const char* const what = function == Function::func ? "function" : "curve";
        const std::size_t count = function == Function::func ? known.functions.size() : known.curves.size();
        const std::string hint = count == 0 ? "a view file names them: give it with --view"
                                            : fmt::format("there are {}, counted from 1", count);
        warn(fmt::format("{}: there is no {} {:g}, so its value is 0; {}", name_of(function), what, values[0], hint));
        return 0;
    }
    if (function == Function::curve_gal) return space->length();
    if (std::isnan(values[1])) return values[1];
    if (plane) return (*plane)(values[1]);
    const glm::dvec3 point = (*space)(values[1]);
    return function == Function::curve_x ? point.x : function == Function::curve_y ? point.y : point.z;
}

constexpr std::uint64_t turns_between_looks = 1024;

[[noreturn]] void refuse_loop(const Place& place) {
    throw EvaluationError(place, fmt::format("the loop does not end: it was stopped after {} turns", most_turns));
}

std::string filled(const PrintCall& call, const double* registers) {
    std::vector<PrintFormat::Value> values;
    for (const PrintCall::Argument& argument : call.arguments) {
        values.push_back({argument.text ? 0 : registers[argument.reg], argument.text});
    }
    return call.format.fill(values);
}

}  // namespace

Machine::Machine(const std::vector<double>& constants, std::size_t registers, const std::vector<CompiledArray>& arrays,
                 Arithmetic arithmetic)
    : registers_(registers), first_formal_(constants.size()), arrays_(arrays), arithmetic_(arithmetic) {
    std::copy(constants.begin(), constants.end(), registers_.begin());
}

void Machine::run(const Program& program) {
    double* const r = registers_.data();
    const Instruction* const code = program.code.data();
    std::uint64_t turns = 0;
    for (const Instruction* at = code;; ++at) {
        const Instruction i = *at;
        const auto place = [&]() -> const Place& { return *program.places[static_cast<std::size_t>(at - code)]; };
        switch (i.op) {
            case Opcode::end:
                return;
            case Opcode::copy:
                r[i.target] = r[i.a];
                break;
            case Opcode::negate:
                r[i.target] = -r[i.a];
                break;
            case Opcode::logical_not:
                r[i.target] = r[i.a] == 0;
                break;
            case Opcode::power:
                r[i.target] = math::pow(r[i.a], r[i.b]);
                break;
            case Opcode::multiply:
                r[i.target] = r[i.a] * r[i.b];
                break;
            case Opcode::divide:
                r[i.target] = r[i.b] != 0 ? r[i.a] / r[i.b] : divide(r[i.a], r[i.b], arithmetic_, place());
                break;
            case Opcode::remainder:
                r[i.target] = remainder(r[i.a], r[i.b], arithmetic_, place());
                break;
            case Opcode::add:
                r[i.target] = r[i.a] + r[i.b];
                break;
            case Opcode::subtract:
                r[i.target] = r[i.a] - r[i.b];
                break;
            case Opcode::less:
                r[i.target] = r[i.a] < r[i.b];
                break;
            case Opcode::less_equal:
                r[i.target] = r[i.a] <= r[i.b];
                break;
            case Opcode::greater:
                r[i.target] = r[i.a] > r[i.b];
                break;
            case Opcode::greater_equal:
                r[i.target] = r[i.a] >= r[i.b];
                break;
            case Opcode::equal:
                r[i.target] = r[i.a] == r[i.b];
                break;
            case Opcode::not_equal:
                r[i.target] = r[i.a] != r[i.b];
                break;
            case Opcode::is_true:
                r[i.target] = r[i.a] != 0;
                break;
            case Opcode::held:
                r[i.target] = held_by_or(r[i.a]);
                break;
            case Opcode::single:
                r[i.target] = stored(r[i.a], Arithmetic::cpfg);
                break;
            case Opcode::call:
                r[i.target] = call(i, place());
                break;
            case Opcode::load_global:
                r[i.target] = variables_->globals[i.a];
                break;
            case Opcode::store_global:
                variables_->globals[i.a] = r[i.target];
                break;
            case Opcode::load_external:
                r[i.target] = *variables_->external_globals[i.a];
                break;
            case Opcode::store_external:
                *variables_->external_globals[i.a] = r[i.target];
                break;
            case Opcode::load_element:
                r[i.target] = *element(i, place());
                break;
            case Opcode::store_element:
                *element(i, place()) = r[i.target];
                break;
            case Opcode::jump:
                at = code + i.b - 1;
                break;
            case Opcode::jump_if_false:
                if (r[i.a] == 0) at = code + i.b - 1;
                break;
            case Opcode::jump_if_true:
                if (r[i.a] != 0) at = code + i.b - 1;
                break;
            case Opcode::repeat:
                if (++turns % turns_between_looks == 0) end_if_asked();
                if (turns > most_turns) refuse_loop(place());
                break;
            case Opcode::print:
                if (i.b == 1) throw EvaluationError(place(), filled(program.prints[i.a], r));  // error(...)
                r[i.target] = print(program.prints[i.a], place());
                break;
            case Opcode::file_open: {
                const OpenCall& file = program.opens[i.a];
                r[i.target] = services_->files->open(*file.name, *file.mode, place());
                break;
            }
            case Opcode::file_scan:
                r[i.target] = scan(program.scans[i.a], place());
                break;
        }
    }
}

double Machine::call(const Instruction& instruction, const Place& place) {
    const std::span<const double> values(registers_.data() + instruction.a, instruction.count);
    if (is_pure(instruction.function)) return lsystem::call(instruction.function, values, arithmetic_);
    if (lsystem::samples(instruction.function)) return sample(instruction.function, values, random_, place);
    switch (instruction.function) {
        case Function::srand:
            // The stream begins anew with the seed, whoever takes numbers from it.
            services_->salt = std::bit_cast<std::uint64_t>(values[0]);
            random_ = RandomSamples(RandomKey(services_->seed, services_->plant, stream_, services_->salt), 0, 0);
            reseeded_ = true;
            return values[0];
        case Function::stop:
            services_->stopped = true;
            return 0;
        case Function::get_derivation_length:
            return variables_->length();
        case Function::set_derivation_length:
            if (!(values[0] >= 0 && values[0] <= 1e9)) {
                throw EvaluationError(place, fmt::format("a derivation length of {:g} is out of range", values[0]));
            }
            return variables_->length() = std::trunc(values[0]);
        case Function::func:
        case Function::curve_x:
        case Function::curve_y:
        case Function::curve_z:
        case Function::curve_gal:
            return side_value(services_->resources, instruction.function, values,
                              [&](const std::string& message) { services_->warn(place, message); });
        case Function::view_extent:
            if (!services_->resources)
                services_->warn(place, "the view's extents are those of no view file: give it with --view");
            return extent_of_view(services_->resources ? *services_->resources : Resources(), instruction.b);
        case Function::file_close:
            return services_->files->close(values[0]) ? 0 : warn_of_file(instruction.function, values[0], place);
        case Function::file_flush:
            return services_->files->flush(values[0]) ? 0 : warn_of_file(instruction.function, values[0], place);
        default:
            return 0;
    }
}

double* Machine::element(const Instruction& instruction, const Place& place) {
    const CompiledArray& array = arrays_[instruction.a];
    std::size_t index = 0;
    for (std::size_t k = 0; k < array.dimensions.size(); ++k) {
        const auto size = static_cast<double>(array.dimensions[k]);
        double subscript = std::trunc(registers_[instruction.b + k]);
        if (!(subscript >= 0 && subscript < size)) {
            if (arithmetic_ != Arithmetic::cpfg) {
                throw EvaluationError(place, fmt::format("subscript {:g} of array '{}' is out of range: 0 to {:g}",
                                                         subscript, array.name, size - 1));
            }
            subscript = subscript >= size ? size - 1 : 0;
        }
        index = index * array.dimensions[k] + static_cast<std::size_t>(subscript);
    }
    if (array.external) return &(*variables_->external_arrays[instruction.a])[index];
    return &variables_->arrays[instruction.a][index];
}

double Machine::print(const PrintCall& call, const Place& place) {
    if (call.arguments.size() < call.format.conversions()) {
        services_->warn(place,
                        fmt::format("the format asks for {} values and is given {}; those that are missing are 0",
                                    call.format.conversions(), call.arguments.size()));
    }
    const std::string text = filled(call, registers_.data());
    if (text.size() > most_printed_at_once) {
        throw EvaluationError(place, fmt::format("more than {} bytes are printed at once", most_printed_at_once));
    }
    if (!call.file) {
        services_->print(text);
    } else if (const double file = registers_[*call.file]; !services_->files->print(file, text, place)) {
        return warn_of_file(Function::file_print, file, place);
    }
    return static_cast<double>(text.size());
}

double Machine::scan(const ScanCall& call, const Place& place) {
    const double file = registers_[call.file];
    const int read = services_->files->scan(file, call.format, registers_.data() + call.first);
    return read == -2 ? warn_of_file(Function::file_scan, file, place) : read;
}

/// The value of a call for a file that is not open, -1 as in C.
double Machine::warn_of_file(Function function, double file, const Place& place) {
    services_->warn(place, fmt::format("{}: no file {:g} is open for that", name_of(function), file));
    return -1;
}

}  // namespace espalier::lsystem
