// The window's mind: what is shown, what is read next, and what keys and mouse mean. It draws into a window that is
// given, on screen or not.
#pragma once

#include "espalier/view/run_view.h"

#include "picture/stage/stage.h"
#include "view/frame_reader.h"
#include "view/history_reader.h"
#include "view/overlay.h"
#include "view/run_follower.h"
#include "view/turntable.h"

#include <vtkNew.h>

#include <chrono>
#include <functional>

class vtkRenderWindow;
class vtkRenderWindowInteractor;

namespace espalier::view {

class Viewer final : public WindowHands {
public:
    /// `draw` renders the window. Throws UserError if there is no run.
    Viewer(vtkRenderWindow& window, vtkRenderWindowInteractor& interactor, std::function<void()> draw,
           const std::filesystem::path& folder, const ViewOptions& options);
    ~Viewer() override;

    /// Does what is due: follows the run, plays, takes over what was read, draws if something changed. To be called
    /// some fifty times a second. Throws UserError for a style that the run cannot have.
    void tick();
    /// Everything asked for is on the window.
    bool is_settled() const;
    /// Nothing more will come: the run has ended, and its last frame is known.
    bool run_has_ended() const { return !simulation_.running; }
    bool is_ended() const { return ended_; }

    /// The window as it is, as a .png.
    void save_picture(const std::filesystem::path& path);
    /// All words of the window.
    std::vector<std::string> words() const { return words_of(overlay_.content()); }

    bool press(int x, int y) override;
    void drag(int x, int y) override;
    void release() override;
    void click(int x, int y) override;
    void key(const std::string& name, bool shift) override;
    void camera_moved() override;

private:
    using Clock = std::chrono::steady_clock;

    const RecordedRun& run() const { return *follower_.run(); }
    const std::vector<RecordedFrame>& frames() const { return run().frames(); }
    std::size_t newest() const { return frames().empty() ? 0 : frames().size() - 1; }

    void follow();
    void take_new_run();
    void ask_simulation();
    void play();
    void show_frame();
    bool is_at_rest() const;
    bool wants_shadows() const;
    void add_shadows();
    void put_on_stage(const RecordedFrame& frame, const std::shared_ptr<const FrameData>& data);
    void make_stage();
    /// Shows what data_ holds.
    void stage_frame();
    void settle();
    void read_history();
    void ask_history();
    void draw();
    void lay_out();
    OverlayContent content() const;
    std::vector<std::string> heading() const;
    OrganPanel panel() const;
    std::string status() const;

    void go_to(std::size_t frame);
    void step_by(int frames);
    void set_playing(bool playing);
    void set_live(bool live);
    void change_speed(double factor);
    void do_control(Control control);
    void next_colour(int direction);
    void next_field();
    void restyle(const PictureStyle& style);
    void toggle(bool PictureStyle::*what, const std::string& name);
    void select(std::optional<OrganKey> organ);
    void select_parent();
    void reset_camera();
    void choose_background(const StageSurvey& survey);
    void save_numbered_picture();
    void say(std::string message);

    vtkRenderWindow& window_;
    vtkRenderWindowInteractor& interactor_;
    std::function<void()> draw_;
    ViewOptions options_;
    RunFollower follower_;
    SimulationState simulation_;
    FrameReader reader_;
    HistoryReader history_reader_;
    std::shared_ptr<const RecordedRun> staged_run_;  ///< what the stage uses; outlives it
    std::unique_ptr<Stage> stage_;
    Overlay overlay_;
    vtkNew<vtkRenderer> paper_;  ///< behind all else
    vtkNew<Turntable> turntable_;
    WindowLayout layout_;
    CameraPlace camera_;
    PictureStyle style_;  ///< `shading`: what is wished; the stage has it where there is time for it

    std::size_t frame_ = 0;             ///< the frame that is asked for
    std::optional<std::size_t> asked_;  ///< the frame that the reader was asked for
    std::optional<int> shown_;          ///< the step on the stage
    std::shared_ptr<const FrameData> data_;
    bool live_ = false, playing_ = false, help_ = false, sliding_ = false;
    bool settled_ = false, surveyed_ = false;  ///< the stage has the measures of the whole run; of some of it
    bool camera_is_mine_ = true;               ///< the user has not moved it yet
    bool background_is_chosen_ = false;        ///< for good
    double frames_per_second_ = 10;
    std::size_t play_from_ = 0;
    Clock::time_point play_since_, last_look_, frame_since_;
    std::vector<FieldLook> looks_;  ///< what `f` goes through, after none
    std::size_t look_ = 0;          ///< 0: none
    std::optional<OrganKey> organ_;
    std::optional<HistoryReader::Answer> history_;
    std::string message_, error_, busy_;
    bool dirty_ = true, ended_ = false;
    std::array<int, 2> size_{0, 0};
};

}  // namespace espalier::view
