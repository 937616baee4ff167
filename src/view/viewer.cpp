#include "view/viewer.h"

#include "espalier/base/error.h"
#include "espalier/picture/author_view.h"

#include "picture/files/off_screen.h"
#include "picture/stage/stage_survey.h"
#include "view/painter.h"

#include <vtkCellPicker.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>

namespace espalier::view {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t frames_ahead = 3;
constexpr std::size_t slow_organs = 100'000;  ///< so many take a while to be drawn, and their shadows seconds
constexpr auto rest = 250ms;                  ///< time after which the user looks at a frame
constexpr double pick_tolerance = 0.003;      ///< share of the window's diagonal: thin twigs must be hit too
constexpr double usual_dots_per_inch = 96;

float scale_of(vtkRenderWindow& window) {
    const int asked = window.GetDPI();
    window.DetectDPI();
    const double ratio = window.GetDPI() / usual_dots_per_inch;
    window.SetDPI(asked);  // letters are measured in pixels
    return static_cast<float>(std::clamp(std::round(4 * ratio) / 4, 1.0, 3.0));
}

std::vector<FieldLook> looks_of(const RecordedRun& run) {
    std::vector<FieldLook> looks;
    for (const std::string& name : run.field_names()) {
        for (const FieldLook::Kind kind : {FieldLook::Kind::slice, FieldLook::Kind::volume, FieldLook::Kind::surface}) {
            FieldLook look;
            look.name = name;
            look.kind = kind;
            looks.push_back(look);
        }
    }
    return looks;
}

void merge(StageSurvey& all, const StageSurvey& one) {
    if (!one.box.empty()) {
        all.box.add(one.box.lower);
        all.box.add(one.box.upper);
    }
    all.outline.add(one.outline);
    const auto widen = [](std::array<double, 2>& range, const std::array<double, 2>& by) {
        range = {std::min(range[0], by[0]), std::max(range[1], by[1])};
    };
    all.drawn += one.drawn;
    all.pale += one.pale;
    if (one.range) widen(all.range ? *all.range : all.range.emplace(*one.range), *one.range);
    for (const auto& [name, range] : one.field_ranges) {
        widen(all.field_ranges.try_emplace(name, range).first->second, range);
    }
}

}  // namespace

Viewer::Viewer(vtkRenderWindow& window, vtkRenderWindowInteractor& interactor, std::function<void()> draw,
               const std::filesystem::path& folder, const ViewOptions& options)
    : window_(window),
      interactor_(interactor),
      draw_(std::move(draw)),
      options_(options),
      follower_(folder),
      style_(options.style) {
    window_.SetNumberOfLayers(2);
    window_.AddRenderer(paper_);
    window_.AddRenderer(&overlay_.renderer());
    paper_->InteractiveOff();
    turntable_->set_hands(this);
    interactor_.SetInteractorStyle(turntable_);
    layout_.scale = scale_of(window_);
    looks_ = looks_of(run());
    camera_ = options_.camera.value_or(run().view() ? camera_of(*run().view()) : CameraPlace{});
    if (!options_.camera && run().view()) light_as(*run().view(), style_);
    background_is_chosen_ = !options_.chooses_background;
    ask_simulation();
    if (options_.step) {
        frame_ = static_cast<std::size_t>(&run().frame(*options_.step) - frames().data());
    } else {
        frame_ = newest();
        live_ = simulation_.running;
    }
    last_look_ = Clock::now();
}

Viewer::~Viewer() {
    if (stage_) window_.RemoveRenderer(&stage_->renderer());
    window_.RemoveRenderer(&overlay_.renderer());
    window_.RemoveRenderer(paper_);
}

void Viewer::tick() {
    if (options_.interrupted && options_.interrupted()) ended_ = true;
    if (Clock::now() - last_look_ > 400ms) {
        last_look_ = Clock::now();
        ask_simulation();
        follow();
    }
    play();
    show_frame();
    add_shadows();
    read_history();
    if (size_ != std::array{window_.GetSize()[0], window_.GetSize()[1]}) dirty_ = true;
    if (dirty_) draw();
}

bool Viewer::is_settled() const {
    if (frames().empty()) return !simulation_.running;
    const bool has_frame = shown_ == frames()[frame_].step || !error_.empty();
    if (wants_shadows() && error_.empty()) return false;
    return has_frame && !dirty_ && !playing_ && (!organ_ || (history_ && history_->finished));
}

void Viewer::ask_simulation() {
    const SimulationState before = simulation_;
    if (options_.simulation) {
        simulation_ = options_.simulation();
    } else {
        const std::string& exit = run().exit();
        const bool killed = exit == "killed";
        simulation_ = {exit == "running", killed || exit.starts_with("failed"), killed ? "the run was killed" : exit};
    }
    if (before.running == simulation_.running && before.text == simulation_.text) return;
    dirty_ = true;
    // The last frame was there before the run said that it ended.
    if (before.running && !simulation_.running) {
        follow();
        settled_ = false;
    }
    if (!simulation_.running) live_ = false;
}

void Viewer::follow() {
    const std::string before = follower_.error();
    if (follower_.look()) take_new_run();
    if (follower_.error() != before) dirty_ = true;
}

void Viewer::take_new_run() {
    dirty_ = true;
    if (follower_.is_another()) {
        reader_.forget();
        select(std::nullopt);
        shown_.reset();
        settled_ = surveyed_ = false;
        if (stage_) window_.RemoveRenderer(&stage_->renderer());
        stage_.reset();
        frame_ = newest();
    }
    asked_.reset();
    if (stage_) stage_->use(run());
    if (stage_) staged_run_ = follower_.run();
    if (looks_.empty()) looks_ = looks_of(run());
    if (live_) {
        frame_ = newest();
        settled_ = false;
    }
    frame_ = std::min(frame_, newest());
    if (organ_ && !follower_.is_another()) ask_history();
}

// By the clock: frames that cannot be drawn in time are left out.
void Viewer::play() {
    if (!playing_ || frames().empty()) return;
    if (shown_ != frames()[frame_].step) return;  // it is being read
    const double seconds = std::chrono::duration<double>(Clock::now() - play_since_).count();
    const std::size_t due = play_from_ + static_cast<std::size_t>(seconds * frames_per_second_);
    if (due > frame_) {
        frame_ = std::min(due, newest());
        dirty_ = true;
    }
    if (frame_ == newest() && !simulation_.running) playing_ = false;
}

void Viewer::show_frame() {
    if (frames().empty()) return;
    const RecordedFrame& frame = frames()[frame_];
    if (shown_ == frame.step) return;
    std::shared_ptr<const FrameData> data = reader_.find(frame);
    if (data) {
        put_on_stage(frame, data);
    } else if (asked_ != frame_) {
        std::vector<RecordedFrame> wanted(
            frames().begin() + static_cast<std::ptrdiff_t>(frame_),
            frames().begin() + static_cast<std::ptrdiff_t>(std::min(frame_ + 1 + frames_ahead, frames().size())));
        reader_.want(follower_.run(), std::move(wanted));
        asked_ = frame_;
        dirty_ = true;
    }
}

void Viewer::put_on_stage(const RecordedFrame& frame, const std::shared_ptr<const FrameData>& data) {
    data_ = data;
    error_ = data->error;
    dirty_ = true;
    shown_ = frame.step;
    frame_since_ = Clock::now();
    asked_.reset();
    if (!error_.empty()) return;
    const bool is_first = !stage_;
    if (is_first) make_stage();
    // While a run grows, each frame is its own measure, until another one was looked at.
    const bool settles = !settled_ && (!simulation_.running || surveyed_);
    try {
        if (settles) settle();
        stage_->shade(false);
        stage_frame();
    } catch (const UserError& error) {
        error_ = error.what();
        return;
    }
    turntable_->set_flat(stage_->is_flat());
    if (is_first || (camera_is_mine_ && (live_ || settles))) reset_camera();
    // What comes next while this is looked at.
    std::vector<RecordedFrame> next;
    for (std::size_t i = frame_ + 1; i < frames().size() && next.size() < frames_ahead; ++i)
        next.push_back(frames()[i]);
    reader_.want(follower_.run(), std::move(next));
}

void Viewer::stage_frame() {
    if (data_->internodes + data_->organs > slow_organs) {
        busy_ = "drawing ...";
        draw();
        busy_.clear();
    }
    stage_->show(run().frame(*shown_), {data_, &data_->geometry});
    dirty_ = true;
}

bool Viewer::is_at_rest() const {
    return !playing_ && !sliding_ && Clock::now() - frame_since_ > rest;
}

bool Viewer::wants_shadows() const {
    return stage_ && data_ && style_.shading && !stage_->style().shading && !stage_->is_flat() &&
           data_->internodes + data_->organs <= slow_organs;
}

// They take longer than the frame itself: not while frames follow each other.
void Viewer::add_shadows() {
    if (!wants_shadows() || !is_at_rest() || shown_ != frames()[frame_].step) return;
    stage_->shade(true);
    stage_frame();
}

void Viewer::make_stage() {
    staged_run_ = follower_.run();
    stage_ = std::make_unique<Stage>(*staged_run_, style_);
    window_.AddRenderer(&stage_->renderer());
    lay_out();
}

// Colours and camera hold for the whole run: those that fit its first frame and its last, where plants are largest.
// They hold from the next stage_frame() on.
void Viewer::settle() {
    if (!stage_ || !data_ || frames().empty()) return;
    settled_ = surveyed_ = true;
    const RecordedFrame &first = frames().front(), &last = frames().back();
    StageSurvey survey;
    for (const RecordedFrame* frame : {&first, &last}) {
        if (frame->plants.empty()) continue;
        std::shared_ptr<const FrameData> data = shown_ == frame->step ? data_ : reader_.find(*frame);
        merge(survey, data ? stage_->survey(*frame, data->geometry) : stage_->survey(*frame, run().geometry(*frame)));
    }
    stage_->settle(survey);
    choose_background(survey);
}

void Viewer::choose_background(const StageSurvey& survey) {
    if (background_is_chosen_ || survey.box.empty()) return;
    background_is_chosen_ = true;
    style_.background = chosen_background(run(), survey, style_.background);
    PictureStyle staged = stage_->style();
    staged.background = style_.background;
    stage_->restyle(staged);
}

void Viewer::ask_history() {
    if (!organ_ || !shown_) return;
    history_reader_.ask(follower_.run(), *organ_, *shown_);
}

void Viewer::read_history() {
    std::optional<HistoryReader::Answer> answer = history_reader_.poll();
    if (!answer || !organ_) return;
    history_ = std::move(answer);
    dirty_ = true;
}

void Viewer::lay_out() {
    size_ = {window_.GetSize()[0], window_.GetSize()[1]};
    layout_ = layout_of_window(size_[0], size_[1], layout_.scale, organ_.has_value(), simulation_.running);
    if (!stage_) return;
    const double width = std::max(1, size_[0]), height = std::max(1, size_[1]);
    const Rectangle& scene = layout_.scene;
    stage_->renderer().SetViewport(scene.x / width, scene.y / height, (scene.x + scene.width) / width, 1);
}

void Viewer::draw() {
    dirty_ = false;
    lay_out();
    const auto& rgb = style_.background.rgb;
    paper_->SetBackground(rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
    overlay_.show(layout_, content());
    if (stage_) stage_->renderer().ResetCameraClippingRange();
    draw_();
}

void Viewer::save_picture(const std::filesystem::path& path) {
    draw();
    vtkNew<vtkWindowToImageFilter> reader;
    reader->SetInput(&window_);
    reader->SetInputBufferTypeToRGB();
    reader->ReadFrontBufferOff();
    reader->ShouldRerenderOff();
    reader->Update();
    write_png(path, *reader->GetOutput());
}

void Viewer::click(int x, int y) {
    if (!stage_) return;
    vtkNew<vtkCellPicker> picker;
    picker->SetTolerance(pick_tolerance);
    picker->Pick(x, y, 0, &stage_->renderer());
    vtkProp* prop = picker->GetViewProp();
    const auto module = prop ? stage_->module_at(prop, picker->GetCellId()) : std::nullopt;
    select(module ? std::optional(OrganKey{module->plant, module->identity}) : std::nullopt);
}

void Viewer::select(std::optional<OrganKey> organ) {
    const bool has_panel_now = organ.has_value(), had_panel = organ_.has_value();
    organ_ = organ;
    history_.reset();
    dirty_ = true;
    if (stage_) {
        stage_->highlight(organ ? std::optional(Stage::Highlight{organ->plant, organ->identity}) : std::nullopt);
    }
    ask_history();
    if (has_panel_now != had_panel && camera_is_mine_) reset_camera();
}

void Viewer::select_parent() {
    if (!organ_ || !history_) return;
    if (history_->history.parent == 0) {
        say("it stands at the beginning and has no parent");
        return;
    }
    select(OrganKey{organ_->plant, history_->history.parent});
}

void Viewer::reset_camera() {
    camera_is_mine_ = true;
    dirty_ = true;
    if (!stage_) return;
    lay_out();
    stage_->place_camera(camera_, !settled_);
}

void Viewer::camera_moved() {
    camera_is_mine_ = false;
    dirty_ = true;
}

}  // namespace espalier::view
