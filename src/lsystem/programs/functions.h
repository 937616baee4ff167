// What operators and functions of the language mean. Angles in degrees.
#pragma once

#include "espalier/base/random.h"
#include "espalier/lsystem/arithmetic.h"
#include "espalier/lsystem/expression.h"

#include <numbers>
#include <span>
#include <stdexcept>
#include <string>

namespace espalier::lsystem {

/// An expression that has no value, before it is known which module it belongs to.
struct EvaluationError : std::runtime_error {
    EvaluationError(const Place& where, const std::string& message) : std::runtime_error(message), place(where) {}
    Place place;
};

/// In radians.
inline constexpr double degree = std::numbers::pi / 180;

/// Fewest and most arguments; most = -1: any number.
struct Arguments {
    int fewest = 0;
    int most = 0;
};

const char* name_of(Function function);
Arguments arguments_of(Function function);
/// A function of its arguments alone, so that it may be folded.
bool is_pure(Function function);
bool samples(Function function);
/// Its calls have an order that matters: it prints, uses files, seeds, stops or changes the derivation length.
bool has_order(Function function);

/// The value of an operator other than / and %, which may fail, and && and ||, which may not evaluate both sides.
double apply(Operator op, double a, double b);
/// a / b and a % b; with cpfg's arithmetic, division by 0 divides by 1. Throws EvaluationError.
double divide(double a, double b, Arithmetic arithmetic, const Place& place);
double remainder(double a, double b, Arithmetic arithmetic, const Place& place);
/// Whether the value of a || b in cpfg is a's own where a holds: not that of a plain number or name.
bool keeps_left_of_or(const Expression& expression);
/// That value: 0 if a is 0, else a, but 1 where the integer part of a is a multiple of 256.
double held_by_or(double a);
/// A pure function.
double call(Function function, std::span<const double> values, Arithmetic arithmetic);
/// ran, nran, bran, biran. Throws EvaluationError for arguments they are not defined for.
double sample(Function function, std::span<const double> values, RandomSamples& random, const Place& place);

/// Gradient noise in [-1, 1], 0 at whole coordinates (Perlin 2002's interpolant over hashed gradients).
double gradient_noise(double x, double y, double z);

}  // namespace espalier::lsystem
