#include "espalier/archive/recorded_run.h"
#include "espalier/base/file.h"
#include "espalier/base/read_log.h"
#include "espalier/studio/studio.h"

#include "app/child.h"
#include "app/command.h"
#include "app/look/studio_documents.h"
#include "app/look/studio_fitting.h"
#include "app/model_library.h"
#include "app/options.h"
#include "app/program_data.h"
#include "app/temporary_folder.h"
#include "base/platform.h"
#include "base/state_folder.h"

#include <fmt/format.h>

#include <atomic>
#include <filesystem>
#include <random>
#include <system_error>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> ended{false};

fs::path state_file(const fs::path& folder) {
    const fs::path states = state_folder();
    return states.empty() ? states : states / fmt::format("studio-{:016x}.json", digest(folder.string()));
}

void open_browser(const std::string& address) {
    try {
        platform::start({.words = {"xdg-open", address}});
    } catch (const std::system_error&) {
        // Whoever has no such program opens the address that is printed.
    }
}

// What a shared link holds; empty if the text is none. Pages show it and ask before anything is written.
std::string link_in(const std::string& text) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    for (const std::string_view mark : {"espalier:model=", "#model=", "&model="}) {
        const std::size_t at = text.find(mark);
        if (at == std::string::npos) continue;
        const std::size_t begin = at + mark.size();
        return text.substr(begin, text.find_first_not_of(letters, begin) - begin);
    }
    return "";
}

class Studio final : public Command {
public:
    explicit Studio(CLI::App& program)
        : Command(program, "studio", "edit, grow, watch and measure plants in the browser") {
        app().add_option("what", what_,
                         "a model, a scene, the folder of an object or of a recorded run, or a shared link; default: a "
                         "random tree");
        app().add_option(
            "--folder", folder_,
            "folder below which files are read and written; default: this one, or that of a file outside it");
        app()
            .add_option("--port", port_, "port of 127.0.0.1 to listen on; default: one that is free")
            ->check(CLI::Range(0, 65535));
        app().add_flag("--programs", programs_,
                       "start the environment programs that documents name, but never those of a shared link");
        app().add_option("--memory", memory_,
                         "memory that a growth may use, such as 4G; default: half of the machine, and 1G for what "
                         "came by a link");
        app().add_flag("--no-browser", no_browser_, "print the address instead of opening it");
        app().footer(
            R"(The page runs in the browser; this program serves it, to this machine alone, until Ctrl-C ends it. The address
holds a key: whoever has it can edit and grow, below the folder only. Unsaved work is there again next time.
Examples:
  espalier studio                                    a random tree, and the library in the page's gallery
  espalier studio models/trees/honda.l
  espalier studio environments/two-trees.toml
  espalier studio output/two-trees                   a recorded run
  espalier studio --no-browser --port 8700           for a tunnel: ssh -L 8700:127.0.0.1:8700 HOST)");
    }

    int run() override {
        const platform::EndSignals signals([](int) { ended = true; }, /*only_once=*/true);
        const TemporaryFolder scratch("studio");
        studio::StudioOptions options;
        const std::string link = link_in(what_.string());
        if (!link.empty()) what_.clear();
        options.opened = opened();
        options.is_named = !what_.empty();
        if (!what_.empty() && !fs::exists(options.opened.path)) {
            throw UserError(
                fmt::format("{} does not exist; the gallery in the page of `espalier studio` lists models and scenes",
                            what_.string()));
        }
        options.folder = folder();
        options.library_folder = fs::absolute(model_library({})).lexically_normal().parent_path();
        options.scratch = scratch.path();
        options.state = state_file(options.folder);
        options.port = port_;
        if (!memory_.empty()) options.memory = size_in_bytes(memory_, "--memory");
        options.read = [programs = programs_](const Opened& opened) {
            Scene scene = read_opened(opened);
            if (!programs) require_no_programs(scene);
            return scene;
        };
        options.library = [library = StudioLibrary(options.folder)] { return library.entries(); };
        options.fitting = studio_fitting();
        options.interrupt = &ended;
        options.ready = [this, &link](const std::string& own) {
            const std::string address = link.empty() ? own : own + "&model=" + link;
            fmt::print("{}\n", address);
            std::fflush(stdout);
            if (!no_browser_) open_browser(address);
        };
        studio::serve(options);
        return exit_code::done;
    }

private:
    fs::path folder() const {
        fs::path folder = fs::absolute(folder_.empty() ? default_folder() : folder_).lexically_normal();
        if (!fs::is_directory(folder)) throw UserError(fmt::format("the folder {} does not exist", folder.string()));
        return folder.has_filename() ? folder : folder.parent_path();
    }

    // A file of a run stands for the run.
    fs::path opened_path() const {
        const fs::path path = fs::absolute(here_or_with_program(what_)).lexically_normal();
        const fs::path run = folder_of_run(path);
        const fs::path opened = fs::is_regular_file(run / "run.json") ? run : path;
        return opened.has_filename() ? opened : opened.parent_path();
    }

    // Users do not begin with an empty page: a random tree grows if nothing is named.
    Opened opened() const {
        if (!what_.empty()) return {opened_path(), {}, {}};
        const fs::path tree = model_library({}).parent_path() / "environments/tree.toml";
        if (!fs::exists(tree)) return {};
        return {fs::absolute(tree).lexically_normal(), {}, std::random_device{}() % 1000};
    }

    // A file that lies elsewhere is edited where it lies, unless it came with the program.
    fs::path default_folder() const {
        const fs::path here = fs::current_path();
        if (what_.empty() || !fs::exists(what_)) return here;
        const fs::path file = fs::absolute(what_).lexically_normal();
        const fs::path below = file.lexically_relative(here);
        return !below.empty() && *below.begin() != ".." ? here : file.parent_path();
    }

    fs::path what_, folder_;
    std::string memory_;
    int port_ = 0;
    bool no_browser_ = false, programs_ = false;
};

const RegisteredCommand<Studio> studio_entry{46};

}  // namespace
}  // namespace espalier::app
