// What keys and controls of the window do.
#include "espalier/base/error.h"

#include "base/reason.h"
#include "view/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace espalier::view {

void Viewer::say(std::string message) {
    message_ = std::move(message);
    dirty_ = true;
}

void Viewer::go_to(std::size_t frame) {
    message_.clear();
    live_ = false;
    frame_ = std::min(frame, newest());
    play_from_ = frame_;
    play_since_ = Clock::now();
    dirty_ = true;
    if (!settled_ && shown_ && shown_ != frames()[frame_].step) settle();
}

void Viewer::step_by(int count) {
    set_playing(false);
    const auto last = static_cast<std::ptrdiff_t>(newest());
    go_to(static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(frame_) + count, 0, last)));
}

// Playing begins again where it ended.
void Viewer::set_playing(bool playing) {
    if (playing && frame_ == newest() && !simulation_.running) frame_ = 0;
    if (playing) go_to(frame_);
    playing_ = playing && frames().size() > 1;
    dirty_ = true;
}

void Viewer::set_live(bool live) {
    playing_ = false;
    live_ = live && simulation_.running;
    if (live_) {
        frame_ = newest();
        settled_ = false;
    }
    dirty_ = true;
}

void Viewer::change_speed(double factor) {
    frames_per_second_ = std::clamp(factor * frames_per_second_, 0.625, 160.0);
    play_from_ = frame_;
    play_since_ = Clock::now();
    say(fmt::format("plays {:.3g} frames a second", frames_per_second_));
}

void Viewer::do_control(Control control) {
    switch (control) {
        case Control::first:
            set_playing(false);
            return go_to(0);
        case Control::back:
            return step_by(-1);
        case Control::play:
            return set_playing(!playing_);
        case Control::forward:
            return step_by(1);
        case Control::last:
            go_to(newest());
            return set_live(true);
        case Control::live:
            return set_live(!live_);
        case Control::colour:
            return next_colour(1);
        case Control::field:
            return next_field();
        case Control::help:
            help_ = !help_;
            dirty_ = true;
            return;
        case Control::close_panel:
            return select(std::nullopt);
        case Control::slider:
        case Control::inside:
            return;
    }
}

void Viewer::restyle(const PictureStyle& style) {
    const bool needs_survey = style.colour_by != style_.colour_by || style.fields.size() != style_.fields.size();
    try {
        if (stage_) {
            PictureStyle staged = style;
            staged.shading = false;
            stage_->restyle(staged);
        }
        style_ = style;
        if (settled_ && needs_survey) {
            settle();
            stage_frame();
        }
    } catch (const UserError& error) {
        say(reason_of(error));
    }
    if (camera_is_mine_) reset_camera();  // legends take room
    dirty_ = true;
}

void Viewer::next_colour(int direction) {
    if (!stage_) return;
    const std::vector<std::string> names = stage_->colour_names();
    const auto here = std::find(names.begin(), names.end(), style_.colour_by) - names.begin();
    const auto count = static_cast<std::ptrdiff_t>(names.size());
    PictureStyle style = style_;
    style.colour_by = names[static_cast<std::size_t>((here + direction + count) % count)];
    style.range.reset();
    restyle(style);
}

void Viewer::next_field() {
    if (looks_.empty()) return say("this run has no fields: its scene names them by fields = [\"...\"]");
    look_ = (look_ + 1) % (looks_.size() + 1);
    PictureStyle style = style_;
    style.fields.clear();
    if (look_ > 0) style.fields.push_back(looks_[look_ - 1]);
    restyle(style);
}

void Viewer::toggle(bool PictureStyle::*what, const std::string& name) {
    PictureStyle style = style_;
    style.*what = !(style.*what);
    restyle(style);
    say(fmt::format("{} {}", name, style_.*what ? "on" : "off"));
}

void Viewer::save_numbered_picture() {
    const std::string name = fmt::format("{}-{}", run().scene(), shown_.value_or(0));
    std::filesystem::path path = name + ".png";
    for (int number = 2; std::filesystem::exists(path); ++number) path = fmt::format("{}-{}.png", name, number);
    try {
        save_picture(path);
        say("saved " + path.string());
    } catch (const std::exception& error) {
        say(error.what());
    }
}

bool Viewer::press(int x, int y) {
    if (help_) {
        help_ = false;
        dirty_ = true;
        return true;
    }
    const auto control = layout_.at(x, y);
    if (!control) return false;
    if (*control == Control::slider) {
        sliding_ = true;
        set_playing(false);
        drag(x, y);
    } else {
        do_control(*control);
    }
    return true;
}

void Viewer::drag(int x, int) {
    if (sliding_) go_to(layout_.frame_at(x, frames().size()));
}

void Viewer::release() {
    sliding_ = false;
}

void Viewer::key(const std::string& name, bool shift) {
    if (help_ && name != "h" && name != "question") {
        help_ = false;
        dirty_ = true;
        if (name == "Escape") return;
    }
    constexpr int far = 10;
    if (name == "space") do_control(Control::play);
    if (name == "Left") step_by(shift ? -far : -1);
    if (name == "Right") step_by(shift ? far : 1);
    if (name == "Home") do_control(Control::first);
    if (name == "End") do_control(Control::last);
    if (name == "plus" || name == "equal" || name == "KP_Add") change_speed(2);
    if (name == "minus" || name == "KP_Subtract") change_speed(0.5);
    if (name == "f") next_field();
    if (name == "c") next_colour(1);
    if (name == "C") next_colour(-1);
    if (name == "g") toggle(&PictureStyle::ground, "ground");
    if (name == "l") toggle(&PictureStyle::shading, "shadows");
    if (name == "b") {
        PictureStyle style = style_;
        style.background = style_.background.is_dark() ? light_background : dark_background;
        restyle(style);
    }
    if (name == "p") select_parent();
    if (name == "Escape") select(std::nullopt);
    if (name == "r") reset_camera();
    if (name == "s") save_numbered_picture();
    if (name == "h" || name == "question") do_control(Control::help);
    if (name == "q") ended_ = true;
}

}  // namespace espalier::view
