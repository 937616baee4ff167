#include "studio/session/panels.h"

#include "espalier/base/settings.h"
#include "espalier/simulation/object.h"

#include "base/number.h"
#include "base/text.h"
#include "simulation/object/panels.h"

#include <fmt/format.h>

#include <map>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;
using Numbers = std::map<std::string, DocumentTexts::Placed>;

// In the folder of an object a panel names settings as it does beside a model; the studio names them with the model.
void name_with(const fs::path& model, std::vector<Panel>& panels) {
    for (Panel& panel : panels) {
        for (PanelSlider& slider : panel.sliders) {
            if (slider.setting.find(':') == slider.setting.npos)
                slider.setting = model.filename().string() + ":" + slider.setting;
        }
    }
}

// A scene has its own; those of a model lie beside it.
std::vector<Panel> panels_of(const DocumentTexts& texts, const DocumentState& state) {
    const fs::path& main = state.opened.path;
    const bool is_scene = main.extension() == ".toml", is_object = fs::is_directory(main);
    try {
        const fs::path model = is_object ? read_object_folder(main).model : main;
        const fs::path file = is_scene ? main : panel_file_of(model);
        if (!texts.editable(state).contains(file)) return {};
        const std::string text = text_of(file, state);
        if (is_scene) return read_panels(Settings::parse_toml(text, file.string(), file.parent_path()));
        std::vector<Panel> panels = read_panel_text(text, file.string());
        if (is_object) name_with(model, panels);
        return panels;
    } catch (const UserError&) {
        return {};
    }
}

bool is_within(const PanelSlider& slider, const WrittenNumber& number) {
    return slider.lowest.value_or(number.lowest) >= number.lowest &&
           slider.highest.value_or(number.highest) <= number.highest;
}

std::vector<std::string> names_of(const Numbers& numbers) {
    std::vector<std::string> names;
    for (const auto& [name, number] : numbers) names.push_back(name);
    return names;
}

std::string warning_of(const PanelSlider& slider, const Numbers& numbers) {
    const auto found = numbers.find(slider.setting);
    if (found == numbers.end()) {
        return fmt::format("there is no setting '{}'{}", slider.setting,
                           did_you_mean(slider.setting, names_of(numbers)));
    }
    const WrittenNumber& number = found->second.second;
    if (is_within(slider, number)) return "";
    return fmt::format("the slider of '{}' goes beyond the setting, which lies between {} and {}", slider.setting,
                       format_general(number.lowest), format_general(number.highest));
}

}  // namespace

std::vector<ShownPanel> shown_panels(const DocumentTexts& texts, const DocumentState& state) {
    const std::vector<Panel> panels = panels_of(texts, state);
    if (panels.empty()) return {};
    const Numbers numbers = texts.numbers(state);
    std::vector<ShownPanel> list;
    for (const Panel& panel : panels) {
        ShownPanel shown{panel.title, panel.columns, panel.is_open, {}};
        for (const PanelSlider& slider : panel.sliders) {
            const auto found = numbers.find(slider.setting);
            if (found == numbers.end()) continue;
            const bool is_slid = is_within(slider, found->second.second);
            shown.sliders.push_back({slider.setting, slider.label, slider.unit,
                                     is_slid ? Nullable<double>(slider.lowest) : Nullable<double>(),
                                     is_slid ? Nullable<double>(slider.highest) : Nullable<double>(), slider.step});
        }
        if (!shown.sliders.empty()) list.push_back(std::move(shown));
    }
    return list;
}

std::vector<Diagnostic> panel_warnings(const DocumentTexts& texts, const DocumentState& state) {
    const std::vector<Panel> panels = panels_of(texts, state);
    if (panels.empty()) return {};
    const Numbers numbers = texts.numbers(state);
    std::vector<Diagnostic> warnings;
    for (const Panel& panel : panels) {
        for (const PanelSlider& slider : panel.sliders) {
            std::string words = warning_of(slider, numbers);
            if (!words.empty()) warnings.push_back({Diagnostic::Severity::warning, slider.place, std::move(words)});
        }
    }
    return warnings;
}

}  // namespace espalier::studio
