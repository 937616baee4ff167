#include "espalier/archive/recorded_run.h"
#include "espalier/base/error.h"
#include "espalier/base/read_log.h"
#include "espalier/picture/render.h"
#include "espalier/simulation/world.h"

#include "app/command.h"
#include "app/options.h"
#include "archive/chosen_frames.h"
#include "base/number.h"
#include "html_file.h"
#include "living_line.h"
#include "simulation/run/recorded_command.h"
#include "studio/server/live_page.h"
#include "studio/server/shared_page.h"
#include "studio_documents.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

/// What a model or a scene reads until its first step.
studio::LiveGrowth growth_of(const fs::path& opened) {
    studio::LiveGrowth growth;
    growth.opened = fs::absolute(opened).lexically_normal();
    const ReadLog log;
    const Scene scene = read_opened({growth.opened, {}, {}});
    for (const auto& [name, type] : processes_without_a_page(scene)) {
        fmt::print(stderr, "warning: '{}' is {}, which needs the program: the page will say so instead of growing\n",
                   name, type);
    }
    World(scene).start();
    growth.files = studio::kept_bytes(log.files());
    return growth;
}

/// What a run read, as its run.json has it.
studio::LiveGrowth growth_of_run(const fs::path& run) {
    const RecordedCommand command = read_command(run);
    studio::LiveGrowth growth;
    growth.opened = (command.folder / command.arguments.front()).lexically_normal();
    for (const auto& [path, file] : command.inputs) {
        if (!file.kept) throw UserError(fmt::format("{} was too large for run.json to keep it", path.string()));
        growth.files[path] = file.bytes;
    }
    std::string others;
    for (std::size_t i = 1; i < command.arguments.size(); ++i) {
        if (command.arguments[i] == "--seed" && i + 1 < command.arguments.size()) {
            growth.seed = whole_text_as<std::uint64_t>(command.arguments[++i]);
        } else {
            others += " " + command.arguments[i];
        }
    }
    if (!others.empty()) fmt::print(stderr, "warning: the page grows the files of the run without{}\n", others);
    if (!growth.files.contains(growth.opened)) {
        throw UserError(fmt::format("{} does not hold {}, which it grew", run.string(), growth.opened.string()));
    }
    return growth;
}

class Share final : public Command {
public:
    explicit Share(CLI::App& program)
        : Command(program, "share",
                  "write a run as one HTML page that can be turned and played in every browser, or that grows") {
        app().add_option("run", run_, "the folder of a run; with --live also a scene or a model")->required();
        app().add_option("--output", output_,
                         "the page, a .html file; default: share.html in the folder of the run; of a scene or a model "
                         "its name, here");
        CLI::Option* const live = app().add_flag(
            "--live", is_live_, "a page that grows the plants itself: the studio with the texts of the growth, 2.2 MB");
        app().add_option("--step", steps_, frame_option_help)->capture_default_str()->excludes(live);
        app()
            .add_option("--frames", most_, "so many frames at most, evenly chosen from those of --step; default: 120")
            ->check(CLI::Range(1, 100000))
            ->excludes(live);
        app()
            .add_option("--size", size_, "so many bytes at most, by fewer frames; default: 10 MB, or as --frames asks")
            ->excludes(live);
        app().add_option("--title", page_.title, "what stands below the plant; default: the name of the scene");
        app().add_flag("--dark", page_.is_dark, "use a dark background")->excludes(live);
        add_json_flag("print what was written as JSON");
        app().footer(
            R"(The page needs neither Espalier nor a network. It shows axes, leaves and organs in their colours, and the fields
that the run has recorded as grids. A click on an organ shows its symbol, identity and recorded parameters; without textures and bark, which `share` in the studio takes along.
With --live it is the studio: texts, sliders, charts, fields, and whoever opens it can change the plant. It keeps changes in the
browser and hands them over as files. docs/web.md says what such a page cannot do.
Examples:
  espalier share output/two-trees
  espalier share output/two-trees --frames 20 --output trees.html
  espalier share output/two-trees --size 40M                         more frames than fit into the usual 10 MB
  espalier share --live environments/two-trees.toml
  espalier share --live models/course/honda.l --output honda.html --title "Honda's tree")");
    }

    int run() override {
        if (is_live_) {
            write_live();
        } else {
            write_recording();
        }
        return exit_code::done;
    }

private:
    void write_recording() {
        const RecordedRun run(folder_of_run(run_));
        const std::vector<const RecordedFrame*> all = chosen_frames(run, steps_);
        if (page_.title.empty()) page_.title = run.scene();
        std::size_t count = std::min(all.size(), most_.value_or(usual_frames));
        LivingLine line(wants_json());
        studio::SharedPage shared = page_;
        shared.progress = [&](std::size_t done, std::size_t packed) {
            line.show(false, [&] { return fmt::format("packing {} frames: {}", packed, done); });
        };
        const auto page_of = [&](std::size_t frames) { return studio::shared_page(run, evenly(all, frames), shared); };
        std::string page;
        if (most_ && size_.empty()) {
            page = page_of(count);
        } else {
            const std::size_t most = size_.empty() ? usual_size : size_in_bytes(size_, "--size");
            page = within(most, count, page_of);
            if (page.size() > most) {
                throw UserError(fmt::format("one frame alone takes {:.1f} MB: say --size {}M", page.size() / 1e6,
                                            page.size() / 1'000'000 + 1));
            }
        }
        line.end();
        const std::string what = count < all.size() ? fmt::format("of {} frames", all.size()) : "frames";
        write(page, run.folder() / "share.html", what, count);
    }

    /// The page of so many frames at most as `bytes` allow; `count` becomes their number.
    template <class PageOf>
    static std::string within(std::size_t bytes, std::size_t& count, const PageOf& page_of) {
        constexpr std::size_t few = 8;  // of what they take, more follow
        if (count > 2 * few) {
            const double size = static_cast<double>(page_of(few).size());
            const double each = (static_cast<double>(page_of(2 * few).size()) - size) / few;
            constexpr double closer = 1.15;  // frames that lie closer to each other take less
            const double fit = closer * ((static_cast<double>(bytes) - size) / std::max(each, 1.0) + few);
            count = std::min(count, static_cast<std::size_t>(std::max(fit, 1.0)));
        }
        for (;;) {
            std::string page = page_of(count);
            if (page.size() <= bytes || count == 1) return page;
            count = std::max<std::size_t>(1, std::min(count - 1, count * bytes / page.size()));
        }
    }

    void write_live() {
        const bool is_run = fs::is_directory(run_);
        const fs::path run = is_run ? folder_of_run(run_) : fs::path();
        studio::LiveGrowth growth = is_run ? growth_of_run(run) : growth_of(run_);
        growth.title = page_.title.empty() ? growth.opened.stem().string() : page_.title;
        const fs::path file = is_run ? run / "share.html" : growth.opened.stem().concat(".html");
        write(studio::live_page(growth), file, "files", growth.files.size());
    }

    void write(const std::string& page, const fs::path& by_default, const std::string& what, std::size_t count) const {
        const fs::path output = output_.empty() ? by_default : output_;
        write_html(output, page);
        if (wants_json()) {
            const nlohmann::ordered_json json{
                {"path", output.string()}, {is_live_ ? "files" : "frames", count}, {"bytes", page.size()}};
            fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
        } else {
            const double megabytes = static_cast<double>(page.size()) / 1e6;
            fmt::print("{}: {} {}, {:.1f} MB\n", output.string(), count, what, megabytes);
        }
    }

    fs::path run_, output_;
    static constexpr std::size_t usual_frames = 120, usual_size = 10'000'000;
    std::string steps_ = "all", size_;
    std::optional<std::size_t> most_;
    bool is_live_ = false;
    studio::SharedPage page_;
};

const RegisteredCommand<Share> share_entry{42};

}  // namespace
}  // namespace espalier::app
