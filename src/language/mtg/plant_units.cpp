#include "language/mtg/plant_units.h"

#include "espalier/base/math.h"

#include "base/text.h"
#include "language/measured/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace espalier::language::mtg {
namespace {

constexpr double tallest = 150;         ///< m; the tallest trees have 116 m
constexpr double thickest_trunk = 12;   ///< m; the thickest trees have 11 m
constexpr double slenderness = 60;      ///< a plant's height over its diameter
constexpr double thickest_twig = 0.02;  ///< m; of a plant that is measured twig by twig
constexpr double tall = 8;              ///< m; of such a plant

// A plant is so many times larger than thick if its numbers are in one unit: less where they are small, as metres are,
// or where the unit is known.
constexpr double slender_enough = 25, slender_in_metres = 4, slender_if_known = 10;

// Tenths of a millimetre are written less often than millimetres: of two pairs that fit alike, these count.
constexpr double rare = 0.2;

constexpr double ln10 = 2.302585092994046;

struct Pair {
    double length, diameter;
    const char* words;
};

// The usual ones first.
constexpr std::array<Pair, 8> pairs{{{1, 1, "m"},
                                     {0.01, 0.01, "cm"},
                                     {0.001, 0.001, "mm"},
                                     {1, 0.01, "m, diameters cm"},
                                     {1, 0.001, "m, diameters mm"},
                                     {0.01, 0.001, "cm, diameters mm"},
                                     {0.01, 0.0001, "cm, diameters 0.1 mm"},
                                     {0.001, 0.0001, "mm, diameters 0.1 mm"}}};

/// How far a pair is from what plants are: 0 is like one, 1 is ten times off.
double distance_of(const Pair& pair, const PlantNumbers& numbers, bool is_known) {
    if (!is_known && numbers.extent * pair.length > tallest) return std::numeric_limits<double>::infinity();
    if (!(numbers.thickest > 0)) return pair.length == pair.diameter ? 0 : 10;
    const double ratio = numbers.extent * pair.length / (numbers.thickest * pair.diameter);
    if (pair.length == pair.diameter) {
        const bool is_too_thick = !is_known && numbers.thickest * pair.diameter > thickest_trunk;
        if (!is_too_thick && ratio >= (is_known           ? slender_if_known
                                       : pair.length == 1 ? slender_in_metres
                                                          : slender_enough))
            return 0;
        return 3 + std::abs(math::log(ratio / slenderness) / ln10);
    }
    const bool has_thick_twigs = numbers.extent * pair.length > tall && numbers.thin * pair.diameter > thickest_twig;
    const double rarity = pair.diameter < 0.001 ? rare : 0;
    return std::abs(math::log(ratio / slenderness) / ln10) + (has_thick_twigs ? 1 : 0) + rarity;
}

const Pair& likeliest(const PlantNumbers& numbers, std::optional<double> length) {
    const Pair* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Pair& pair : pairs) {
        if (length && pair.length != *length) continue;
        const double distance = distance_of(pair, numbers, length.has_value());
        if (best && !(distance < least - 1e-6)) continue;
        best = &pair;
        least = distance;
    }
    return *best;
}

bool is_among_pairs(double length) {
    return std::any_of(pairs.begin(), pairs.end(), [&](const Pair& pair) { return pair.length == length; });
}

std::string decided_by(const PlantNumbers& numbers) {
    const std::string height = fmt::format("the largest extent of a plant is {}", format_general(numbers.extent));
    if (!(numbers.thickest > 0)) return height;
    return fmt::format("{}, the largest diameter {}", height, format_general(numbers.thickest));
}

}  // namespace

PlantUnits units_of(const Graph& graph, const PlantNumbers& numbers, const MeasuredOptions& options,
                    const std::string& file, measured::Notes& notes) {
    const Place place{file, 1, 1};
    PlantUnits units;
    const std::string said = options.unit.empty() ? graph.unit : options.unit;
    const bool is_own_word = !graph.unit.empty() && (options.unit.empty() || options.unit == graph.unit);
    if (options.pixel) {
        units = {*options.pixel, *options.pixel, fmt::format("pixels of {} mm", format_general(1000 * *options.pixel))};
    } else if (!said.empty()) {
        units.length = units.diameter = measured::metres_of_unit(said);
        units.words = said;
        // One unit for all is the file's own word; a user speaks of lengths.
        if (!is_own_word && graph.diameter_unit.empty() && numbers.thickest > 0 && is_among_pairs(units.length)) {
            const Pair& pair = likeliest(numbers, units.length);
            units.diameter = pair.diameter;
            units.words = pair.words;
            if (pair.diameter != pair.length) {
                notes.warn(fmt::format("the unit of diameters is taken as {} mm: {}",
                                       format_general(1000 * pair.diameter), decided_by(numbers)),
                           place);
            }
        }
    } else {
        const Pair& pair = likeliest(numbers, std::nullopt);
        units = {pair.length, pair.diameter, pair.words};
        notes.warn(fmt::format("the file says no unit; it is taken as {}, because {}; --unit, or unit = \"...\" in a "
                               "scene, says another",
                               pair.words, decided_by(numbers)),
                   place);
    }
    if (!graph.diameter_unit.empty()) {
        units.diameter = measured::metres_of_unit(graph.diameter_unit);
        units.words =
            fmt::format("{}, diameters {}", said.empty() ? units.words.substr(0, units.words.find(',')) : said,
                        graph.diameter_unit);
    }
    if (numbers.extent * units.length > tallest) {
        notes.warn(fmt::format("a plant of this file is {} m large: the unit is {}, which --unit, or unit = \"...\" in "
                               "a scene, changes",
                               format_general(numbers.extent * units.length), units.words),
                   place);
    }
    return units;
}

}  // namespace espalier::language::mtg
