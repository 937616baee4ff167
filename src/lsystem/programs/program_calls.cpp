// Calls of functions: their arguments, their effects, texts and files.
#include "lsystem/programs/functions.h"
#include "lsystem/programs/program.h"

#include <fmt/format.h>

namespace espalier::lsystem {

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
    if (samples(function)) program_.effects.samples = true;
    if (has_order(function)) program_.effects.ordered = true;
    return emit({Opcode::call, function, count, temporary(), first, expression.index}, expression.place);
}

ProgramCompiler::Operand ProgramCompiler::print(const Expression& expression) {
    const std::size_t at = expression.function == Function::file_print ? 1 : 0;
    const bool is_error = expression.function == Function::print && expression.index == 1;
    const char* const name = is_error ? "error" : name_of(expression.function);
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
    return emit({Opcode::print, expression.function, 0, temporary(), index, is_error}, expression.place);
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
        const std::uint32_t position = reg({true, double(k), 0});
        const std::uint32_t read = temporary();
        emit({Opcode::less, Function::sin, 0, read, position, count.reg}, expression.place);
        done.push_back(emit_jump(Opcode::jump_if_false, read, expression.place));
        store(expression.operands[2 + k].operands[0], chosen[k], first + k, expression.place);
    }
    for (const std::size_t jump : done) land(jump);
    return count;
}

}  // namespace espalier::lsystem
