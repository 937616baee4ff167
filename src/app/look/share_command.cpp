#include "espalier/archive/recorded_run.h"
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/picture/render.h"

#include "app/command.h"
#include "archive/chosen_frames.h"
#include "base/folder.h"
#include "studio/server/shared_page.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

class Share final : public Command {
public:
    explicit Share(CLI::App& program)
        : Command(program, "share", "write a run as one HTML page that can be turned and played in every browser") {
        app().add_option("run", run_, "the folder of a run")->required();
        app().add_option("--output", output_, "the page, a .html file; default: share.html in the folder of the run");
        app().add_option("--step", steps_, frame_option_help)->capture_default_str();
        app()
            .add_option("--frames", most_, "so many frames at most, evenly chosen from those of --step")
            ->check(CLI::Range(1, 100000))
            ->capture_default_str();
        app().add_option("--title", page_.title, "what stands below the plant; default: the name of the scene");
        app().add_flag("--dark", page_.is_dark, "use a dark background");
        add_json_flag("print what was written as JSON");
        app().footer(
            R"(The page needs neither Espalier nor a network. It shows axes, leaves and organs in their colours, and a click on one
shows its symbol, identity and recorded parameters; without textures and bark, which `share` in the studio takes along.
Examples:
  espalier share output/two-trees
  espalier share output/two-trees --frames 20 --output trees.html)");
    }

    int run() override {
        const RecordedRun run(folder_of_run(run_));
        std::vector<const RecordedFrame*> frames = chosen_frames(run, steps_);
        if (frames.size() > most_) frames = evenly(frames, most_);
        const fs::path output = output_.empty() ? run.folder() / "share.html" : output_;
        if (output.extension() != ".html") {
            throw UserError(fmt::format("--output {}: expected the name of a .html file", output.string()));
        }
        if (page_.title.empty()) page_.title = run.scene();
        const std::string page = studio::shared_page(run, frames, page_);
        if (output.has_parent_path()) make_folder(output.parent_path());
        write_text(output, page);
        tell(output, frames.size(), page.size());
        return exit_code::done;
    }

private:
    void tell(const fs::path& output, std::size_t frames, std::size_t bytes) const {
        if (wants_json()) {
            const nlohmann::ordered_json json{{"path", output.string()}, {"frames", frames}, {"bytes", bytes}};
            fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
        } else {
            fmt::print("{}: {} frames, {:.1f} MB\n", output.string(), frames, static_cast<double>(bytes) / 1e6);
        }
    }

    fs::path run_, output_;
    std::string steps_ = "all";
    std::size_t most_ = 120;
    studio::SharedPage page_;
};

const RegisteredCommand<Share> share_entry{42};

}  // namespace
}  // namespace espalier::app
