// render: pictures, films and contact sheets of a run, or of a scene that is grown first.
#include "espalier/base/error.h"
#include "espalier/base/stop.h"
#include "espalier/picture/author_view.h"
#include "espalier/picture/render.h"
#include "espalier/simulation/scene.h"

#include "app/command.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/run_command.h"
#include "archive/chosen_frames.h"
#include "axis_surface_options.h"
#include "base/json_text.h"
#include "base/platform.h"
#include "base/text.h"
#include "light_options.h"
#include "picture_options.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t pictures_of_a_turn = 72, pictures_of_a_film = 100;
constexpr double sun_with_sky = 40, eye_with_sky = 4;  // degrees: the horizon is low, and behind the plants is the sky

std::atomic<bool> interrupt{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

/// One living line on a terminal, nothing in a pipe.
class PictureProgress {
public:
    explicit PictureProgress(bool quiet) : shown_(!quiet && platform::has_terminal()) {}
    ~PictureProgress() {
        if (drawn_) fmt::print(stderr, "\n");
    }
    PictureProgress(const PictureProgress&) = delete;
    PictureProgress& operator=(const PictureProgress&) = delete;

    void operator()(std::size_t done, std::size_t all) {
        if (all < 2 || is_traced_) return;
        draw(static_cast<double>(done) / static_cast<double>(all), fmt::format("picture {}/{}", done, all));
    }
    /// Of pictures by light paths: the share of them all that is done.
    void traced(double share) {
        is_traced_ = true;
        const auto now = std::chrono::steady_clock::now();
        if (share < 1 && now - drawn_at_ < std::chrono::milliseconds(100)) return;
        drawn_at_ = now;
        draw(share, fmt::format("{:.0f} %", 100 * share));
    }

private:
    void draw(double share, const std::string& what) {
        if (!shown_) return;
        drawn_ = true;
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
        const double left = share > 0 ? passed.count() * (1 - share) / share : 0;
        const auto bars = static_cast<std::size_t>(30 * share);
        fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {}, {} left\033[K", "", bars, "", 30 - bars, what, duration_text(left));
    }

    bool shown_, drawn_ = false, is_traced_ = false;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), drawn_at_ = start_;
};

/// A large picture takes a while, and nothing can be said in between.
void announce(const PictureSize& size) {
    constexpr std::int64_t large = 16'000'000;
    if (std::int64_t{size.width} * size.height < large) return;
    fmt::print(stderr, "drawing {}x{} pixels; this may take a minute\n", size.width, size.height);
}

class Render final : public Command {
public:
    explicit Render(CLI::App& program)
        : Command(program, "render", "draw a run: pictures, a film, or a contact sheet"),
          model_(app(), "what", "the folder of a run; or a scene, a model or an object, which is grown first",
                 ModelOptions::Files::reading_and_drawing),
          sets_(app()),
          growth_(app()),
          picture_(app()),
          place_of_camera_(app()),
          light_(app()) {
        add_output_options();
        add_look_options();
        add_camera_options();
        app()
            .add_option("--run-output", run_.output, "output folder of the run; default: output/<scene>-<time>")
            ->group("Growing a scene");
        app()
            .add_flag("--overwrite", run_.overwrite, "replace the timeline in the output folder")
            ->group("Growing a scene");
        app().add_flag("--quiet", run_.quiet, "print errors only");
        add_json_flag("print the names of the files as JSON");
        app().footer(R"(Examples:
  espalier render output/two-trees                                        the last frame, as a picture
  espalier render environments/two-trees.toml --output trees.png          grows the scene first
  espalier render output/two-trees --output growth.webm --orbit 90        a film; the camera moves around
  espalier render output/two-trees --sheet 4x2 --output sheet.png         eight stages of growth on one page
  espalier render output/two-trees --colour-by birth --scale-bar --dark
  espalier render output/two-trees --field light:slice=z --colour-by light
  espalier render output/two-roots --field water:volume --elevation 5
  espalier render output/two-roots --field water:iso=0.28 --step 0:200:10 --output roots.png
  espalier render output/two-trees --light                                in the light of sun and sky
  espalier render output/two-trees --masks --no-legend                    depth, normals and organs of the pixels, too
  espalier render output/two-trees --light --sun 150:25 --noise 0.01      the sun behind the trees, with little noise
A recorded run is not grown again. A field must have been recorded ([timeline] fields). `espalier info RUN` lists the content of
a run. docs/render.md shows examples.)");
    }

    int run() override {
        run_.model = model_.arguments();
        run_.model.file = folder_of_run(run_.model.file);
        light_.check();
        const bool is_run = fs::exists(run_.model.file / "run.json");
        if (!is_run) {
            check_before_growing();
            const int code = grow();
            if (code != exit_code::done) return code;
        }
        const RecordedRun recorded(is_run ? run_.model.file : run_.output);
        RenderJob job{recorded, {}, style_of(recorded), camera_, orbit_, ground(), follow_, {}, {}};
        place_camera(job);
        light_.apply(job);
        job.chooses_background = background_.empty() && !picture_.dark();
        PictureProgress progress(run_.quiet || wants_json());
        job.progress = [&](std::size_t done, std::size_t all) {
            progress(done, all);
            if (interrupt) throw Stopped();  // so that what was begun is removed
        };
        job.trace_progress = [&](double share) {
            progress.traced(share);
            if (interrupt) throw Stopped();
        };
        const fs::path output = output_.empty() ? recorded.folder() / "render.png" : output_;
        const platform::EndSignals signals([](int) { interrupt = true; }, true);
        try {
            print_files(draw(job, output));
        } catch (const Stopped&) {
            return exit_code::interrupted;
        }
        return exit_code::done;
    }

private:
    void add_output_options() {
        app().add_option(
            "--output", output_,
            "a picture: .png; or a film: .webm, which browsers play; with ffmpeg .mp4, .gif; default: RUN/render.png");
        app().add_option("--step", step_,
                         std::string(frame_option_help) +
                             "; default: last for a picture; all for a sheet, and for a film 100 of them");
        app().add_option("--sheet", sheet_, "COLUMNSxROWS frames on one page, evenly chosen from those of --step");
        app()
            .add_option(
                "--frames", frames_,
                "number of pictures in a film, evenly chosen from those of --step; default: those of --step, else "
                "at most 100")
            ->check(CLI::Range(1, 100000));
        app()
            .add_option("--between", between_,
                        "number of pictures of a film between two frames, in which organs unfold; default: 0")
            ->check(CLI::Range(0, 100));
        app()
            .add_option("--rate", rate_, "pictures per second of a film; default: the film takes about 10 s")
            ->check(CLI::Range(0.1, 120.0));
        app().add_flag(
            "--masks", masks_,
            "write, beside each picture, the depth, the normal and the organ of every pixel: docs/render.md");
    }

    void add_look_options() {
        app()
            .add_option("--colour-by", colour_by_,
                        "natural, birth, age, order, plant, symbol, kind, colour, radius, "
                        "height, a recorded parameter or field")
            ->capture_default_str();
        app().add_option("--range", range_, "LOW:HIGH, the range of the colours; default: the range in the frames");
        app()
            .add_option("--field", fields_, "NAME:volume, NAME:slice[=AXIS[METRES]], NAME:iso[=VALUE]; may be repeated")
            ->allow_extra_args(false);
        app().add_option("--plant", plant_, "draw or write only this plant, by its name in the scene");
        app().add_option(
            "--background", background_,
            "light, dark, transparent or #rrggbb; default: that of the view file; else light, or dark where most "
            "colours are hardly seen on white");
        ground_option_ = app().add_flag(
            "--ground,!--no-ground", ground_,
            "with or without a ground at height 0; default: with, unless something other than roots is below it");
        axes_.emplace(app());
        app().add_flag("--no-shade", no_shade_, "draw no shadows; faster");
        app().add_flag("--no-legend", no_legend_, "draw no colour bars");
        app().add_flag("--scale-bar", scale_bar_, "draw a scale bar");
        app().add_flag("--time", time_, "write the step or the time on the picture");
        app().add_option("--title", title_, "write a title on the picture");
    }

    void add_camera_options() {
        app()
            .add_option("--azimuth", camera_.azimuth,
                        "degrees about the vertical axis; 0: from the front (looking along -z)")
            ->check(CLI::Range(-36000.0, 36000.0))
            ->capture_default_str();
        app()
            .add_option("--elevation", camera_.elevation, "degrees above the horizon; 90: from above")
            ->check(CLI::Range(-90.0, 90.0))
            ->capture_default_str();
        app()
            .add_option("--zoom", camera_.zoom, "1: everything fits")
            ->check(CLI::Range(0.01, 1000.0))
            ->capture_default_str();
        app()
            .add_option("--orbit", orbit_, "degrees that the camera moves around during a film")
            ->check(CLI::Range(-36000.0, 36000.0));
        app().add_flag("--follow", follow_, "adapt the camera to the plants of each step, instead of all steps");
    }

    /// A mistake that can be known from the words and the scene should not cost the growing.
    void check_before_growing() const {
        (void)range();
        if (!background_.empty()) (void)picture_background(background_);
        if (!step_.empty()) require_frame_option(step_);
        (void)axes_->bark();
        if (!sheet_.empty()) (void)sheet_cells();
        require_masks(output_);
        if (!output_.empty()) {
            sheet_.empty() && is_film(output_) ? require_film_writer(output_) : require_png(output_);
        }
        std::vector<std::string> looks;
        for (const std::string& field : fields_) looks.push_back(field_look(field).name);
        if (!is_scene(run_.model.file)) return;
        const Scene scene = read_scene(run_.model.file, {sets_.overrides(), growth_.steps(), growth_.seed()});
        const std::vector<std::string> fields = scene.timeline.texts_or("fields", {});
        std::vector<std::string> colours = colours_of_every_run(), plants;
        for (const std::string& name : scene.timeline.table("parameters").keys()) colours.push_back(name);
        for (const std::string& name : fields) colours.insert(colours.end(), {name, "field." + name});
        for (const Plant& plant : scene.plants) plants.push_back(plant.name);
        const bool has_all_fields = fields == std::vector<std::string>{"all"};
        for (const std::string& look : looks) {
            if (!has_all_fields)
                require("--field", look, fields, "`fields = [...]` under [timeline] lists the recorded fields");
        }
        if (!has_all_fields) {
            require("--colour-by", colour_by_, colours, "`parameters` and `fields` under [timeline] record more");
        }
        if (!plant_.empty()) require("--plant", plant_, plants, "the plants of the scene have other names");
    }

    void require(const char* option, const std::string& name, const std::vector<std::string>& known,
                 const char* hint) const {
        if (std::find(known.begin(), known.end(), name) != known.end()) return;
        throw UserError(fmt::format("{} {}: {} will have nothing with that name{}; {}", option, name,
                                    run_.model.file.string(), did_you_mean(name, known), hint));
    }

    void place_camera(RenderJob& job) {
        const bool is_turned = app().count("--azimuth") > 0 || app().count("--elevation") > 0;
        job.camera.front_if_flat = !is_turned;
        if (!is_turned && orbit_ == 0) face_slices(job);
        job.style.sun_azimuth = job.camera.azimuth - 50;
        if (light_.is_on()) job.style.sun_elevation = sun_with_sky;
        if (light_.is_on() && app().count("--elevation") == 0) job.camera.elevation = eye_with_sky;
        const auto& view = job.run.view();
        if (!view || is_turned || orbit_ != 0 || place_of_camera_.is_ours()) return;
        job.camera = camera_of(*view);
        job.camera.zoom = camera_.zoom;
        light_as(*view, job.style);
    }

    /// Slices across one axis are seen from the front, where no camera was asked for: at an angle they are strips.
    void face_slices(RenderJob& job) const {
        const std::vector<FieldLook>& fields = job.style.fields;
        const auto lies_alike = [&](const FieldLook& field) {
            return field.kind == FieldLook::Kind::slice && field.axis == fields.front().axis;
        };
        if (fields.empty() || !std::all_of(fields.begin(), fields.end(), lies_alike)) return;
        job.camera.front_if_flat = false;
        job.camera.azimuth = fields.front().axis == 'x' ? 90 : 0;
        job.camera.elevation = fields.front().axis == 'y' ? 90 : 0;
    }

    int grow() {
        run_.overrides = sets_.overrides();
        run_.steps = growth_.steps();
        run_.seed = growth_.seed();
        run_.memory = growth_.memory();
        run_.trust = growth_.trust();
        std::optional<DefaultOutput> unnamed;
        if (run_.output.empty()) run_.output = unnamed.emplace(run_.model.file.stem().string()).path();
        RunArguments silent = run_;
        silent.quiet = silent.quiet || wants_json();
        return run_command(silent);
    }

    PictureStyle style_of(const RecordedRun& run) const {
        PictureStyle style;
        style.colour_by = colour_by_;
        style.range = range();
        if (!plant_.empty()) style.plant = run.plant(plant_);
        for (const std::string& field : fields_) style.fields.push_back(field_look(field));
        if (!background_.empty() || picture_.dark()) {
            style.background = picture_background(background_.empty() ? "dark" : background_);
        }
        style.bark = axes_->bark();
        style.skin = axes_->skin(run.folder());
        style.shading = !no_shade_;
        style.legend = !no_legend_;
        style.scale_bar = scale_bar_;
        style.time_label = time_;
        style.title = title_;
        return style;
    }

    std::optional<bool> ground() const { return ground_option_->count() == 0 ? std::nullopt : std::optional(ground_); }

    std::optional<std::array<double, 2>> range() const {
        if (range_.empty()) return std::nullopt;
        if (const auto range = low_and_high(range_)) return range;
        throw UserError(fmt::format("--range {}: expected LOW:HIGH, such as 0:0.5", range_));
    }

    /// Columns and rows.
    PictureSize sheet_cells() const {
        const PictureSize cells = picture_size("--sheet", sheet_);
        if (std::int64_t{cells.width} * cells.height > 10000) {
            throw UserError(fmt::format("--sheet {}: more than 10,000 frames on one page", sheet_));
        }
        return cells;
    }

    std::vector<fs::path> draw(RenderJob& job, const fs::path& output) const {
        const bool many = is_film(output) || !sheet_.empty();
        if (!sheet_.empty() || !is_film(output)) require_no_between(output);
        require_masks(output);
        job.masks = masks_;
        job.frames = chosen_frames(job.run, !step_.empty() ? step_ : many ? "all" : "last");
        if (!sheet_.empty()) {
            const PictureSize cells = sheet_cells();
            const std::size_t count = static_cast<std::size_t>(cells.width) * static_cast<std::size_t>(cells.height);
            if (count < job.frames.size()) job.frames = evenly(job.frames, count);
            job.size = picture_.size({400, 300});
            render_sheet(job, cells.width, output);
            return {output};
        }
        if (!is_film(output)) {
            job.size = picture_.size({1200, 900});
            if (!run_.quiet && !wants_json()) announce(job.size);
            return render_pictures(job, output);
        }
        job.size = picture_.size({800, 600});
        const bool turns_only = job.frames.size() == 1 && orbit_ != 0;
        std::size_t count = turns_only ? pictures_of_a_turn : job.frames.size();
        if (step_.empty()) count = std::min(count, pictures_of_a_film);
        if (frames_ > 0) count = static_cast<std::size_t>(frames_);
        if (count != job.frames.size()) job.frames = evenly(job.frames, count);
        job.between = between_;
        const auto pictures = static_cast<double>(job.frames.size()) * (between_ + 1);
        const double rate = rate_ > 0 ? rate_ : std::clamp(pictures / 10, 5.0, 30.0);
        render_film(job, rate, output);
        return {output};
    }

    void require_no_between(const fs::path& output) const {
        if (between_ == 0) return;
        throw UserError(fmt::format("--between {}: '{}' is no film; take --output growth.webm (or .mp4, .gif)",
                                    between_, output.string()));
    }

    void require_masks(const fs::path& output) const {
        if (!masks_ || (sheet_.empty() && !is_film(output))) return;
        throw UserError(
            "--masks: films and sheets have no masks; --step all draws every frame as a picture of its own");
    }

    void print_files(const std::vector<fs::path>& files) const {
        if (wants_json()) {
            nlohmann::ordered_json json = nlohmann::ordered_json::array();
            for (const fs::path& file : files) json.push_back(file.string());
            fmt::print("{}\n", json_text(nlohmann::ordered_json{{"files", json}}));
            return;
        }
        if (run_.quiet) return;
        for (const fs::path& file : files) fmt::print("{}\n", file.string());
    }

    ModelOptions model_;
    SetOptions sets_;
    GrowthOptions growth_;
    PictureOptions picture_;
    CameraOption place_of_camera_;
    LightOptions light_;
    std::optional<AxisSurfaceOptions> axes_;
    RunArguments run_;
    CameraPlace camera_;
    fs::path output_;
    std::string step_, sheet_, colour_by_ = "natural", range_, plant_, background_, title_;
    std::vector<std::string> fields_;
    CLI::Option* ground_option_ = nullptr;
    bool ground_ = false;
    int frames_ = 0, between_ = 0;
    double rate_ = 0, orbit_ = 0;
    bool follow_ = false, no_shade_ = false, no_legend_ = false, scale_bar_ = false, time_ = false, masks_ = false;
};

const RegisteredCommand<Render> render_entry{32};

}  // namespace
}  // namespace espalier::app
