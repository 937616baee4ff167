// Compiled expressions and statements: straight lines of register instructions with jumps.
#pragma once

#include "espalier/lsystem/lsystem.h"

#include "lsystem/programs/print_format.h"
#include "lsystem/programs/scan_format.h"

#include <bit>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace espalier::lsystem {

enum class Opcode : std::uint8_t {
    end,
    copy,
    negate,
    logical_not,
    power,
    multiply,
    divide,
    remainder,
    add,
    subtract,
    less,
    less_equal,
    greater,
    greater_equal,
    equal,
    not_equal,
    is_true,  // target = a != 0
    held,     // target = what cpfg makes of a left of ||
    single,   // target = a, rounded to a 32-bit float
    call,     // target = function(count registers from a)
    load_global,
    store_global,   // a = index of the global; store takes `target`
    load_external,  // a = index of a global that belongs to the surrounding L-system
    store_external,
    load_element,
    store_element,  // a = array, subscripts in count registers from b
    jump,
    jump_if_false,
    jump_if_true,  // to instruction b, testing register a
    repeat,        // one more turn of a loop
    print,         // PrintCall a
    file_open,     // OpenCall a
    file_scan,     // ScanCall a
};

// Whether register a or b of an instruction is an operand.
inline bool reads_a(Opcode op) {
    return (op >= Opcode::copy && op <= Opcode::call) || op == Opcode::jump_if_false || op == Opcode::jump_if_true;
}

inline bool reads_b(Opcode op) {
    return op >= Opcode::power && op <= Opcode::not_equal;
}

/// Registers: the model's constants, then the formals of the production at hand, then variables of its own and
/// temporaries.
struct Instruction {
    Opcode op = Opcode::end;
    Function function = Function::sin;
    std::uint16_t count = 0;
    std::uint32_t target = 0, a = 0, b = 0;
};

struct PrintCall {
    PrintFormat format;
    struct Argument {
        const std::string* text = nullptr;
        std::uint32_t reg = 0;
    };
    std::vector<Argument> arguments;
    std::optional<std::uint32_t> file;  ///< register of the file's handle; none: the terminal
};

struct OpenCall {
    const std::string* name = nullptr;
    const std::string* mode = nullptr;
};

/// Values go to registers from `first`.
struct ScanCall {
    ScanFormat format;
    std::uint32_t file = 0;
    std::uint32_t first = 0;
};

/// What a program does besides computing values.
struct Effects {
    bool assigns = false;  ///< writes globals or arrays
    bool ordered = false;  ///< prints, uses files, seeds, stops or changes the derivation length
    bool samples = false;  ///< takes random numbers
    bool loops = false;

    Effects& operator|=(const Effects& other);
};

struct Program {
    std::vector<Instruction> code;
    std::vector<const Place*> places;  ///< place of each instruction
    std::vector<std::uint32_t> results;
    std::vector<PrintCall> prints;
    std::vector<OpenCall> opens;
    std::vector<ScanCall> scans;
    Effects effects;

    bool empty() const { return code.size() <= 1 && results.empty(); }
    bool reads_variables() const;
};

/// The constants of all programs of a model, each once.
class ConstantPool {
public:
    std::uint32_t index(double value) {
        const auto [at, made] = indices_.try_emplace(std::bit_cast<std::uint64_t>(value), values_.size());
        if (made) values_.push_back(value);
        return at->second;
    }
    const std::vector<double>& values() const { return values_; }

private:
    std::vector<double> values_;
    std::map<std::uint64_t, std::uint32_t> indices_;
};

/// Compiles the programs of one L-system. Every program must be passed to `place_registers` once all are compiled.
/// Throws UserError for what cannot be evaluated.
class ProgramCompiler {
public:
    /// `inner`: the L-system stands inside others, whose variables its external ones are. `locals`: by global, whether
    /// it is a register; if there are any, parameters that are assigned matter to nobody else.
    ProgramCompiler(const LSystem& system, bool inner, Arithmetic arithmetic,
                    const std::optional<std::vector<bool>>& locals);

    bool is_external(std::uint32_t global) const { return external_.at(global); }

    // Programs tell places of what they were compiled from, which must outlive them.
    Program block(const Block& block);
    Program block(Block&& block) = delete;
    // What is computed behind blocks.
    Program value(const Expression& expression, const std::vector<const Block*>& blocks = {});
    Program arguments(const std::vector<ModuleTemplate>& modules, const std::vector<const Block*>& blocks = {});
    Program values(const std::vector<const Expression*>& expressions, const std::vector<const Block*>& blocks = {});

    /// The value of an expression of constants alone.
    std::optional<double> fold(const Expression& expression) const;

    /// Turns the compiler's register names into numbers; `formals` is the most formals any production has.
    void place_registers(Program& program, std::uint32_t formals) const;
    std::uint32_t register_count(std::uint32_t formals) const;
    const std::vector<double>& constants() const { return pool_.values(); }

private:
    struct Operand {
        bool constant = false;
        double number = 0;
        std::uint32_t reg = 0;
    };

    Operand compile(const Expression& expression);
    Operand apply(const Expression& expression);
    Operand short_circuit(const Expression& expression);
    Operand conditional(const Expression& expression);
    Operand function(const Expression& expression);
    Operand assign(const Expression& expression);
    Operand print(const Expression& expression);
    Operand open_file(const Expression& expression);
    Operand scan_file(const Expression& expression);
    Operand kept(const Operand& value, const Place& place);
    void store(const Expression& target, std::uint32_t subscripts, std::uint32_t value, const Place& place);
    std::uint32_t subscripts(const Expression& element);
    void statements(const Block& block);
    void statement(const Statement& statement);
    void branch(const Statement& statement);
    void loop(const Statement& statement);
    void condition_jump(const std::optional<Expression>& condition, std::vector<std::size_t>& exits);

    std::uint32_t reg(const Operand& operand);
    std::uint32_t temporary();
    std::uint32_t temporaries(std::size_t count);
    Operand emit(Instruction instruction, const Place& place);
    std::size_t emit_jump(Opcode op, std::uint32_t tested, const Place& place);
    void land(std::size_t jump) { program_.code[jump].b = static_cast<std::uint32_t>(program_.code.size()); }
    void begin(const std::vector<const Block*>& blocks = {});
    Program finish(const Place& place);
    void require_arguments(const Expression& expression) const;

    const LSystem& system_;
    Arithmetic arithmetic_;
    std::vector<bool> external_;  ///< by global
    bool has_locals_;
    std::vector<std::optional<std::uint32_t>> locals_;  ///< by global: which of the registers for locals
    std::uint32_t local_count_ = 0;
    ConstantPool pool_;
    Program program_;
    std::uint32_t next_temporary_ = 0;
    std::uint32_t most_temporaries_ = 0;
    std::vector<std::vector<std::size_t>> breaks_;  // jumps out of each enclosing loop
};

}  // namespace espalier::lsystem
