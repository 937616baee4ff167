// What the window shows besides the plants: the bar with its controls, words, the panel of an organ, the help.
#pragma once

#include "view/layout.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkRenderer;

namespace espalier::view {

/// A line over the steps.
struct SmallChart {
    std::string title;
    std::vector<double> x, y;
};

struct OrganPanel {
    std::vector<std::pair<std::string, std::string>> rows;
    std::string note;  ///< what is still to come
    std::vector<SmallChart> charts;
    double step = 0;  ///< marked in the charts
};

struct OverlayContent {
    bool dark = false;
    std::vector<std::string> heading;  ///< at the upper left; the first line stands out
    std::string status;                ///< at the lower left of the scene
    bool status_is_error = false;
    std::size_t frame = 0, frames = 0;
    bool playing = false;
    bool live = false;  ///< stays with the newest frame
    std::string colour, field;
    std::vector<std::pair<std::string, std::string>> help;  ///< keys and what they do; empty: not shown
    bool has_panel = false;
    OrganPanel panel;
};

/// A layer above the scene's.
class Overlay {
public:
    Overlay();
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    vtkRenderer& renderer();
    void show(const WindowLayout& layout, OverlayContent content);
    const OverlayContent& content() const;

private:
    class Item;
    class Body;
    std::unique_ptr<Body> body_;
};

/// The words of it from above to below, as a person reads them.
std::vector<std::string> words_of(const OverlayContent& content);

}  // namespace espalier::view
