// How an author lays out the sliders of a model or a scene: panels with titles, in the order of the file. A run ignores
// them; the studio shows them.
#pragma once

#include "espalier/base/error.h"
#include "espalier/base/settings.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace espalier::simulation {

/// A slider of a panel. What is not said is as the setting itself has it.
struct PanelSlider {
    std::string setting;  ///< as the studio names it
    std::optional<std::string> label = {}, unit = {};
    std::optional<double> lowest = {}, highest = {}, step = {};
    Place place = {};
};

struct Panel {
    std::string title;
    int columns = 1;
    bool is_open = true;
    std::vector<PanelSlider> sliders;
};

/// The [[panel]] tables of a scene or of a panel file. Throws UserError.
std::vector<Panel> read_panels(const Settings& root);
/// Of a file that holds nothing else. Throws UserError.
std::vector<Panel> read_panel_text(const std::string& text, const std::string& name);

/// The file that lays out the settings of a model, or of the model of an object's folder: it lies beside it under the
/// model's name. Throws UserError if it is not clear which model a folder has.
std::filesystem::path panel_file_of(const std::filesystem::path& opened);
/// What is wrong with that file; nothing if there is none. It is no reason not to grow the model.
std::vector<Diagnostic> mistakes_in_panels_of(const std::filesystem::path& opened);

}  // namespace espalier::simulation
