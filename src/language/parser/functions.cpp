#include "language/parser/functions.h"

#include <algorithm>
#include <array>

namespace espalier::language {
namespace {

constexpr auto entries = std::to_array<FunctionEntry>({
    {"sin", Function::sin, 1, 1},
    {"cos", Function::cos, 1, 1},
    {"tan", Function::tan, 1, 1},
    {"asin", Function::asin, 1, 1},
    {"acos", Function::acos, 1, 1},
    {"atan", Function::atan, 1, 2},
    {"atan2", Function::atan2, 2, 2},
    {"exp", Function::exp, 1, 1},
    {"log", Function::log, 1, 1},
    {"sqrt", Function::sqrt, 1, 1},
    {"pow", Function::pow, 2, 2},
    {"fabs", Function::fabs, 1, 1},
    {"abs", Function::fabs, 1, 1},
    {"floor", Function::floor, 1, 1},
    {"ceil", Function::ceil, 1, 1},
    {"round", Function::round, 1, 1},
    {"sign", Function::sign, 1, 1},
    {"trunc", Function::trunc, 1, 1},
    {"min", Function::min, 2, any_number},
    {"max", Function::max, 2, any_number},
    {"clamp", Function::clamp, 3, 3},
    {"lerp", Function::lerp, 3, 3},
    {"noise", Function::noise, 1, 3},
    {"ran", Function::ran, 1, 1},
    {"nran", Function::nran, 2, 2},
    {"bran", Function::bran, 2, 2},
    {"biran", Function::biran, 2, 2},
    {"srand", Function::srand, 1, 1},
    {"stop", Function::stop, 1, 1},
    {"Display", Function::display, 1, 1, true},
    {"play", Function::display, 1, 1, true},
    {"printf", Function::print, 1, any_number, true},
    {"error", Function::print, 1, any_number, true, 1},
    {"fopen", Function::file_open, 2, 2, true},
    {"fclose", Function::file_close, 1, 1},
    {"fprintf", Function::file_print, 2, any_number, true},
    {"fscanf", Function::file_scan, 2, any_number, true},
    {"fflush", Function::file_flush, 1, 1},
    {"GetDerivationLength", Function::get_derivation_length, 0, 0},
    {"SetDerivationLength", Function::set_derivation_length, 1, 1},
    {"func", Function::func, 2, 2},
    {"curveX", Function::curve_x, 2, 2},
    {"curveY", Function::curve_y, 2, 2},
    {"curveZ", Function::curve_z, 2, 2},
    {"curveGAL", Function::curve_gal, 1, 1},
    {"vvXmin", Function::view_extent, 0, 1, false, 0},
    {"vvXmax", Function::view_extent, 0, 1, false, 1},
    {"vvYmin", Function::view_extent, 0, 1, false, 2},
    {"vvYmax", Function::view_extent, 0, 1, false, 3},
    {"vvZmin", Function::view_extent, 0, 1, false, 4},
    {"vvZmax", Function::view_extent, 0, 1, false, 5},
    {"vvScale", Function::view_extent, 0, 1, false, 6},
    {"inblob", Function::in_blob, 4, 4},
});

}  // namespace

const FunctionEntry* find_function(std::string_view name) {
    const auto found =
        std::find_if(entries.begin(), entries.end(), [&](const FunctionEntry& entry) { return entry.name == name; });
    return found == entries.end() ? nullptr : &*found;
}

const std::vector<std::string>& function_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const FunctionEntry& entry : entries) all.emplace_back(entry.name);
        return all;
    }();
    return names;
}

}  // namespace espalier::language
