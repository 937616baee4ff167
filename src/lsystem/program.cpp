#include "program.h"

#include "functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier {
namespace {

// Register names while compiling: what kind, and which.
constexpr std::uint32_t constant_kind = 0;
constexpr std::uint32_t formal_kind = 1u << 30;
constexpr std::uint32_t temporary_kind = 2u << 30;
constexpr std::uint32_t kind_mask = 3u << 30;

Opcode opcode(Operator op) {
    switch (op) {
        case Operator::negate:
            return Opcode::negate;
        case Operator::logical_not:
            return Opcode::logical_not;
        case Operator::power:
            return Opcode::power;
        case Operator::multiply:
            return Opcode::multiply;
        case Operator::divide:
            return Opcode::divide;
        case Operator::remainder:
            return Opcode::remainder;
        case Operator::add:
            return Opcode::add;
        case Operator::subtract:
            return Opcode::subtract;
        case Operator::less:
            return Opcode::less;
        case Operator::less_equal:
            return Opcode::less_equal;
        case Operator::greater:
            return Opcode::greater;
        case Operator::greater_equal:
            return Opcode::greater_equal;
        case Operator::equal:
            return Opcode::equal;
        default:
            return Opcode::not_equal;
    }
}

bool reads_b(Opcode op) {
    return op >= Opcode::power && op <= Opcode::not_equal;
}

bool reads_a(Opcode op) {
    return (op >= Opcode::copy && op <= Opcode::call) || op == Opcode::jump_if_false || op == Opcode::jump_if_true;
}

bool is_unary(Operator op) {
    return op == Operator::negate || op == Operator::logical_not;
}

}  // namespace

Effects& Effects::operator|=(const Effects& other) {
    assigns |= other.assigns;
    ordered |= other.ordered;
    draws |= other.draws;
    loops |= other.loops;
    return *this;
}

bool Program::reads_variables() const {
    return std::any_of(code.begin(), code.end(), [](const Instruction& instruction) {
        return instruction.op == Opcode::load_global || instruction.op == Opcode::load_element;
    });
}

// The step and the derivation length are everybody's.
ProgramCompiler::ProgramCompiler(const LSystem& system, bool inner, bool quirks) : system_(system), quirks_(quirks) {
    external_.assign(system.globals.size(), false);
    if (!inner) return;
    for (std::size_t g = 0; g < system.globals.size(); ++g) {
        const auto& names = system.external_globals;
        external_[g] = g < 2 || std::find(names.begin(), names.end(), system.globals[g]) != names.end();
    }
}

void ProgramCompiler::begin() {
    program_ = {};
    next_temporary_ = 0;
    breaks_.clear();
}

Program ProgramCompiler::finish(const Place& place) {
    emit({Opcode::end}, place);
    return std::move(program_);
}

Program ProgramCompiler::value(const Expression& expression) {
    begin();
    program_.results.push_back(reg(compile(expression)));
    return finish(expression.place);
}

Program ProgramCompiler::arguments(const std::vector<ModuleTemplate>& modules) {
    begin();
    for (const ModuleTemplate& module : modules) {
        for (const Expression& argument : module.arguments) {
            const bool text = argument.kind == Expression::Kind::text;
            const Operand value = text ? Operand{true, double(argument.index), 0} : compile(argument);
            program_.results.push_back(reg(value));
        }
    }
    return finish({});
}

Program ProgramCompiler::block(const Block& block) {
    begin();
    statements(block);
    return finish({});
}

std::uint32_t ProgramCompiler::temporary() {
    return temporaries(1);
}

std::uint32_t ProgramCompiler::temporaries(std::size_t count) {
    const std::uint32_t first = next_temporary_;
    next_temporary_ += static_cast<std::uint32_t>(count);
    most_temporaries_ = std::max(most_temporaries_, next_temporary_);
    return temporary_kind | first;
}

std::uint32_t ProgramCompiler::reg(const Operand& operand) {
    return operand.constant ? constant_kind | pool_.index(operand.number) : operand.reg;
}

ProgramCompiler::Operand ProgramCompiler::emit(Instruction instruction, const Place& place) {
    program_.code.push_back(instruction);
    program_.places.push_back(&place);
    return {false, 0, instruction.target};
}

std::size_t ProgramCompiler::emit_jump(Opcode op, std::uint32_t tested, const Place& place) {
    emit({op, Function::sin, 0, 0, tested, 0}, place);
    return program_.code.size() - 1;
}

ProgramCompiler::Operand ProgramCompiler::compile(const Expression& expression) {
    if (const std::optional<double> value = fold(expression)) return {true, *value, 0};
    switch (expression.kind) {
        case Expression::Kind::formal:
            return {false, 0, formal_kind | expression.index};
        case Expression::Kind::global:
            return emit({external_.at(expression.index) ? Opcode::load_external : Opcode::load_global, Function::sin, 0,
                         temporary(), expression.index, 0},
                        expression.place);
        case Expression::Kind::element: {
            const std::uint32_t first = subscripts(expression);
            const auto count = static_cast<std::uint16_t>(expression.operands.size());
            return emit({Opcode::load_element, Function::sin, count, temporary(), expression.index, first},
                        expression.place);
        }
        case Expression::Kind::apply:
            return apply(expression);
        case Expression::Kind::conditional:
            return conditional(expression);
        case Expression::Kind::call:
            return function(expression);
        case Expression::Kind::assign:
            return assign(expression);
        case Expression::Kind::text:
            throw UserError(expression.place, "a text cannot stand here");
        case Expression::Kind::address:
            throw UserError(expression.place, "an address cannot stand here");
        case Expression::Kind::number:
            break;
    }
    return {true, expression.value, 0};
}

ProgramCompiler::Operand ProgramCompiler::apply(const Expression& expression) {
    if (expression.op == Operator::logical_and || expression.op == Operator::logical_or) {
        return short_circuit(expression);
    }
    const std::uint32_t a = reg(compile(expression.operands[0]));
    const std::uint32_t b = is_unary(expression.op) ? 0 : reg(compile(expression.operands[1]));
    return emit({opcode(expression.op), Function::sin, 0, temporary(), a, b}, expression.place);
}

ProgramCompiler::Operand ProgramCompiler::short_circuit(const Expression& expression) {
    const std::uint32_t target = temporary();
    const Opcode leave = expression.op == Operator::logical_and ? Opcode::jump_if_false : Opcode::jump_if_true;
    emit({Opcode::is_true, Function::sin, 0, target, reg(compile(expression.operands[0])), 0}, expression.place);
    const std::size_t jump = emit_jump(leave, target, expression.place);
    emit({Opcode::is_true, Function::sin, 0, target, reg(compile(expression.operands[1])), 0}, expression.place);
    land(jump);
    return {false, 0, target};
}

ProgramCompiler::Operand ProgramCompiler::conditional(const Expression& expression) {
    if (const std::optional<double> known = fold(expression.operands[0])) {
        return compile(expression.operands[*known != 0 ? 1 : 2]);
    }
    const std::uint32_t target = temporary();
    const std::uint32_t tested = reg(compile(expression.operands[0]));
    const std::size_t otherwise = emit_jump(Opcode::jump_if_false, tested, expression.place);
    emit({Opcode::copy, Function::sin, 0, target, reg(compile(expression.operands[1])), 0}, expression.place);
    const std::size_t done = emit_jump(Opcode::jump, 0, expression.place);
    land(otherwise);
    emit({Opcode::copy, Function::sin, 0, target, reg(compile(expression.operands[2])), 0}, expression.place);
    land(done);
    return {false, 0, target};
}

void ProgramCompiler::require_arguments(const Expression& expression) const {
    const Arguments allowed = arguments_of(expression.function);
    const auto count = static_cast<int>(expression.operands.size());
    if (count >= allowed.fewest && (allowed.most < 0 || count <= allowed.most)) return;
    throw UserError(expression.place, fmt::format("{} takes {}{} argument{}, not {}", name_of(expression.function),
                                                  allowed.fewest == allowed.most ? "" : "at least ", allowed.fewest,
                                                  allowed.fewest == 1 ? "" : "s", count));
}

ProgramCompiler::Operand ProgramCompiler::function(const Expression& expression) {
    const Function function = expression.function;
    if (function == Function::in_blob) {
        throw UserError(expression.place, "inblob is not available: files of blobs are not read");
    }
    require_arguments(expression);
    if (function == Function::print || function == Function::file_print) return print(expression);
    if (function == Function::file_open) return open_file(expression);
    if (function == Function::file_scan) return scan_file(expression);
    const auto count = static_cast<std::uint16_t>(expression.operands.size());
    std::uint32_t first = 0;
    if (count == 1) {
        first = reg(compile(expression.operands[0]));
    } else if (count > 1) {
        std::vector<std::uint32_t> values;
        for (const Expression& operand : expression.operands) values.push_back(reg(compile(operand)));
        first = temporaries(count);
        for (std::uint32_t k = 0; k < count; ++k) {
            emit({Opcode::copy, Function::sin, 0, first + k, values[k], 0}, expression.place);
        }
    }
    if (draws(function)) program_.effects.draws = true;
    if (has_order(function)) program_.effects.ordered = true;
    return emit({Opcode::call, function, count, temporary(), first, expression.index}, expression.place);
}

ProgramCompiler::Operand ProgramCompiler::print(const Expression& expression) {
    const std::size_t at = expression.function == Function::file_print ? 1 : 0;
    const char* const name = name_of(expression.function);
    const Expression& format = expression.operands[at];
    if (format.kind != Expression::Kind::text) {
        throw UserError(format.place, fmt::format("{} needs a format in quotes", name));
    }
    PrintCall call{PrintFormat(format.text), {}, std::nullopt};
    if (at > 0) call.file = reg(compile(expression.operands[0]));
    const std::size_t given = expression.operands.size() - at - 1;
    for (std::size_t k = 0; k < given; ++k) {
        const Expression& operand = expression.operands[at + 1 + k];
        const bool text = operand.kind == Expression::Kind::text;
        if (k < call.format.conversions() && text != call.format.wants_text(k)) {
            throw UserError(operand.place, text ? "a text needs %s" : "%s needs a text in quotes");
        }
        if (text)
            call.arguments.push_back({&operand.text, 0});
        else
            call.arguments.push_back({nullptr, reg(compile(operand))});
    }
    program_.effects.ordered = true;
    program_.prints.push_back(std::move(call));
    const auto index = static_cast<std::uint32_t>(program_.prints.size() - 1);
    return emit({Opcode::print, expression.function, 0, temporary(), index, 0}, expression.place);
}

ProgramCompiler::Operand ProgramCompiler::open_file(const Expression& expression) {
    for (const Expression& operand : expression.operands) {
        if (operand.kind != Expression::Kind::text) throw UserError(operand.place, "fopen needs texts in quotes");
    }
    program_.effects.ordered = true;
    program_.opens.push_back({&expression.operands[0].text, &expression.operands[1].text});
    const auto index = static_cast<std::uint32_t>(program_.opens.size() - 1);
    return emit({Opcode::file_open, Function::file_open, 0, temporary(), index, 0}, expression.place);
}

// Subscripts of the targets are evaluated before anything is read, as C does.
ProgramCompiler::Operand ProgramCompiler::scan_file(const Expression& expression) {
    const Expression& format = expression.operands[1];
    if (format.kind != Expression::Kind::text) throw UserError(format.place, "fscanf needs a format in quotes");
    ScanCall call{ScanFormat(format.text, format.place), reg(compile(expression.operands[0])), 0};
    const std::size_t given = expression.operands.size() - 2;
    if (given != call.format.conversions()) {
        throw UserError(expression.place, fmt::format("the format asks for {} values, but fscanf is given {} variables",
                                                      call.format.conversions(), given));
    }
    std::vector<std::uint32_t> chosen;
    for (std::size_t k = 0; k < given; ++k) {
        const Expression& operand = expression.operands[2 + k];
        if (operand.kind != Expression::Kind::address) {
            throw UserError(operand.place, "fscanf needs the address of a variable: write '&' before it");
        }
        const Expression& target = operand.operands[0];
        chosen.push_back(target.kind == Expression::Kind::element ? subscripts(target) : 0);
    }
    const std::uint32_t first = call.first = temporaries(given + 1);
    program_.effects.ordered = true;
    program_.scans.push_back(std::move(call));
    const auto index = static_cast<std::uint32_t>(program_.scans.size() - 1);
    const Operand count = emit({Opcode::file_scan, Function::file_scan, 0, temporary(), index, 0}, expression.place);
    std::vector<std::size_t> done;
    for (std::uint32_t k = 0; k < given; ++k) {
        const std::uint32_t position = constant_kind | pool_.index(k);
        const std::uint32_t read = temporary();
        emit({Opcode::less, Function::sin, 0, read, position, count.reg}, expression.place);
        done.push_back(emit_jump(Opcode::jump_if_false, read, expression.place));
        store(expression.operands[2 + k].operands[0], chosen[k], first + k, expression.place);
    }
    for (const std::size_t jump : done) land(jump);
    return count;
}

std::uint32_t ProgramCompiler::subscripts(const Expression& element) {
    const ArrayDeclaration& array = system_.arrays.at(element.index);
    if (element.operands.size() != array.dimensions.size()) {
        throw UserError(element.place,
                        fmt::format("array '{}' has {} dimension{}, not {}", array.name, array.dimensions.size(),
                                    array.dimensions.size() == 1 ? "" : "s", element.operands.size()));
    }
    std::vector<std::uint32_t> values;
    for (const Expression& operand : element.operands) values.push_back(reg(compile(operand)));
    const std::uint32_t first = temporaries(values.size());
    for (std::uint32_t k = 0; k < values.size(); ++k) {
        emit({Opcode::copy, Function::sin, 0, first + k, values[k], 0}, element.place);
    }
    return first;
}

ProgramCompiler::Operand ProgramCompiler::assign(const Expression& expression) {
    const Expression& target = expression.operands[0];
    const std::uint32_t first = target.kind == Expression::Kind::element ? subscripts(target) : 0;
    const std::uint32_t value = reg(compile(expression.operands[1]));
    store(target, first, value, expression.place);
    return {false, 0, value};
}

void ProgramCompiler::store(const Expression& target, std::uint32_t subscripts, std::uint32_t value,
                            const Place& place) {
    program_.effects.assigns = true;
    if (target.kind == Expression::Kind::formal) {
        emit({Opcode::copy, Function::sin, 0, formal_kind | target.index, value, 0}, place);
    } else if (target.kind == Expression::Kind::global) {
        const Opcode op = external_.at(target.index) ? Opcode::store_external : Opcode::store_global;
        emit({op, Function::sin, 0, value, target.index, 0}, place);
    } else if (target.kind == Expression::Kind::element) {
        const auto count = static_cast<std::uint16_t>(target.operands.size());
        emit({Opcode::store_element, Function::sin, count, value, target.index, subscripts}, target.place);
    } else {
        throw UserError(target.place, "only variables, parameters and array elements can be assigned");
    }
}

void ProgramCompiler::statements(const Block& block) {
    for (const Statement& each : block) {
        next_temporary_ = 0;
        statement(each);
    }
}

void ProgramCompiler::statement(const Statement& statement) {
    switch (statement.kind) {
        case Statement::Kind::expression:
            if (!statement.expressions.empty() && statement.expressions[0]) compile(*statement.expressions[0]);
            break;
        case Statement::Kind::branch:
            branch(statement);
            break;
        case Statement::Kind::while_loop:
        case Statement::Kind::do_loop:
        case Statement::Kind::for_loop:
            loop(statement);
            break;
        case Statement::Kind::break_loop:
            if (breaks_.empty()) throw UserError(statement.place, "break stands outside a loop");
            breaks_.back().push_back(emit_jump(Opcode::jump, 0, statement.place));
            break;
    }
}

void ProgramCompiler::condition_jump(const std::optional<Expression>& condition, std::vector<std::size_t>& exits) {
    if (!condition) return;
    const std::uint32_t tested = reg(compile(*condition));
    exits.push_back(emit_jump(Opcode::jump_if_false, tested, condition->place));
}

void ProgramCompiler::branch(const Statement& statement) {
    std::vector<std::size_t> done;
    for (std::size_t k = 0; k < statement.bodies.size(); ++k) {
        std::vector<std::size_t> otherwise;
        if (k < statement.expressions.size()) condition_jump(statement.expressions[k], otherwise);
        statements(statement.bodies[k]);
        if (k + 1 < statement.bodies.size()) done.push_back(emit_jump(Opcode::jump, 0, statement.place));
        for (const std::size_t jump : otherwise) land(jump);
    }
    for (const std::size_t jump : done) land(jump);
}

void ProgramCompiler::loop(const Statement& statement) {
    static const std::optional<Expression> none;
    const bool counted = statement.kind == Statement::Kind::for_loop;
    const auto expression = [&](std::size_t k) -> const std::optional<Expression>& {
        return k < statement.expressions.size() ? statement.expressions[k] : none;
    };
    const std::optional<Expression>& condition = expression(counted ? 1 : 0);
    if (counted && expression(0)) compile(*expression(0));
    program_.effects.loops = true;
    breaks_.emplace_back();
    const auto top = static_cast<std::uint32_t>(program_.code.size());
    emit({Opcode::repeat}, statement.place);
    if (statement.kind != Statement::Kind::do_loop) condition_jump(condition, breaks_.back());
    for (const Block& body : statement.bodies) statements(body);
    if (statement.kind == Statement::Kind::do_loop) condition_jump(condition, breaks_.back());
    if (counted && expression(2)) compile(*expression(2));
    program_.code[emit_jump(Opcode::jump, 0, statement.place)].b = top;
    for (const std::size_t jump : breaks_.back()) land(jump);
    breaks_.pop_back();
}

std::optional<double> ProgramCompiler::fold(const Expression& expression) const {
    if (expression.kind == Expression::Kind::number) return expression.value;
    if (expression.kind == Expression::Kind::call) return fold_call(expression);
    if (expression.kind == Expression::Kind::conditional) {
        const std::optional<double> condition = fold(expression.operands[0]);
        if (!condition) return std::nullopt;
        return fold(expression.operands[*condition != 0 ? 1 : 2]);
    }
    if (expression.kind != Expression::Kind::apply) return std::nullopt;
    const std::optional<double> a = fold(expression.operands[0]);
    if (!a) return std::nullopt;
    if (is_unary(expression.op)) return espalier::apply(expression.op, *a, 0);
    if (expression.op == Operator::logical_and && *a == 0) return 0;
    if (expression.op == Operator::logical_or && *a != 0) return 1;
    const std::optional<double> b = fold(expression.operands[1]);
    if (!b) return std::nullopt;
    try {
        if (expression.op == Operator::divide) return espalier::divide(*a, *b, quirks_, expression.place);
        if (expression.op == Operator::remainder) return espalier::remainder(*a, *b, quirks_, expression.place);
    } catch (const EvaluationError& error) {
        throw UserError(error.place, error.what());
    }
    return espalier::apply(expression.op, *a, *b);
}

std::optional<double> ProgramCompiler::fold_call(const Expression& expression) const {
    if (!is_pure(expression.function)) return std::nullopt;
    require_arguments(expression);
    std::vector<double> values;
    for (const Expression& operand : expression.operands) {
        const std::optional<double> value = fold(operand);
        if (!value) return std::nullopt;
        values.push_back(*value);
    }
    return espalier::call(expression.function, values, quirks_);
}

std::uint32_t ProgramCompiler::register_count(std::uint32_t formals) const {
    return static_cast<std::uint32_t>(constants().size()) + formals + most_temporaries_ + 1;
}

void ProgramCompiler::place_registers(Program& program, std::uint32_t formals) const {
    const auto first_formal = static_cast<std::uint32_t>(constants().size());
    const auto placed = [&](std::uint32_t& name) {
        const std::uint32_t index = name & ~kind_mask;
        const std::uint32_t kind = name & kind_mask;
        name = index + (kind == constant_kind ? 0 : kind == formal_kind ? first_formal : first_formal + formals);
    };
    for (Instruction& instruction : program.code) {
        const Opcode op = instruction.op;
        placed(instruction.target);
        if (reads_a(op)) placed(instruction.a);
        if (reads_b(op) || op == Opcode::load_element || op == Opcode::store_element) placed(instruction.b);
    }
    for (std::uint32_t& result : program.results) placed(result);
    for (PrintCall& call : program.prints) {
        for (PrintCall::Argument& argument : call.arguments) placed(argument.reg);
        if (call.file) placed(*call.file);
    }
    for (ScanCall& call : program.scans) {
        placed(call.file);
        placed(call.first);
    }
}

}  // namespace espalier
