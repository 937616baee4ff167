// external: a program of one's own answers.
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/read_log.h"
#include "espalier/environment/environment_process.h"

#include "base/link_mark.h"
#include "base/platform.h"
#include "base/text.h"
#include "environment/given/external/companion.h"
#include "environment/given/external/records.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <utility>

namespace espalier::environment {
namespace {

namespace fs = std::filesystem;

bool is_program(const fs::path& file) {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored) && !platform::denied(file, platform::Access::execute);
}

// Relative to the folder if it has a slash, else in a folder of PATH; empty if there is none.
fs::path find_program(const std::string& word, const fs::path& folder) {
    if (word.find('/') != std::string::npos) return is_program(folder / word) ? folder / word : fs::path();
    const char* const path = std::getenv("PATH");
    for (const std::string& place : words_of(path ? path : "", ":")) {
        if (is_program(fs::path(place) / word)) return fs::path(place) / word;
    }
    return {};
}

// Nothing is started for what came by a link: its author is not to be trusted.
void require_trust(const fs::path& file, const Place& place) {
    std::error_code ignored;
    for (const fs::path& path : {file, fs::weakly_canonical(file, ignored)}) {
        if (!ReadLog::permission() && !folder_of_link(path)) continue;
        throw UserError(place,
                        "this came by a link, and for what came by a link no program is started; if you trust "
                        "its author, remove the file '" +
                            std::string(link_mark) + "' from its folder");
    }
}

// So that a run can say which program answered.
void note_program(const fs::path& program) {
    require_readable(program);
    std::ifstream file(program, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    ReadLog::note(program, bytes, /*kept=*/false);
}

class External final : public EnvironmentProcess {
public:
    External(Settings& settings, const EnvironmentContext& context, Fields&)
        : communication_(settings),
          words_(settings.texts_or("command", {})),
          patience_(settings.number_or("timeout", 60, Range::positive())),
          place_(settings.place("command")),
          warnings_(context.warnings) {
        const fs::path described = fs::current_path() / settings.place().file;
        folder_ = settings.path_if_any("folder").value_or(described.parent_path());
        require_trust(described, place_);
        require_trust(folder_, place_);
        if (words_.empty()) {
            throw UserError(place_, "'command' must be a program and its arguments, as in [\"python3\", \"mine.py\"]");
        }
        const fs::path program = find_program(words_.front(), folder_);
        if (program.empty()) throw_missing();
        require_trust(program, place_);
        note_program(program);
        for (std::size_t i = 1; i < words_.size(); ++i) note_argument(folder_ / words_[i]);
        words_.front() = program.string();
    }

    ~External() override {
        if (companion_) companion_->dismiss(text_of_end(step_));
    }

    void answer(const WorldView& world, Queries queries, std::span<Answer> answers, Fields&) override {
        if (queries.empty()) return;
        // One that has failed, or was left in the midst of an answer, is ended with this.
        const auto companion =
            companion_ ? std::exchange(companion_, nullptr) : std::make_shared<Companion>(words_, folder_);
        AnswerReader reader(world, queries, answers);
        companion->ask(text_of_queries(world, queries, communication_), patience_,
                       [&](std::string_view line) { return reader.take(line); });
        companion_ = companion;
        step_ = world.step;
    }

    std::pair<int, int> query_arity() const override { return {1, 20}; }

    void restore(std::istream&) override {
        if (!warnings_) return;
        warnings_->push_back({Diagnostic::Severity::warning, place_,
                              "the run goes on from a checkpoint, and the program begins anew: it does not know the "
                              "steps before"});
    }

private:
    [[noreturn]] void throw_missing() const {
        const std::string& word = words_.front();
        if (word.find('/') == std::string::npos) {
            throw UserError(place_, fmt::format("there is no program {} in the folders of PATH; a file beside this one "
                                                "is ./{}",
                                                word, word));
        }
        throw UserError(place_, fmt::format("{} is no file that can be executed", (folder_ / word).string()));
    }

    static void note_argument(const fs::path& file) {
        if (is_readable(file)) read_text(file);
    }

    Communication communication_;
    std::vector<std::string> words_;
    std::chrono::duration<double> patience_;
    Place place_;
    std::vector<Diagnostic>* warnings_;
    fs::path folder_;
    int step_ = 0;
    std::shared_ptr<Companion> companion_;  ///< started when it is first asked
};

const Registered<ProcessType> entry{{"external", "a program of your own, asked over its standard input and output",
                                     R"(?name(...)  -> what the program answers; a query has 1 to 20 parameters

command   required; the program and its arguments, as ["python3", "light.py"]. With a slash it is a file beside the
          scene, else it is looked for in PATH. It is started when it is first asked, as you, and may do what you may
folder    the folder of the scene; where the program starts
timeout   60 s, > 0; how long the program may take to answer the queries of a step
turtle    {}; { position = "%g %g %g", heading, left, up, line_width, scale_factor }: printf formats of what it is told
          of the turtle, a line each; without a format it is not told
following_module  true; it is told the module behind the query
digits    0, 0 to 17; significant digits of the numbers it is sent, 0: all

Each step is a text in the protocol of cpfg's environment programs, which docs/environment-processes.md explains. A
program that ends, answers what it was not asked, or does not answer in time ends the run.
You are asked on a terminal whether files of the folder may start programs; elsewhere --trust says so. For what came by a
link no program is started.
)",
                                     construct<External>}};

}  // namespace
}  // namespace espalier::environment
