#include "memory.h"

#include "espalier/simulation/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <fstream>
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

MemoryShares share_memory(std::size_t budget, std::size_t processes) {
    const std::size_t fields = processes == 0 ? 0 : budget / 2;
    const std::size_t plants = budget - fields;
    // A step's new strings are made before anyone knows how much will be drawn of them: room for them stays free.
    return {plants / 8 * 7, plants / 4, processes == 0 ? 0 : fields / processes};
}

std::size_t content(const ModuleString& string) {
    const auto bytes = [](const auto& column) { return column.size() * sizeof(column[0]); };
    return bytes(string.letters) + bytes(string.parameters) + bytes(string.identities) + bytes(string.parents) +
           bytes(string.births);
}

void PlantMemory::set_drawn(const Interpretation& interpretation) {
    const auto written = [](const auto& column) { return column.size() * sizeof(column[0]); };
    // Memory that grows by doubling.
    const auto held = [](const auto& column) {
        return column.empty() ? 0 : std::bit_ceil(column.size()) * sizeof(column[0]);
    };
    const PlantGeometry& geometry = interpretation.geometry;
    const DrawnMesh& mesh = geometry.mesh;
    internodes = written(geometry.internodes);
    others = written(interpretation.queries) + written(interpretation.answers) + held(interpretation.directions) +
             held(geometry.polygons) + held(geometry.vertices) + held(geometry.organs) + held(mesh.vertices) +
             held(mesh.triangles) + held(mesh.pieces) + held(geometry.labels) + held(geometry.textures);
}

PlantMemory PlantMemory::grown(double factor) const {
    const auto times = [&](std::size_t bytes) { return static_cast<std::size_t>(static_cast<double>(bytes) * factor); };
    return {strings, times(internodes), times(others)};
}

// The timeline copies the frame (half of `strings` are the old ones), makes its mesh twice, and its text. Measured: an
// internode of 96 bytes costs 700 in all, and a forest, mostly leaves, two and a half times what is drawn of it.
std::size_t PlantMemory::recorded() const {
    return strings + strings / 2 + internodes * 7 + others * 3;
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
