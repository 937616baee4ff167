// How a plant computes: in double precision, or as cpfg does.
#pragma once

#include "espalier/base/stations.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace espalier::lsystem {

enum class Arithmetic : std::uint8_t {
    double_precision,
    cpfg,  ///< as cpfg computes, down to its quirks: docs/language.md lists them
};

/// "double" or "cpfg".
constexpr const char* name_of(Arithmetic arithmetic) {
    return arithmetic == Arithmetic::cpfg ? "cpfg" : "double";
}

constexpr std::optional<Arithmetic> arithmetic_called(std::string_view name) {
    for (const Arithmetic arithmetic : {Arithmetic::double_precision, Arithmetic::cpfg}) {
        if (name == name_of(arithmetic)) return arithmetic;
    }
    return std::nullopt;
}

/// A value as it is kept in a string: cpfg's parameters are 32-bit floats.
constexpr double stored(double value, Arithmetic arithmetic) {
    return arithmetic == Arithmetic::cpfg ? static_cast<double>(static_cast<float>(value)) : value;
}

}  // namespace espalier::lsystem
