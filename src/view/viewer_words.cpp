// What the window says.

#include "view/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::view {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

const Pairs& keys() {
    static const Pairs pairs{
        {"drag", "turn; plants stay upright"},
        {"Shift + drag, middle", "move"},
        {"wheel, right drag", "nearer, farther"},
        {"click", "pick an organ and read its history"},
        {"Space", "play, pause"},
        {"Left, Right", "a frame back, a frame on; with Shift ten"},
        {"Home, End", "the first frame, the newest"},
        {"+, -", "play faster, slower"},
        {"f", "next field: slice, cloud, surface, none"},
        {"c, Shift + C", "what organs are coloured by: next, previous"},
        {"l, g, b", "shadows, ground, light or dark"},
        {"p", "the organ that bore the picked one"},
        {"Esc", "let go of the picked organ"},
        {"r", "the camera back to where everything is seen"},
        {"s", "save a picture"},
        {"h, ?", "this help"},
        {"q", "close"},
    };
    return pairs;
}

std::string counted(std::size_t count, const std::string& noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string look_name(const FieldLook& look) {
    switch (look.kind) {
        case FieldLook::Kind::slice:
            return look.name + ", slice";
        case FieldLook::Kind::surface:
            return look.name + ", surface";
        default:
            return look.name + ", cloud";
    }
}

/// A chart of one number of each moment; none if it is not known anywhere.
template <class Value>
void add_chart(std::vector<SmallChart>& charts, const OrganHistory& history, const std::string& title, Value value) {
    SmallChart chart{title, {}, {}};
    bool known = false;
    for (const OrganMoment& moment : history.moments) {
        chart.x.push_back(moment.step);
        chart.y.push_back(value(moment));
        known = known || std::isfinite(chart.y.back());
    }
    if (known) charts.push_back(std::move(chart));
}

}  // namespace

OverlayContent Viewer::content() const {
    OverlayContent content;
    content.dark = style_.background.is_dark();
    content.heading = heading();
    content.status = status();
    content.status_is_error = !error_.empty() || !follower_.error().empty() || simulation_.failed;
    content.frame = frame_;
    content.frames = frames().size();
    content.playing = playing_;
    content.live = live_;
    content.colour = style_.colour_by;
    content.field = style_.fields.empty() ? "none" : look_name(style_.fields.front());
    if (help_) content.help = keys();
    content.has_panel = organ_.has_value();
    if (organ_) content.panel = panel();
    return content;
}

std::vector<std::string> Viewer::heading() const {
    std::vector<std::string> lines{run().scene()};
    if (!shown_ || !data_) return lines;
    const RecordedFrame& frame = run().frame(*shown_);
    std::string time = fmt::format("step {}", frame.step);
    if (run().time_unit() != "step") time += fmt::format(", {} {:.6g}", run().time_unit(), frame.time);
    lines.push_back(time);
    lines.push_back(fmt::format("{}, {}, {}", counted(data_->plants, "plant"), counted(data_->internodes, "internode"),
                                counted(data_->organs, "organ")));
    return lines;
}

std::string Viewer::status() const {
    if (!busy_.empty()) return busy_;
    if (!error_.empty()) return error_;
    if (!follower_.error().empty()) return follower_.error();
    if (simulation_.failed) return simulation_.text;
    if (frames().empty()) return simulation_.running ? "waiting for the first frame" : "this run has no frames";
    if (shown_ != frames()[frame_].step) return fmt::format("reading step {} ...", frames()[frame_].step);
    if (!message_.empty()) return message_;
    if (simulation_.running)
        return fmt::format("running: step {} is the newest{}", frames().back().step, live_ ? "" : "; End goes there");
    if (simulation_.text != "done") return simulation_.text;
    return "h shows what keys and mouse do";
}

OrganPanel Viewer::panel() const {
    OrganPanel panel;
    panel.step = shown_.value_or(0);
    if (!history_) {
        panel.note = "reading its history ...";
        return panel;
    }
    const OrganHistory& history = history_->history;
    if (!history_->error.empty()) {
        panel.note = history_->error;
        return panel;
    }
    if (history.moments.empty()) {
        panel.note = history_->finished ? "no frame draws it" : "reading its history ...";
        return panel;
    }
    panel.rows = described(history, run(), static_cast<int>(panel.step));
    if (!history_->finished) panel.note = fmt::format("frame {} of {} ...", history_->done, history_->frames);
    if (history.kind != Kind::query && history.kind != Kind::label) {
        add_chart(panel.charts, history, "length, m", [](const OrganMoment& moment) { return moment.length; });
    }
    if (history.kind == Kind::axis) {
        add_chart(panel.charts, history, "radius at its base, mm",
                  [](const OrganMoment& moment) { return 1000 * moment.base_radius; });
    } else if (history.kind != Kind::query && history.kind != Kind::label) {
        add_chart(panel.charts, history, "area, m2", [](const OrganMoment& moment) { return moment.area; });
    }
    for (std::size_t i = 0; i < history.parameters.size(); ++i) {
        add_chart(panel.charts, history, history.parameters[i],
                  [i](const OrganMoment& moment) { return moment.parameters[i]; });
    }
    return panel;
}

}  // namespace espalier::view
