#include "lsystem/programs/program.h"

#include "lsystem/programs/constant.h"
#include "lsystem/programs/functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::lsystem {
namespace {

// Register names while compiling: what kind, and which.
constexpr std::uint32_t constant_kind = 0;
constexpr std::uint32_t formal_kind = 1u << 30;
constexpr std::uint32_t temporary_kind = 2u << 30;
constexpr std::uint32_t local_kind = 3u << 30;
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

bool is_unary(Operator op) {
    return op == Operator::negate || op == Operator::logical_not;
}

}  // namespace

Effects& Effects::operator|=(const Effects& other) {
    assigns |= other.assigns;
    ordered |= other.ordered;
    samples |= other.samples;
    loops |= other.loops;
    return *this;
}

bool Program::reads_variables() const {
    return std::any_of(code.begin(), code.end(), [](const Instruction& instruction) {
        return instruction.op == Opcode::load_global || instruction.op == Opcode::load_element;
    });
}

// The step and the derivation length are everybody's.
ProgramCompiler::ProgramCompiler(const LSystem& system, bool inner, Arithmetic arithmetic,
                                 const std::optional<std::vector<bool>>& locals)
    : system_(system), arithmetic_(arithmetic), has_locals_(locals), locals_(system.globals.size()) {
    for (std::size_t g = 0; locals && g < locals->size(); ++g) {
        if ((*locals)[g]) locals_[g] = local_count_++;
    }
    external_.assign(system.globals.size(), false);
    if (!inner) return;
    for (std::size_t g = 0; g < system.globals.size(); ++g) {
        const auto& names = system.external_globals;
        external_[g] = g < 2 || std::find(names.begin(), names.end(), system.globals[g]) != names.end();
    }
}

void ProgramCompiler::begin(const std::vector<const Block*>& blocks) {
    program_ = {};
    breaks_.clear();
    for (const Block* const block : blocks) statements(*block);
    next_temporary_ = 0;
}

Program ProgramCompiler::finish(const Place& place) {
    emit({Opcode::end}, place);
    return std::move(program_);
}

Program ProgramCompiler::value(const Expression& expression, const std::vector<const Block*>& blocks) {
    begin(blocks);
    program_.results.push_back(reg(compile(expression)));
    return finish(expression.place);
}

Program ProgramCompiler::arguments(const std::vector<ModuleTemplate>& modules,
                                   const std::vector<const Block*>& blocks) {
    std::vector<const Expression*> all;
    for (const ModuleTemplate& module : modules) {
        for (const Expression& argument : module.arguments) all.push_back(&argument);
    }
    return values(all, blocks);
}

Program ProgramCompiler::values(const std::vector<const Expression*>& expressions,
                                const std::vector<const Block*>& blocks) {
    begin(blocks);
    for (const Expression* const each : expressions) {
        const bool text = each->kind == Expression::Kind::text;
        const Operand value = text ? Operand{true, double(each->index), 0} : compile(*each);
        program_.results.push_back(reg(kept(value, each->place)));
    }
    return finish({});
}

/// A value as the string keeps it.
ProgramCompiler::Operand ProgramCompiler::kept(const Operand& value, const Place& place) {
    if (arithmetic_ != Arithmetic::cpfg) return value;
    if (value.constant) return {true, stored(value.number, arithmetic_), 0};
    return emit({Opcode::single, Function::sin, 0, temporary(), value.reg, 0}, place);
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
            if (const auto local = locals_.at(expression.index)) {
                return emit({Opcode::copy, Function::sin, 0, temporary(), local_kind | *local, 0}, expression.place);
            }
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
    const bool is_held = arithmetic_ == Arithmetic::cpfg && keeps_left_of_or(expression);
    const Opcode test = is_held ? Opcode::held : Opcode::is_true;
    emit({test, Function::sin, 0, target, reg(compile(expression.operands[0])), 0}, expression.place);
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
    const bool global = target.kind == Expression::Kind::global;
    const std::optional<std::uint32_t> local = global ? locals_.at(target.index) : std::nullopt;
    const bool formal = target.kind == Expression::Kind::formal;
    program_.effects.assigns |= !local && !(formal && has_locals_);
    if (formal || local) {
        const std::uint32_t to = formal ? formal_kind | target.index : local_kind | *local;
        emit({Opcode::copy, Function::sin, 0, to, value, 0}, place);
    } else if (global) {
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
    return constant_value(expression, arithmetic_);
}

std::uint32_t ProgramCompiler::register_count(std::uint32_t formals) const {
    return static_cast<std::uint32_t>(constants().size()) + formals + local_count_ + most_temporaries_ + 1;
}

void ProgramCompiler::place_registers(Program& program, std::uint32_t formals) const {
    const auto first_formal = static_cast<std::uint32_t>(constants().size());
    const auto placed = [&](std::uint32_t& name) {
        const std::uint32_t index = name & ~kind_mask;
        const std::uint32_t kind = name & kind_mask;
        name = index;
        if (kind != constant_kind) name += first_formal;
        if (kind == local_kind || kind == temporary_kind) name += formals;
        if (kind == temporary_kind) name += local_count_;
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

}  // namespace espalier::lsystem
