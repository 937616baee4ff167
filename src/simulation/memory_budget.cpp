#include "memory_budget.h"

#include "espalier/simulation/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <fstream>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <sys/resource.h>
#include <unistd.h>

namespace espalier {

std::size_t default_memory() {
    std::size_t bytes =
        static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(sysconf(_SC_PAGE_SIZE));
    // A container's limit (control groups, version 2); "max" is no number and leaves the machine's.
    std::ifstream limit("/sys/fs/cgroup/memory.max");
    std::size_t allowed = 0;
    if (limit >> allowed) bytes = std::min(bytes, allowed);
    return bytes / 2;
}

std::size_t peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
    constexpr std::size_t unit = 1;
#else
    constexpr std::size_t unit = 1024;
#endif
    return static_cast<std::size_t>(usage.ru_maxrss) * unit;
}

// By itself the GNU library raises this threshold up to 32 MiB, and columns that plants have outgrown lie unused
// between those that came later: up to a quarter of what a run held.
void give_back_what_is_large() {
#ifdef __GLIBC__
    constexpr int large = 1 << 20;
    mallopt(M_MMAP_THRESHOLD, large);
#endif
}

MemoryShares share_memory(std::size_t budget, std::size_t processes) {
    const std::size_t fields = processes == 0 ? 0 : budget / 2;
    const std::size_t plants = budget - fields;
    // The rest is for the program itself, and for what is drawn of a step's strings before anyone knows how much.
    return {plants / 8 * 7, plants / 16, processes == 0 ? 0 : fields / processes};
}

void PlantMemory::set_drawn(const Interpretation& interpretation, bool many_plants) {
    // Memory that grows by doubling.
    const auto held = [](const auto& column) {
        return column.empty() ? 0 : std::bit_ceil(column.size()) * sizeof(column[0]);
    };
    // Of large plants these are counted before they are written.
    constexpr std::size_t large = 8192;
    const auto written = [&](const auto& column) {
        return column.size() < large ? held(column) : column.size() * sizeof(column[0]);
    };
    const PlantGeometry& geometry = interpretation.geometry;
    const DrawnMesh& mesh = geometry.mesh;
    const std::size_t question = sizeof(Answer) + 2 * sizeof(double) + (many_plants ? sizeof(Query) : 0);
    drawn = written(geometry.internodes) + written(interpretation.queries) + written(interpretation.answers) +
            held(interpretation.directions) + held(geometry.polygons) + held(geometry.vertices) +
            held(geometry.organs) + held(mesh.vertices) + held(mesh.triangles) + held(mesh.pieces) +
            held(geometry.labels) + held(geometry.textures) + interpretation.queries.size() * question;
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

std::string commonest_module(const Model& model, const ModuleString& string) {
    if (string.empty()) return "";
    std::vector<std::size_t> counts(model.alphabet.size());
    for (const LetterId letter : string.letters) ++counts[letter];
    const auto letter = static_cast<LetterId>(std::max_element(counts.begin(), counts.end()) - counts.begin());
    const Production* writer = nullptr;
    std::ptrdiff_t most = 0;
    for (const LSystem& system : model.systems) {
        for (const Production& production : system.productions) {
            const std::ptrdiff_t written =
                std::count_if(production.successor.begin(), production.successor.end(),
                              [&](const ModuleTemplate& module) { return module.letter == letter; });
            if (written <= most) continue;
            most = written;
            writer = &production;
        }
    }
    std::string text = ", most of them " + model.alphabet.name(letter);
    if (writer) text += fmt::format(", which the production at {} writes most of", to_string(writer->place));
    return text;
}

}  // namespace espalier
