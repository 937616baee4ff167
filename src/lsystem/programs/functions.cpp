#include "lsystem/programs/functions.h"

#include "espalier/base/math.h"

#include "lsystem/programs/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::lsystem {
namespace {

double at_or(std::span<const double> values, std::size_t index, double fallback) {
    return index < values.size() ? values[index] : fallback;
}

void require(bool condition, Function function, const char* what, std::span<const double> values, const Place& place) {
    if (condition) return;
    std::string list;
    for (const double value : values) list += fmt::format("{}{:g}", list.empty() ? "" : ", ", value);
    throw EvaluationError(place, fmt::format("{}({}): {}", name_of(function), list, what));
}

}  // namespace

const char* name_of(Function function) {
    static constexpr const char* names[] = {"sin",
                                            "cos",
                                            "tan",
                                            "asin",
                                            "acos",
                                            "atan",
                                            "atan2",
                                            "exp",
                                            "log",
                                            "sqrt",
                                            "pow",
                                            "fabs",
                                            "floor",
                                            "ceil",
                                            "round",
                                            "sign",
                                            "trunc",
                                            "min",
                                            "max",
                                            "clamp",
                                            "lerp",
                                            "noise",
                                            "ran",
                                            "nran",
                                            "bran",
                                            "biran",
                                            "srand",
                                            "stop",
                                            "Display",
                                            "printf",
                                            "fopen",
                                            "fclose",
                                            "fprintf",
                                            "fscanf",
                                            "fflush",
                                            "GetDerivationLength",
                                            "SetDerivationLength",
                                            "func",
                                            "curveX",
                                            "curveY",
                                            "curveZ",
                                            "curveGAL",
                                            "the extent of the view",
                                            "inblob"};
    return names[static_cast<std::size_t>(function)];
}

Arguments arguments_of(Function function) {
    switch (function) {
        case Function::atan:
            return {1, 2};
        case Function::atan2:
        case Function::pow:
        case Function::nran:
        case Function::bran:
        case Function::biran:
        case Function::file_open:
        case Function::func:
        case Function::curve_x:
        case Function::curve_y:
        case Function::curve_z:
            return {2, 2};
        case Function::clamp:
        case Function::lerp:
            return {3, 3};
        case Function::noise:
            return {1, 3};
        case Function::min:
        case Function::max:
        case Function::print:
            return {1, -1};
        case Function::file_print:
        case Function::file_scan:
            return {2, -1};
        case Function::get_derivation_length:
            return {0, 0};
        case Function::stop:
        case Function::display:
        case Function::view_extent:
            return {0, 1};
        default:
            return {1, 1};
    }
}

bool is_pure(Function function) {
    return function <= Function::noise;
}

bool samples(Function function) {
    return function >= Function::ran && function <= Function::biran;
}

bool has_order(Function function) {
    return function >= Function::srand && function < Function::func && function != Function::display &&
           function != Function::get_derivation_length;
}

double apply(Operator op, double a, double b) {
    switch (op) {
        case Operator::negate:
            return -a;
        case Operator::logical_not:
            return a == 0;
        case Operator::power:
            return math::pow(a, b);
        case Operator::multiply:
            return a * b;
        case Operator::add:
            return a + b;
        case Operator::subtract:
            return a - b;
        case Operator::less:
            return a < b;
        case Operator::less_equal:
            return a <= b;
        case Operator::greater:
            return a > b;
        case Operator::greater_equal:
            return a >= b;
        case Operator::equal:
            return a == b;
        case Operator::not_equal:
            return a != b;
        case Operator::logical_and:
            return a != 0 && b != 0;
        case Operator::logical_or:
            return a != 0 || b != 0;
        case Operator::divide:
        case Operator::remainder:
            break;
    }
    return 0;
}

bool keeps_left_of_or(const Expression& expression) {
    using Kind = Expression::Kind;
    const Kind left = expression.operands[0].kind;
    return expression.op == Operator::logical_or && left != Kind::number && left != Kind::formal &&
           left != Kind::global;
}

double held_by_or(double a) {
    if (a == 0) return 0;
    return std::fmod(std::trunc(a), 256) == 0 ? 1 : a;
}

double divide(double a, double b, Arithmetic arithmetic, const Place& place) {
    if (b != 0) return a / b;
    if (arithmetic == Arithmetic::cpfg) return a;
    throw EvaluationError(place, fmt::format("division by zero: {:g} / {:g} (--arithmetic cpfg divides by 1)", a, b));
}

// Both sides are truncated to whole numbers, as in C.
double remainder(double a, double b, Arithmetic arithmetic, const Place& place) {
    const double divisor = std::trunc(b);
    if (divisor != 0) return std::fmod(std::trunc(a), divisor);
    if (arithmetic == Arithmetic::cpfg) return 0;
    throw EvaluationError(place, fmt::format("division by zero: {:g} % {:g} (--arithmetic cpfg divides by 1)", a, b));
}

double call(Function function, std::span<const double> values, Arithmetic arithmetic) {
    const double x = values[0];
    switch (function) {
        case Function::sin:
            return math::sin(x * degree);
        case Function::cos:
            return math::cos(x * degree);
        case Function::tan:
            return math::tan(x * degree);
        case Function::asin:
            return math::asin(x) / degree;
        case Function::acos:
            return math::acos(x) / degree;
        // atan(x, y) is the angle of the point (x, y); atan2 has C's order (y, x).
        case Function::atan:
            return (values.size() > 1 ? math::atan2(values[1], x) : math::atan(x)) / degree;
        case Function::atan2:
            return math::atan2(x, values[1]) / degree;
        case Function::exp:
            return math::exp(x);
        case Function::log:
            return math::log(x);
        case Function::sqrt:
            return std::sqrt(x);
        case Function::pow:
            return math::pow(x, values[1]);
        case Function::fabs:
            return std::fabs(x);
        case Function::floor:
            return std::floor(x);
        case Function::ceil:
            return std::ceil(x);
        case Function::round:
            return std::round(x);
        case Function::sign:
            return (x > 0) - (x < 0);
        case Function::trunc:
            return arithmetic == Arithmetic::cpfg ? std::floor(x + 0.5) : std::trunc(x);
        case Function::min:
            return *std::min_element(values.begin(), values.end());
        case Function::max:
            return *std::max_element(values.begin(), values.end());
        case Function::clamp:
            return std::min(std::max(x, values[1]), values[2]);
        case Function::lerp:
            return x + (values[1] - x) * values[2];
        case Function::noise:
            return gradient_noise(x, at_or(values, 1, 0), at_or(values, 2, 0));
        default:
            return 0;
    }
}

double sample(Function function, std::span<const double> values, RandomSamples& random, const Place& place) {
    const bool finite = std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
    require(finite, function, "the arguments must be finite numbers", values, place);
    switch (function) {
        case Function::ran:
            return values[0] * random.uniform();
        case Function::nran:
            return values[0] + values[1] * random.normal();
        case Function::bran:
            require(values[0] > 0 && values[1] > 0, function, "both shapes must be positive", values, place);
            return random.beta(values[0], values[1]);
        default:
            require(values[0] >= 0 && values[0] <= most_tosses, function, "tosses must be from 0 to 1e8", values,
                    place);
            require(values[1] >= 0 && values[1] <= 1, function, "the probability must be from 0 to 1", values, place);
            return random.binomial(values[0], values[1]);
    }
}

namespace {

// One of Perlin's twelve gradients (towards the edges of a cube), chosen by the hash of the corner.
double corner(std::int64_t x, std::int64_t y, std::int64_t z, double dx, double dy, double dz) {
    const std::uint64_t hash =
        mix(mix(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y)), static_cast<std::uint64_t>(z));
    const unsigned edge = static_cast<unsigned>((hash >> 32) % 12);
    const double first = edge & 1 ? -1 : 1;
    const double second = edge & 2 ? -1 : 1;
    if (edge < 4) return first * dx + second * dy;
    if (edge < 8) return first * dx + second * dz;
    return first * dy + second * dz;
}

double fade(double t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

}  // namespace

// Perlin (2002), "Improving noise".
double gradient_noise(double x, double y, double z) {
    constexpr double farthest = 1e15;  // beyond, neighbouring doubles are no longer neighbouring points
    if (!(std::fabs(x) < farthest && std::fabs(y) < farthest && std::fabs(z) < farthest)) return 0;
    const double fx = std::floor(x), fy = std::floor(y), fz = std::floor(z);
    const auto ix = static_cast<std::int64_t>(fx), iy = static_cast<std::int64_t>(fy),
               iz = static_cast<std::int64_t>(fz);
    const double dx = x - fx, dy = y - fy, dz = z - fz;
    const double u = fade(dx), v = fade(dy), w = fade(dz);
    const auto along_x = [&](int j, int k) {
        return std::lerp(corner(ix, iy + j, iz + k, dx, dy - j, dz - k),
                         corner(ix + 1, iy + j, iz + k, dx - 1, dy - j, dz - k), u);
    };
    return std::lerp(std::lerp(along_x(0, 0), along_x(1, 0), v), std::lerp(along_x(0, 1), along_x(1, 1), v), w);
}

}  // namespace espalier::lsystem
