#include "espalier/picture/render.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "archive/unfolding.h"
#include "picture/files/film.h"
#include "picture/files/frame_painter.h"
#include "picture/files/picture_masks.h"
#include "picture/stage/colouring.h"
#include "picture/stage/legend.h"
#include "picture/stage/sky_visibility.h"
#include "picture/stage/stage_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace espalier::picture {
namespace {

namespace fs = std::filesystem;

/// Roots are seen through the ground. Paths of light do not show what is beneath: there, more must stand above.
bool wants_ground(const StageSurvey& survey, const PictureStyle& style) {
    if (survey.box.empty()) return false;
    if (!survey.grows_beneath()) return true;
    if (!style.fields.empty() || !survey.is_rooted()) return false;
    return !style.light || survey.box.upper.y > -survey.box.lower.y;
}

/// Draws the frames of a job one after the other.
class JobPainter {
public:
    explicit JobPainter(const RenderJob& job) : job_(job), painter_(job.run, job.style, job.size) {
        if (job.frames.empty()) throw UserError(fmt::format("{} has no frames", job.run.folder().string()));
        Stage& stage = painter_.stage();
        const StageSurvey survey = stage.survey(distinct_frames());
        require_something(survey);
        stage.settle(survey);
        PictureStyle style = job.style;
        style.ground = job.ground.value_or(wants_ground(survey, style));
        if (job.chooses_background && !(style.light && style.light->shows_sky))
            style.background = chosen_background(job.run, survey, style.background);
        stage.restyle(style);
        place_ = job.camera;
        place_.turns = place_.turns || job.orbit != 0;
    }

    /// Those of the frames, and those between them.
    std::size_t pictures() const { return (job_.frames.size() - 1) * pictures_of_frame() + 1; }

    /// Seen from another azimuth, if there is one.
    vtkSmartPointer<vtkImageData> picture(std::size_t i, std::optional<double> azimuth = {}) {
        const std::size_t frame = i / pictures_of_frame(), part = i % pictures_of_frame();
        const CameraPlace place = place_at(i, azimuth);
        vtkSmartPointer<vtkImageData> drawn;
        if (part == 0 && is_in_pieces(*job_.frames[frame])) {
            drawn = picture_of_pieces(*job_.frames[frame], place);
        } else {
            if (part == 0)
                show(*job_.frames[frame]);
            else
                show_between(frame, static_cast<double>(part) / static_cast<double>(pictures_of_frame()));
            painter_.stage().place_camera(place, job_.follow);
            drawn = job_.style.light ? traced(i, *job_.frames[frame]) : painter_.picture();
        }
        if (job_.progress) job_.progress(i + 1, pictures());
        return drawn;
    }

    /// Beside a picture of frame `i`. Returns the files.
    std::vector<fs::path> write_masks_of(std::size_t i, std::optional<double> azimuth, const fs::path& picture) {
        Stage& stage = painter_.stage();
        if (is_in_pieces(*job_.frames[i])) show(*job_.frames[i]);  // rays need all plants at once
        stage.place_camera(place_at(i, azimuth), job_.follow);
        if (!mask_scene_) mask_scene_.emplace(stage);
        return write_masks(mask_scene_->masks(job_.size), mask_scene_->organs(), job_.run, stage, picture);
    }

    Stage& stage() { return painter_.stage(); }

private:
    CameraPlace place_at(std::size_t i, std::optional<double> azimuth) const {
        CameraPlace place = place_;
        place.azimuth = azimuth.value_or(place.azimuth) + turned(i);
        return place;
    }

    std::size_t pictures_of_frame() const { return static_cast<std::size_t>(job_.between) + 1; }

    void show(const RecordedFrame& frame) {
        Stage& stage = painter_.stage();
        if (!unfolding_ && stage.shown() && stage.shown()->step == frame.step) return;
        unfolding_.reset();
        mask_scene_.reset();
        stage.show(frame);
    }

    // Light paths need all plants at once.
    bool is_in_pieces(const RecordedFrame& frame) const { return !frame.more_plants.empty() && !job_.style.light; }

    // In memory is one file of the frame at a time.
    vtkSmartPointer<vtkImageData> picture_of_pieces(const RecordedFrame& frame, const CameraPlace& place) {
        Stage& stage = painter_.stage();
        unfolding_.reset();
        mask_scene_.reset();
        if (!pieces_ || pieces_->step != frame.step) take_pieces(frame);
        for (const RecordedFrame& piece : pieces_->frames) {
            stage.show_piece(piece, pieces_->whole, pieces_->visibility ? &*pieces_->visibility : nullptr);
            stage.place_camera(place, job_.follow);
            painter_.add();
        }
        return painter_.picture_of_all();
    }

    void take_pieces(const RecordedFrame& frame) {
        Stage& stage = painter_.stage();
        pieces_ = {frame.step, frame.pieces(), stage.survey(std::array{&frame}), std::nullopt};
        const PictureStyle& style = stage.style();
        const Box& box = pieces_->whole.box;
        if (!style.shading || stage.is_flat() || box.empty()) return;
        SkyVisibility visibility(box.lower, box.upper, direction_at(style.sun_azimuth, style.sun_elevation));
        for (const RecordedFrame& piece : pieces_->frames) {
            stage.show_piece(piece, pieces_->whole, nullptr);
            stage.add_occluders(visibility);
        }
        pieces_->visibility = std::move(visibility);
    }

    void show_between(std::size_t frame, double share) {
        const RecordedFrame &early = *job_.frames[frame], &late = *job_.frames[frame + 1];
        if (early.plants.empty() || late.plants.empty() || early.step == late.step) return show(early);
        if (!unfolding_) unfolding_.emplace(job_.run.geometry(early), job_.run.geometry(late));
        RecordedFrame now = early;
        now.time = std::lerp(early.time, late.time, share);
        painter_.stage().show(now, std::make_shared<FrameGeometry>(unfolding_->at(share)));
    }

    vtkSmartPointer<vtkImageData> traced(std::size_t i, const RecordedFrame& frame) {
        const auto progress = [&](double share) {
            const double done = static_cast<double>(i) + share;
            if (job_.trace_progress) job_.trace_progress(done / static_cast<double>(pictures()));
        };
        return painter_.traced(job_.sky_at ? job_.sky_at(frame) : job_.style.light->sky, progress);
    }

    static bool is_empty(const StageSurvey& survey) { return survey.outline.empty() && !survey.has_labels; }

    // A plant may begin with nothing to see; one that ends so is hardly what was meant.
    void require_something(const StageSurvey& survey) {
        const RecordedFrame* const last = &job_.run.frames().back();
        if (!is_empty(survey) || job_.run.background() || !is_empty(painter_.stage().survey({&last, 1}))) return;
        throw UserError(fmt::format(
            "{}: nothing to draw: no line, surface or organ in the frame of step {}{}, nor in the last one; "
            "`espalier info` tells what the plants are made of",
            job_.run.folder().string(), job_.frames.back()->step,
            job_.style.plant ? " of plant " + job_.run.plants()[*job_.style.plant].name : ""));
    }

    std::vector<const RecordedFrame*> distinct_frames() const {
        std::vector<const RecordedFrame*> frames;
        for (const RecordedFrame* frame : job_.frames) {
            if (frames.empty() || frames.back()->step != frame->step) frames.push_back(frame);
        }
        return frames;
    }

    // Whole turns end one picture before they began, so that a film goes round without a stop.
    double turned(std::size_t i) const {
        const std::size_t count = pictures();
        if (count < 2) return 0;
        const bool is_whole = std::fmod(std::abs(job_.orbit), 360.0) == 0;
        return job_.orbit * static_cast<double>(i) / static_cast<double>(is_whole ? count : count - 1);
    }

    /// A frame in several files, as all its pictures need it.
    struct Pieces {
        int step;
        std::vector<RecordedFrame> frames;
        StageSurvey whole;
        std::optional<SkyVisibility> visibility;  ///< none: no shading
    };

    const RenderJob& job_;
    FramePainter painter_;
    CameraPlace place_;
    std::optional<Pieces> pieces_;
    std::optional<MaskScene> mask_scene_;          ///< of what is shown
    std::optional<archive::Unfolding> unfolding_;  ///< while pictures between two frames are drawn
};

void copy_into(vtkImageData& sheet, vtkImageData& cell, int left, int bottom) {
    const int* size = cell.GetDimensions();
    const auto row = static_cast<std::size_t>(size[0] * cell.GetNumberOfScalarComponents());
    for (int y = 0; y < size[1]; ++y) {
        std::copy_n(static_cast<const unsigned char*>(cell.GetScalarPointer(0, y, 0)), row,
                    static_cast<unsigned char*>(sheet.GetScalarPointer(left, bottom + y, 0)));
    }
}

vtkSmartPointer<vtkImageData> paper(int width, int height, const PictureBackground& background) {
    constexpr int largest = 16384;
    if (width > largest || height > largest) {
        throw UserError(
            fmt::format("the sheet would have {}x{} pixels, more than {} along a side; take a smaller --size", width,
                        height, largest));
    }
    auto sheet = vtkSmartPointer<vtkImageData>::New();
    sheet->SetDimensions(width, height, 1);
    sheet->AllocateScalars(VTK_UNSIGNED_CHAR, background.transparent ? 4 : 3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            auto* pixel = static_cast<unsigned char*>(sheet->GetScalarPointer(x, y, 0));
            std::copy(background.rgb.begin(), background.rgb.end(), pixel);
            if (background.transparent) pixel[3] = 0;
        }
    }
    return sheet;
}

fs::path numbered(const fs::path& path, int step) {
    return path.parent_path() / fmt::format("{}-{:04}{}", path.stem().string(), step, path.extension().string());
}

}  // namespace

bool is_film(const fs::path& path) {
    const std::string extension = kind_of_file(path);
    return extension == ".webm" || extension == ".mp4" || extension == ".gif";
}

void require_png(const fs::path& path) {
    if (kind_of_file(path) == ".png") return;
    throw UserError(
        fmt::format("'{}' is no picture that can be written: .png, or a film: .webm, .mp4, .gif", path.string()));
}

std::vector<std::string> colours_of_every_run() {
    return Colouring::names_of_every_run();
}

std::vector<const RecordedFrame*> evenly(const std::vector<const RecordedFrame*>& frames, std::size_t count) {
    std::vector<const RecordedFrame*> chosen;
    for (std::size_t i = 0; i < count && !frames.empty(); ++i) {
        const double share = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 1;
        chosen.push_back(frames[static_cast<std::size_t>(std::lround(share * static_cast<double>(frames.size() - 1)))]);
    }
    return chosen;
}

std::vector<fs::path> render_pictures(const RenderJob& job, const fs::path& path) {
    require_png(path);
    RenderJob stills = job;
    stills.between = 0;
    JobPainter painter(stills);
    std::vector<fs::path> files;
    const std::size_t views = std::max<std::size_t>(1, job.azimuths.size());
    for (std::size_t k = 0; k < views * job.frames.size(); ++k) {
        const std::size_t i = k / views, view = k % views;
        fs::path file = job.frames.size() == 1 ? path : numbered(path, job.frames[i]->step);
        std::optional<double> azimuth;
        if (!job.azimuths.empty()) {
            azimuth = job.azimuths[view];
            file = file.parent_path() / fmt::format("{}-{}{}", file.stem().string(), view, file.extension().string());
        }
        write_png(file, *painter.picture(i, azimuth));
        files.push_back(file);
        if (!job.masks) continue;
        const std::vector<fs::path> masks = painter.write_masks_of(i, azimuth, file);
        files.insert(files.end(), masks.begin(), masks.end());
    }
    return files;
}

void render_film(const RenderJob& job, double pictures_per_second, const fs::path& path) {
    if (!is_film(path)) throw UserError(fmt::format("'{}' is no film: .webm, .mp4 or .gif", path.string()));
    RenderJob opaque = job;
    opaque.style.background.transparent = false;
    JobPainter painter(opaque);
    write_file(path, [&](const fs::path& temporary) {
        const std::unique_ptr<Film> film = film_of(temporary, job.size, pictures_per_second);
        for (std::size_t i = 0; i < painter.pictures(); ++i) film->add(*painter.picture(i));
        film->finish();
        return true;
    });
}

void render_sheet(const RenderJob& job, int columns, const fs::path& path) {
    require_png(path);
    RenderJob cells = job;
    cells.between = 0;
    cells.style.legend = false;
    cells.style.title.clear();
    cells.style.time_label = false;
    cells.style.time_beneath = true;
    JobPainter painter(cells);
    const int count = static_cast<int>(job.frames.size());
    const int rows = (count + columns - 1) / columns;
    const int height = rows * job.size.height;
    const PictureBackground background = painter.stage().style().background;
    vtkSmartPointer<vtkImageData> keys, sheet;
    for (int i = 0; i < count; ++i) {
        const auto cell = painter.picture(static_cast<std::size_t>(i));
        if (!sheet) {
            const int width = columns * job.size.width;
            if (job.style.legend && !painter.stage().legend().keys.empty()) {
                keys = picture_of(painter.stage().legend(), background, height);
            }
            sheet = paper(width + (keys ? keys->GetDimensions()[0] : 0), height, background);
            if (keys) copy_into(*sheet, *keys, width, 0);
        }
        copy_into(*sheet, *cell, i % columns * job.size.width, (rows - 1 - i / columns) * job.size.height);
    }
    write_png(path, *sheet);
}

}  // namespace espalier::picture
