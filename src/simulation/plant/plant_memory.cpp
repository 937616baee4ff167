#include "simulation/plant/plant_memory.h"

#include "geometry/drawn/columns.h"

#include <algorithm>
#include <bit>
#include <type_traits>

namespace espalier::simulation {
namespace {

std::size_t bytes_of(const Interpretation& interpretation) {
    // Memory that grows by doubling.
    const auto held = [](const auto& column) {
        return column.empty() ? 0 : std::bit_ceil(column.size()) * sizeof(column[0]);
    };
    // The columns of large plants are counted before they are written.
    constexpr std::size_t large = 8192;
    const auto written = [&](const auto& column) {
        return column.size() < large ? held(column) : column.size() * sizeof(column[0]);
    };
    std::size_t bytes =
        written(interpretation.queries) + written(interpretation.answers) + held(interpretation.directions);
    geometry::for_drawn_columns(interpretation.geometry, [&](const auto& column) {
        constexpr bool is_counted = std::is_same_v<decltype(column), const Column<Internode>&>;
        bytes += is_counted ? written(column) : held(column);
    });
    return bytes;
}

}  // namespace

// Counts small strings always as if there were two that fit: when memory gets scarce there will be.
void PlantMemory::set_strings(const ModuleString* before, std::size_t modules_before, const ModuleString& now,
                              std::size_t working) {
    const bool is_small = !before || modules_before <= most_of_small || now.size() <= most_of_small;
    const std::size_t content = now.content() + (is_small ? now.content() : before->content());
    // Columns have up to an eighth more room than they need: much memory at once stays untouched, little does not.
    strings = content + (is_small ? content / 8 : 0) + working;
}

void PlantMemory::set_drawn(const Interpretation& interpretation, bool many_plants) {
    const std::size_t query = sizeof(Answer) + 2 * sizeof(double) + (many_plants ? sizeof(Query) : 0);
    drawn = bytes_of(interpretation) + interpretation.queries.size() * query;
}

void PlantMemory::add_staged(const Interpretation& staged) {
    drawn += bytes_of(staged);
}

void PlantMemory::set_recorded(const RecordedMemory& now, std::size_t before) {
    drawn_before = before;
    recorded = {now.frame, recorded.kept + now.kept, recorded.finish + now.finish};
}

void PlantMemory::add(const PlantMemory& plant) {
    strings += plant.strings;
    drawn += plant.drawn;
    drawn_before += plant.drawn_before;
    recorded += plant.recorded;
}

PlantMemory PlantMemory::grown(double factor, bool is_recorded) const {
    const auto times = [&](std::size_t bytes) { return static_cast<std::size_t>(static_cast<double>(bytes) * factor); };
    return {strings, times(drawn), is_recorded ? drawn : 0,
            RecordedMemory{times(recorded.frame), times(recorded.kept), times(recorded.finish)}};
}

std::size_t PlantMemory::total() const {
    return strings + drawn + drawn_before + recorded.kept + std::max(recorded.frame, recorded.finish);
}

}  // namespace espalier::simulation
