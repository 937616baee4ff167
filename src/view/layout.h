// Where the window's controls stand, in pixels from the lower left corner.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace espalier::view {

enum class Control { first, back, play, forward, last, slider, live, colour, field, help, close_panel, inside };

struct Rectangle {
    float x = 0, y = 0, width = 0, height = 0;

    bool holds(int px, int py) const {
        const auto fx = static_cast<float>(px), fy = static_cast<float>(py);
        return fx >= x && fx < x + width && fy >= y && fy < y + height;
    }
};

/// A bar below, and a panel at the right where an organ is picked. The plants are drawn in what is left.
struct WindowLayout {
    struct Place {
        Control control;
        Rectangle at;
    };

    float scale = 1;  ///< scale of letters and distances: 2 on a screen of twice the density
    Rectangle scene, bar, panel;
    std::vector<Place> controls;  ///< buttons of the bar, and what closes the panel

    /// Null where the window has no room for it.
    const Rectangle* find(Control control) const;
    /// What is there; `inside` between controls of bar and panel; none: the scene.
    std::optional<Control> at(int x, int y) const;
    /// The frame of so many that a place on the slider means.
    std::size_t frame_at(int x, std::size_t frames) const;
    /// The place on the slider that means a frame.
    float slider_x(std::size_t frame, std::size_t frames) const;
};

WindowLayout layout_of_window(int width, int height, float scale, bool with_panel, bool is_live);

}  // namespace espalier::view
