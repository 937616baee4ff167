#include "espalier/view/run_view.h"

#include "espalier/base/error.h"

#include "picture/files/off_screen.h"
#include "view/script.h"
#include "view/viewer.h"

#include <fmt/format.h>
#include <vtkAutoInit.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <exception>
#include <thread>

VTK_MODULE_INIT(vtkRenderingUI);
VTK_MODULE_INIT(vtkInteractionStyle);

namespace espalier::view {
namespace {

using namespace std::chrono_literals;

constexpr auto beat = 20ms;

/// Plays a script on a window, a line whenever the window has shown what the line before asked for.
class ScriptPlayer {
public:
    ScriptPlayer(Viewer& viewer, vtkRenderWindow& window, vtkRenderWindowInteractor& interactor,
                 const ViewOptions& options)
        : viewer_(viewer), window_(window), interactor_(interactor), options_(options) {
        lines_ = parse_script(options.script);
        if (!options.screenshot.empty()) {
            ScriptLine last;
            last.kind = ScriptLine::Kind::screenshot;
            last.word = options.screenshot.string();
            lines_.push_back(last);
        }
    }

    bool is_empty() const { return lines_.empty(); }
    bool is_done() const { return next_ == lines_.size(); }

    void play() {
        if (is_done() || !viewer_.is_settled()) return;
        if (lines_[next_].kind == ScriptLine::Kind::wait && !viewer_.run_has_ended()) return;
        play(lines_[next_++]);
    }

private:
    void play(const ScriptLine& line) {
        const auto& n = line.numbers;
        switch (line.kind) {
            case ScriptLine::Kind::key:
                point(0, 0, line.shift, line.word.c_str());
                return invoke(vtkCommand::KeyPressEvent);
            case ScriptLine::Kind::click:
                point(n[0], n[1]);
                invoke(vtkCommand::LeftButtonPressEvent);
                return invoke(vtkCommand::LeftButtonReleaseEvent);
            case ScriptLine::Kind::drag:
                return drag(line);
            case ScriptLine::Kind::wheel:
                point(n[0], n[1]);
                for (int i = 0; i < std::abs(n[2]); ++i) {
                    invoke(n[2] > 0 ? vtkCommand::MouseWheelForwardEvent : vtkCommand::MouseWheelBackwardEvent);
                }
                return;
            case ScriptLine::Kind::size:
                window_.SetSize(n[0], n[1]);
                return;
            case ScriptLine::Kind::screenshot:
                return viewer_.save_picture(line.word);
            case ScriptLine::Kind::print:
                for (const std::string& words : viewer_.words()) {
                    if (options_.print) options_.print(words);
                }
                return;
            case ScriptLine::Kind::wait:
                return;
        }
    }

    void drag(const ScriptLine& line) {
        constexpr int moves = 12;
        const auto& n = line.numbers;
        point(n[0], n[1], line.shift);
        invoke(vtkCommand::LeftButtonPressEvent);
        for (int i = 1; i <= moves; ++i) {
            point(n[0] + (n[2] - n[0]) * i / moves, n[1] + (n[3] - n[1]) * i / moves, line.shift);
            invoke(vtkCommand::MouseMoveEvent);
        }
        invoke(vtkCommand::LeftButtonReleaseEvent);
    }

    void point(int x, int y, bool shift = false, const char* key = nullptr) {
        interactor_.SetEventInformationFlipY(x, y, 0, shift, 0, 0, key);
    }
    void invoke(unsigned long event) { interactor_.InvokeEvent(event, nullptr); }

    Viewer& viewer_;
    vtkRenderWindow& window_;
    vtkRenderWindowInteractor& interactor_;
    const ViewOptions& options_;
    std::vector<ScriptLine> lines_;
    std::size_t next_ = 0;
};

bool is_over(const Viewer& viewer, const ScriptPlayer& player) {
    return viewer.is_ended() || (!player.is_empty() && player.is_done());
}

void view_off_screen(const std::filesystem::path& folder, const ViewOptions& options) {
    OffScreenWindow off_screen(options.size.width, options.size.height);
    vtkNew<vtkGenericRenderWindowInteractor> interactor;
    interactor->EnableRenderOff();
    interactor->SetRenderWindow(&off_screen.window());
    interactor->SetSize(options.size.width, options.size.height);
    interactor->Initialize();
    Viewer viewer(
        off_screen.window(), *interactor, [&] { off_screen.render(); }, folder, options);
    ScriptPlayer player(viewer, off_screen.window(), *interactor, options);
    while (!is_over(viewer, player)) {
        viewer.tick();
        player.play();
        if (!viewer.is_settled()) std::this_thread::sleep_for(beat);
    }
}

/// What goes on while X waits for the user. VTK is written in C++, but not for exceptions to pass through.
struct Beat {
    Viewer& viewer;
    ScriptPlayer& player;
    vtkRenderWindowInteractor& interactor;
    std::exception_ptr failure;

    void operator()() {
        try {
            viewer.tick();
            player.play();
            if (is_over(viewer, player)) interactor.TerminateApp();
        } catch (...) {
            failure = std::current_exception();
            interactor.TerminateApp();
        }
    }
};

void view_on_screen(const std::filesystem::path& folder, const ViewOptions& options) {
    vtkNew<vtkRenderWindow> window;
    vtkNew<vtkRenderWindowInteractor> interactor;
    window->SetSize(options.size.width, options.size.height);
    window->SetMultiSamples(4);
    window->SetWindowName(fmt::format("{} - Espalier", RecordedRun(folder).scene()).c_str());
    interactor->SetRenderWindow(window);
    interactor->EnableRenderOff();
    {
        Viewer viewer(
            *window, *interactor, [&] { window->Render(); }, folder, options);
        ScriptPlayer player(viewer, *window, *interactor, options);
        Beat on_beat{viewer, player, *interactor, nullptr};
        vtkNew<vtkCallbackCommand> timer;
        timer->SetClientData(&on_beat);
        timer->SetCallback([](vtkObject*, unsigned long, void* data, void*) { (*static_cast<Beat*>(data))(); });
        interactor->Initialize();
        interactor->AddObserver(vtkCommand::TimerEvent, timer);
        interactor->CreateRepeatingTimer(static_cast<unsigned long>(beat.count()));
        interactor->Start();
        if (on_beat.failure) std::rethrow_exception(on_beat.failure);
    }
    window->Finalize();
}

}  // namespace

std::string why_no_window() {
    if (has_display()) return "";
    return "no window opens here: no X display answers.\n"
           "`espalier render` and `espalier view --screenshot FILE.png` draw without one; or apt-get install xvfb "
           "xauth and put `xvfb-run -a` in front of the command";
}

void view_run(const std::filesystem::path& folder, const ViewOptions& options) {
    parse_script(options.script);
    if (has_display()) return view_on_screen(folder, options);
    if (options.script.empty() && options.screenshot.empty()) throw RunError(why_no_window());
    view_off_screen(folder, options);
}

}  // namespace espalier::view
