#include "view/layout.h"

#include <algorithm>
#include <cmath>

namespace espalier::view {
namespace {

constexpr float bar_height = 52, button = 32, gap = 4, margin = 10, label_width = 132, panel_width = 300,
                shortest_slider = 90, slider_end = 10;

}  // namespace

const Rectangle* WindowLayout::find(Control control) const {
    const auto found =
        std::find_if(controls.begin(), controls.end(), [&](const Place& place) { return place.control == control; });
    return found == controls.end() ? nullptr : &found->at;
}

std::optional<Control> WindowLayout::at(int x, int y) const {
    for (const Place& place : controls) {
        if (place.at.holds(x, y)) return place.control;
    }
    if (bar.holds(x, y) || panel.holds(x, y)) return Control::inside;
    return std::nullopt;
}

std::size_t WindowLayout::frame_at(int x, std::size_t frames) const {
    const Rectangle* slider = find(Control::slider);
    if (!slider || frames < 2) return 0;
    const float end = slider_end * scale;
    const float share = (static_cast<float>(x) - slider->x - end) / (slider->width - 2 * end);
    return static_cast<std::size_t>(std::lround(std::clamp(share, 0.0F, 1.0F) * static_cast<float>(frames - 1)));
}

float WindowLayout::slider_x(std::size_t frame, std::size_t frames) const {
    const Rectangle* slider = find(Control::slider);
    if (!slider) return 0;
    const float end = slider_end * scale;
    const float share = frames < 2 ? 0.0F : static_cast<float>(frame) / static_cast<float>(frames - 1);
    return slider->x + end + share * (slider->width - 2 * end);
}

WindowLayout layout_of_window(int width, int height, float scale, bool with_panel, bool is_live) {
    WindowLayout layout;
    layout.scale = scale;
    const auto w = static_cast<float>(width), h = static_cast<float>(height);
    layout.bar = {0, 0, w, bar_height * scale};
    const float panel = with_panel ? std::min(panel_width * scale, w / 2) : 0;
    layout.panel = {w - panel, layout.bar.height, panel, h - layout.bar.height};
    layout.scene = {0, layout.bar.height, w - panel, h - layout.bar.height};

    const float y = (bar_height - button) / 2 * scale, size = button * scale, step = (button + gap) * scale;
    float left = margin * scale, right = w - margin * scale;
    const auto put_left = [&](Control control) {
        layout.controls.push_back({control, {left, y, size, size}});
        left += step;
    };
    const auto put_right = [&](Control control, float wide) {
        right -= wide * scale;
        layout.controls.push_back({control, {right, y, wide * scale, size}});
        right -= gap * scale;
    };
    const auto room_for = [&](float wide) { return right - left - (wide + gap) * scale >= shortest_slider * scale; };
    for (const Control control : {Control::first, Control::back, Control::play, Control::forward, Control::last}) {
        put_left(control);
    }
    if (room_for(button)) put_right(Control::help, button);
    if (room_for(label_width)) put_right(Control::field, label_width);
    if (room_for(label_width)) put_right(Control::colour, label_width);
    if (is_live && room_for(2 * button)) put_right(Control::live, 2 * button);
    if (right > left) layout.controls.push_back({Control::slider, {left, y, right - left, size}});
    if (with_panel) {
        const float cross = 24 * scale;
        layout.controls.push_back(
            {Control::close_panel, {w - cross - margin * scale, h - cross - margin * scale, cross, cross}});
    }
    return layout;
}

}  // namespace espalier::view
