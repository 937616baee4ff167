#include "simulation/object/panels.h"

#include "espalier/base/file.h"
#include "espalier/simulation/object.h"

#include <fmt/format.h>

#include <set>

namespace espalier::simulation {
namespace {

constexpr double most_columns = 4;

PanelSlider read_slider(const Settings& table) {
    PanelSlider slider{.setting = table.text("name"),
                       .label = table.text_if_any("label"),
                       .unit = table.text_if_any("unit"),
                       .lowest = table.number_if_any("lowest"),
                       .highest = table.number_if_any("highest"),
                       .step = table.number_if_any("step", Range::positive()),
                       .place = table.place("name")};
    if (slider.lowest && slider.highest && *slider.lowest >= *slider.highest) {
        throw UserError(table.place("lowest"), "'lowest' of a slider must be less than 'highest'");
    }
    return slider;
}

// Names alone, or a table for each.
std::vector<PanelSlider> read_sliders(const Settings& panel) {
    std::vector<PanelSlider> sliders;
    if (panel.is_text("settings")) {
        for (const std::string& name : panel.texts_or("settings", {})) {
            sliders.push_back({.setting = name, .place = panel.place("settings")});
        }
    } else {
        for (const Settings& slider : panel.tables("settings")) sliders.push_back(read_slider(slider));
    }
    if (sliders.empty()) {
        throw UserError(panel.place(),
                        "a panel names its sliders: settings = [\"NAME\", ...], or a table for each, "
                        "settings = [{ name = \"NAME\", step = 0.5 }, ...]");
    }
    return sliders;
}

void require_once(const std::vector<Panel>& panels) {
    std::set<std::string> named;
    for (const Panel& panel : panels) {
        for (const PanelSlider& slider : panel.sliders) {
            if (named.insert(slider.setting).second) continue;
            throw UserError(slider.place, fmt::format("'{}' has a slider already", slider.setting));
        }
    }
}

}  // namespace

std::vector<Panel> read_panels(const Settings& root) {
    std::vector<Panel> panels;
    for (const Settings& table : root.tables("panel")) {
        panels.push_back({table.text("title"),
                          static_cast<int>(table.integer_or("columns", 1, Range::between(1, most_columns))),
                          table.flag_or("open", true), read_sliders(table)});
        table.reject_unread();
    }
    require_once(panels);
    return panels;
}

std::vector<Panel> read_panel_text(const std::string& text, const std::string& name) {
    const Settings root = Settings::parse_toml(text, name);
    std::vector<Panel> panels = read_panels(root);
    root.reject_unread();
    return panels;
}

std::filesystem::path panel_file_of(const std::filesystem::path& opened) {
    std::filesystem::path model = std::filesystem::is_directory(opened) ? read_object_folder(opened).model : opened;
    return model.replace_extension(".panel");
}

std::vector<Diagnostic> mistakes_in_panels_of(const std::filesystem::path& opened) {
    const std::filesystem::path file = panel_file_of(opened);
    if (!std::filesystem::is_regular_file(file)) return {};
    try {
        read_panel_text(read_text(file), file.string());
    } catch (const UserError& error) {
        return error.diagnostics();
    }
    return {};
}

}  // namespace espalier::simulation
