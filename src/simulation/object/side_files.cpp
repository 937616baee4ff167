#include "simulation/object/side_files.h"

#include "base/number.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

namespace espalier::simulation {
namespace {

namespace fs = std::filesystem;

// A file is set 1; a table gives files by the number of their set.
std::map<int, fs::path> sets_of(const Settings& table, const char* key) {
    constexpr int most_sets = 255;
    std::map<int, fs::path> sets;
    if (!table.has(key)) return sets;
    if (!table.is_table(key)) {
        sets[1] = table.path(key);
        return sets;
    }
    const Settings files = table.table(key);
    for (const std::string& set : files.keys()) {
        const std::optional<int> number = whole_text_as<int>(set);
        if (!number || *number < 0 || *number > most_sets) {
            throw UserError(files.place(set), fmt::format("'{}' is no number of a set from 0 to {}", set, most_sets));
        }
        sets[*number] = files.path(set);
    }
    return sets;
}

}  // namespace

std::shared_ptr<const View> SideFiles::view(const fs::path& path, const Defines& defines, const fs::path& folder) {
    std::shared_ptr<const View>& view = views_[{path, defines}];
    if (view) return view;
    view = std::make_shared<const View>(read_view_file(path, defines, folder));
    notes_.files.push_back(path);
    notes_.files.insert(notes_.files.end(), view->files.begin(), view->files.end());
    notes_.diagnostics.insert(notes_.diagnostics.end(), view->diagnostics.begin(), view->diagnostics.end());
    if (!view->unused.empty()) {
        notes_.unused.push_back(fmt::format("{}: {}", path.string(), fmt::join(view->unused, ", ")));
    }
    return view;
}

std::shared_ptr<const Palette> SideFiles::palette(const Settings& table) {
    const Sets colours = sets_of(table, "colour_map"), materials = sets_of(table, "materials");
    if (colours.empty() && materials.empty()) return nullptr;
    std::shared_ptr<const Palette>& palette = palettes_[{colours, materials}];
    if (palette) return palette;
    Palette entries;
    for (const auto& [set, file] : colours) read_colour_map(file, set, entries);
    for (const auto& [set, file] : materials) read_materials(file, set, entries);
    for (const Sets* sets : {&colours, &materials}) {
        for (const auto& entry : *sets) notes_.files.push_back(entry.second);
    }
    palette = std::make_shared<const Palette>(std::move(entries));
    return palette;
}

}  // namespace espalier::simulation
