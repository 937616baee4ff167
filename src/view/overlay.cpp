#include "view/overlay.h"

#include "espalier/picture/chart_page.h"

#include "view/painter.h"

#include <fmt/format.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

namespace espalier::view {
namespace {

/// From the chart's values to pixels.
class Scale {
public:
    Scale(const Rectangle& at, const Ticks& x, const Ticks& y) : at_(at), x_(x), y_(y) {}

    vtkVector2f operator()(double x, double y) const {
        return {at_.x + at_.width * static_cast<float>((x - x_.low) / (x_.high - x_.low)),
                at_.y + at_.height * static_cast<float>((y - y_.low) / (y_.high - y_.low))};
    }

private:
    const Rectangle& at_;
    const Ticks &x_, &y_;
};

Ticks ticks_of(const std::vector<double>& values, bool from_zero, int count) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (low > high) low = high = 0;
    // What does not change but for its rounding is a line between zero and itself.
    constexpr double rounding = 1e-4;
    const bool is_constant = high - low <= rounding * std::max(std::abs(low), std::abs(high));
    if (from_zero && low > 0 && (is_constant || low < high / 2)) low = 0;
    if (from_zero && high < 0 && is_constant) high = 0;
    if (low == high) high = low + 1;
    return ticks_over(low, high, count);
}

void paint_chart(Painter& painter, const Rectangle& at, const SmallChart& chart, double now,
                 const WindowColours& colours) {
    painter.text(at.x, at.y + at.height - painter.scaled(8), chart.title, colours.dim, 12);
    const Ticks x = ticks_of(chart.x, false, 4), y = ticks_of(chart.y, true, 3);
    const float left = painter.scaled(40), below = painter.scaled(16), above = painter.scaled(24);
    const Rectangle plot{at.x + left, at.y + below, at.width - left - painter.scaled(8), at.height - below - above};
    const Scale place(plot, x, y);
    for (std::size_t i = 0; i < y.places.size(); ++i) {
        const vtkVector2f from = place(x.low, y.places[i]);
        painter.line({from, place(x.high, y.places[i])}, colours.line);
        painter.text(from.GetX() - painter.scaled(6), from.GetY(), y.labels[i], colours.dim, 11, false, Align::right);
    }
    for (std::size_t i = 0; i < x.places.size(); ++i) {
        const vtkVector2f from = place(x.places[i], y.low);
        painter.text(from.GetX(), at.y + painter.scaled(5), x.labels[i], colours.dim, 11, false, Align::centre);
    }
    if (now >= x.low && now <= x.high) painter.line({place(now, y.low), place(now, y.high)}, colours.dim);
    std::vector<vtkVector2f> points;
    const auto end_line = [&] {
        painter.line(points, colours.accent, 2);
        if (points.size() == 1) {
            painter.disc(points[0].GetX(), points[0].GetY(), painter.scaled(2), colours.accent);
        }
        points.clear();
    };
    for (std::size_t i = 0; i < chart.x.size(); ++i) {
        if (std::isfinite(chart.y[i])) {
            points.push_back(place(chart.x[i], chart.y[i]));
        } else {
            end_line();
        }
    }
    end_line();
}

/// One picture of the content in the layout.
class Drawing {
public:
    Drawing(vtkContext2D& context, const WindowLayout& layout, const OverlayContent& content)
        : painter_(context, layout.scale), layout_(layout), content_(content), colours_(window_colours(content.dark)) {}

    void draw() {
        heading();
        status();
        bar();
        if (content_.has_panel) panel();
        if (!content_.help.empty()) help();
    }

private:
    void heading() {
        float y = layout_.scene.y + layout_.scene.height - painter_.scaled(20);
        const float room = layout_.scene.width - painter_.scaled(28);
        bool first = true;
        for (const std::string& line : content_.heading) {
            const float size = first ? 17.0F : 13.0F;
            painter_.text(painter_.scaled(14), y, painter_.fitting(line, room, size),
                          first ? colours_.text : colours_.dim, size, first);
            y -= painter_.scaled(first ? 24 : 19);
            first = false;
        }
    }

    void status() {
        const std::string words = painter_.fitting(content_.status, layout_.scene.width - painter_.scaled(28));
        painter_.text(painter_.scaled(14), layout_.scene.y + painter_.scaled(16), words,
                      content_.status_is_error ? colours_.error : colours_.dim, 13, content_.status_is_error);
    }

    void bar() {
        painter_.fill(layout_.bar, colours_.surface);
        painter_.line({{0, layout_.bar.height}, {layout_.bar.width, layout_.bar.height}}, colours_.line);
        for (const auto& [control, at] : layout_.controls) {
            if (control == Control::slider) {
                slider(at);
            } else if (control != Control::close_panel) {
                button(control, at);
            }
        }
    }

    void button(Control control, const Rectangle& at) {
        painter_.fill(at, colours_.raised);
        const float x = at.x + at.width / 2, y = at.y + at.height / 2;
        switch (control) {
            case Control::colour:
                label(at, "colour", content_.colour);
                break;
            case Control::field:
                label(at, "field", content_.field);
                break;
            case Control::live:
                painter_.text(x, y, "live", content_.live ? colours_.accent : colours_.dim, 13, content_.live,
                              Align::centre);
                break;
            case Control::help:
                painter_.text(x, y, "?", colours_.text, 16, true, Align::centre);
                break;
            default:
                sign(control, at);
        }
    }

    void label(const Rectangle& at, const std::string& name, const std::string& value) {
        const float inset = painter_.scaled(8), y = at.y + at.height / 2;
        const float used = painter_.width_of(name) + 1.6F * inset;
        painter_.text(at.x + inset, y, name, colours_.dim);
        painter_.text(at.x + used, y, painter_.fitting(value, at.width - used - inset / 2), colours_.text);
    }

    // Triangles and bars, as on every player.
    void sign(Control control, const Rectangle& at) {
        const vtkColor4ub& ink = colours_.text;
        const auto to_right = [&](float left, float right) {
            painter_.shape(at, {{left, 0.28F}, {right, 0.5F}, {left, 0.72F}}, ink);
        };
        const auto to_left = [&](float left, float right) {
            painter_.shape(at, {{right, 0.28F}, {right, 0.72F}, {left, 0.5F}}, ink);
        };
        const auto upright = [&](float left, float right) {
            painter_.shape(at, {{left, 0.28F}, {right, 0.28F}, {right, 0.72F}, {left, 0.72F}}, ink);
        };
        if (control == Control::first) upright(0.28F, 0.36F), to_left(0.38F, 0.72F);
        if (control == Control::back) to_left(0.32F, 0.64F);
        if (control == Control::forward) to_right(0.36F, 0.68F);
        if (control == Control::last) to_right(0.28F, 0.62F), upright(0.64F, 0.72F);
        if (control == Control::play && content_.playing) upright(0.3F, 0.44F), upright(0.56F, 0.7F);
        if (control == Control::play && !content_.playing) to_right(0.32F, 0.74F);
    }

    void slider(const Rectangle& at) {
        const float middle = at.y + at.height / 2, thickness = painter_.scaled(4);
        const float left = layout_.slider_x(0, 2), right = layout_.slider_x(1, 2);
        painter_.fill({left, middle - thickness / 2, right - left, thickness}, colours_.line);
        if (content_.frames < 2) return;
        const float here = layout_.slider_x(content_.frame, content_.frames);
        painter_.fill({left, middle - thickness / 2, here - left, thickness}, colours_.accent);
        painter_.disc(here, middle, painter_.scaled(8), colours_.accent);
        painter_.disc(here, middle, painter_.scaled(4), colours_.surface);
    }

    void panel() {
        const Rectangle& at = layout_.panel;
        painter_.fill(at, colours_.surface);
        painter_.line({{at.x, at.y}, {at.x, at.y + at.height}}, colours_.line);
        const float inset = painter_.scaled(14), row_height = painter_.scaled(20);
        const float values = at.x + painter_.scaled(84), right = at.x + at.width - inset;
        float y = at.y + at.height - painter_.scaled(22);
        painter_.text(at.x + inset, y, "Organ", colours_.text, 15, true);
        if (const Rectangle* cross = layout_.find(Control::close_panel)) close_sign(*cross);
        y -= painter_.scaled(28);
        for (const auto& [name, value] : content_.panel.rows) {
            if (y < at.y + row_height) return;
            painter_.text(at.x + inset, y, painter_.fitting(name, values - at.x - 1.2F * inset), colours_.dim);
            painter_.text(values, y, painter_.fitting(value, right - values), colours_.text);
            y -= row_height;
        }
        if (!content_.panel.note.empty()) {
            painter_.text(at.x + inset, y, content_.panel.note, colours_.accent);
        }
        y -= row_height;
        charts({at.x + inset, at.y + inset, at.width - 2 * inset, y - at.y - inset});
    }

    void close_sign(const Rectangle& at) {
        const float a = 0.3F * at.width, x = at.x, y = at.y, w = at.width;
        painter_.line({{x + a, y + a}, {x + w - a, y + w - a}}, colours_.dim, 2);
        painter_.line({{x + a, y + w - a}, {x + w - a, y + a}}, colours_.dim, 2);
    }

    // As many as have room.
    void charts(const Rectangle& room) {
        const float least = painter_.scaled(92), most = painter_.scaled(130), space = painter_.scaled(10);
        const auto fitting = static_cast<std::size_t>(std::max(0.0F, (room.height + space) / (least + space)));
        const std::size_t count = std::min(fitting, content_.panel.charts.size());
        if (count == 0) return;
        const float height = std::min(most, (room.height + space) / static_cast<float>(count) - space);
        float y = room.y + room.height;
        for (std::size_t i = 0; i < count; ++i) {
            y -= height;
            paint_chart(painter_, {room.x, y, room.width, height}, content_.panel.charts[i], content_.panel.step,
                        colours_);
            y -= space;
        }
    }

    void help() {
        const float row = painter_.scaled(22), inset = painter_.scaled(22), keys = painter_.scaled(150);
        float widest = 0;
        for (const auto& [key, what] : content_.help) widest = std::max(widest, painter_.width_of(what));
        const float width = keys + widest + 2 * inset;
        const float height = row * static_cast<float>(content_.help.size()) + 2 * inset + painter_.scaled(14);
        const Rectangle& scene = layout_.scene;
        const Rectangle at{std::max(0.0F, scene.x + (scene.width - width) / 2),
                           scene.y + std::max(0.0F, (scene.height - height) / 2), width, height};
        painter_.fill(at, colours_.veil);
        painter_.frame(at, colours_.line);
        float y = at.y + at.height - inset;
        painter_.text(at.x + inset, y, "Keys and mouse", colours_.text, 15, true);
        y -= painter_.scaled(30);
        for (const auto& [key, what] : content_.help) {
            painter_.text(at.x + inset, y, key, colours_.accent, 13, true);
            painter_.text(at.x + inset + keys, y, what, colours_.text);
            y -= row;
        }
    }

    Painter painter_;
    const WindowLayout& layout_;
    const OverlayContent& content_;
    const WindowColours& colours_;
};

}  // namespace

class Overlay::Item final : public vtkContextItem {
public:
    static Item* New() {
        auto* made = new Item;
        made->InitializeObjectBase();
        return made;
    }

    bool Paint(vtkContext2D* context) override {
        Drawing(*context, layout, content).draw();
        return true;
    }

    WindowLayout layout;
    OverlayContent content;
};

class Overlay::Body {
public:
    Body() {
        renderer->SetLayer(1);
        renderer->InteractiveOff();
        renderer->AddActor(actor);
        actor->GetScene()->AddItem(item);
    }

    vtkNew<vtkRenderer> renderer;
    vtkNew<vtkContextActor> actor;
    vtkNew<Item> item;
};

Overlay::Overlay() : body_(std::make_unique<Body>()) {}

Overlay::~Overlay() = default;

vtkRenderer& Overlay::renderer() {
    return *body_->renderer;
}

void Overlay::show(const WindowLayout& layout, OverlayContent content) {
    body_->item->layout = layout;
    body_->item->content = std::move(content);
    body_->actor->GetScene()->SetDirty(true);
}

const OverlayContent& Overlay::content() const {
    return body_->item->content;
}

std::vector<std::string> words_of(const OverlayContent& content) {
    std::vector<std::string> words = content.heading;
    words.push_back("status: " + content.status);
    words.push_back(fmt::format("frame: {} of {}{}{}", content.frame + 1, content.frames,
                                content.playing ? ", playing" : "", content.live ? ", live" : ""));
    words.push_back("colour: " + content.colour);
    words.push_back("field: " + content.field);
    if (content.has_panel) {
        words.emplace_back("organ:");
        for (const auto& [name, value] : content.panel.rows) words.push_back(fmt::format("  {}: {}", name, value));
        for (const SmallChart& chart : content.panel.charts) {
            words.push_back(fmt::format("  chart: {}, {} points", chart.title, chart.x.size()));
        }
        if (!content.panel.note.empty()) words.push_back("  " + content.panel.note);
    }
    if (!content.help.empty()) words.emplace_back("help:");
    for (const auto& [key, what] : content.help) words.push_back(fmt::format("  {}: {}", key, what));
    return words;
}

}  // namespace espalier::view
