// Expressions and statements as a tree, as a reader builds them; the engine compiles them once per model.
#pragma once

#include "espalier/base/error.h"
#include "espalier/base/stations.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace espalier::lsystem {

/// Functions of the language. Angles in degrees.
// clang-format off
enum class Function : std::uint8_t {
    sin, cos, tan, asin, acos, atan, atan2, exp, log, sqrt, pow, fabs, floor, ceil, round, sign, trunc,
    min, max, clamp, lerp, noise,
    ran, nran, bran, biran, srand,
    stop, display, print, file_open, file_close, file_print, file_scan, file_flush,
    get_derivation_length, set_derivation_length,
    func, curve_x, curve_y, curve_z, curve_gal, view_extent, in_blob
};
// clang-format on

// clang-format off
enum class Operator : std::uint8_t {
    negate, logical_not,
    power, multiply, divide, remainder, add, subtract,
    less, less_equal, greater, greater_equal, equal, not_equal,
    logical_and, logical_or
};
// clang-format on

/// One node. Names are already resolved: a formal parameter of the production at hand, a global variable
/// of the L-system, or an array.
struct Expression {
    enum class Kind : std::uint8_t {
        number,       ///< `value`
        text,         ///< `text` (only as an argument of functions that take strings)
        formal,       ///< `index` among the production's formal parameters
        global,       ///< `index` among LSystem::globals
        element,      ///< element of array `index`; operands are its subscripts
        address,      ///< &variable (file_scan): one operand of kind global or element
        apply,        ///< `op` on one or two operands
        conditional,  ///< operands: condition, then, else
        call,         ///< `function` on the operands
        assign,       ///< operands: target (global or element), value; usable as an expression
    };

    Kind kind = Kind::number;
    Operator op = Operator::add;
    Function function = Function::sin;
    std::uint32_t index = 0;
    double value = 0;
    std::string text;
    std::vector<Expression> operands;
    Place place;

    static Expression number(double value, Place place = {});
};

/// A statement block, in order. Loops and branches nest.
struct Statement {
    enum class Kind : std::uint8_t { expression, branch, while_loop, do_loop, for_loop, break_loop };

    Kind kind = Kind::expression;
    /// expression: the expression. branch: one condition per body, a body more is `else`.
    /// while/do: the condition. for: initial, condition, step (each may be missing).
    std::vector<std::optional<Expression>> expressions;
    std::vector<std::vector<Statement>> bodies;
    Place place;
};

using Block = std::vector<Statement>;

}  // namespace espalier::lsystem
