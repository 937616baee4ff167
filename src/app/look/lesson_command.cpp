// lesson: a page that teaches, from a text.
#include "espalier/base/error.h"

#include "app/command.h"
#include "app/model_library.h"
#include "app/options.h"
#include "base/text.h"
#include "html_file.h"
#include "studio/lesson/lesson_growth.h"
#include "studio/server/live_page.h"
#include "studio_documents.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Scene read_without_programs(const studio::Opened& opened) {
    Scene scene = read_opened(opened);
    for (const auto& [name, type] : processes_without_a_page(scene)) {
        throw UserError(fmt::format("{}: '{}' is {}, which a page cannot grow", opened.path.string(), name, type));
    }
    return scene;
}

std::string bounds_of(const studio::Goal& goal) {
    if (!goal.most) return "at least " + format_general(*goal.least);
    if (!goal.least) return "at most " + format_general(*goal.most);
    return fmt::format("{} to {}", format_general(*goal.least), format_general(*goal.most));
}

class MakeLesson final : public Command {
public:
    explicit MakeLesson(CLI::App& program)
        : Command(program, "lesson", "make a page from a text that teaches: a plant that grows, sliders, and goals") {
        app().add_option("file", file_, "the lesson, a text in Markdown")->required();
        app().add_option("--output", output_, "the page, a .html file; default: the name of the lesson, here");
        app().add_flag("--data", data_, "print what the page consists of as JSON, and write no page");
        add_json_flag("print what was written as JSON");
        app().footer(
            R"(The page is one file of 2.2 MB that needs neither Espalier nor a network, and works on a phone. Its text begins with a table:

  +++
  title = "A tree that reaches for light"
  grow = "two-trees.toml"              # a model or a scene; paths begin at the lesson
  seed = 3                             # and steps = 60: instead of what the files say
  texts = "locked"                     # "hidden", "locked" (shown, not to be changed) or "free"; default: locked
  sliders = ["tree.l:ANGLE"]           # settings that the page shows, as the studio names them; default: none
  charts = ["height"]                  # columns of statistics.csv
  next = "second.md"                   # the lesson that follows

  [[goal]]                             # the page checks it after every change, at the last step
  text = "The left tree is 8 m tall."
  column = "height"                    # of statistics.csv; the mean over all plants, or of `plant`
  plant = "left"
  at_least = 8                         # and, or instead, at_most

  [[question]]
  text = "Which organs shade the crown?"
  choices = ["its own", "those of the neighbour", "both"]
  right = 3
  why = "Light falls through both."    # said with the answer

  [answer]                             # settings that reach the goals: the page shows them on demand
  "tree.l:ANGLE" = 40
  +++
  # Markdown follows: headings, lists, links, pictures that lie beside the lesson.

The lesson is grown as it begins and with its answer: sliders and columns must exist, the answer must reach every goal, and not
all may be reached before.
Examples:
  espalier lesson lessons/03-parameters.md
  espalier lesson lessons/03-parameters.md --output honda.html)");
    }

    int run() override {
        const studio::Lesson lesson = studio::read_lesson(file_);
        for (const Diagnostic& warning : lesson.warnings) fmt::print(stderr, "{}\n", to_string(warning));
        const fs::path library = fs::absolute(model_library({})).lexically_normal().parent_path();
        const studio::LessonOutcome outcome = studio::try_lesson(lesson, library, read_without_programs);
        if (data_) {
            print_data(lesson);
        } else {
            write_page(lesson, outcome);
        }
        return exit_code::done;
    }

private:
    static void print_data(const studio::Lesson& lesson) {
        Json data{{"open", lesson.grows.string()}};
        if (lesson.seed) data["seed"] = *lesson.seed;
        if (lesson.steps) data["steps"] = *lesson.steps;
        data["title"] = lesson.title;
        data["lesson"] = Json::parse(studio::json_of_lesson(lesson));
        fmt::print("{}\n", data.dump(-1, ' ', false, Json::error_handler_t::replace));
    }

    void write_page(const studio::Lesson& lesson, const studio::LessonOutcome& outcome) const {
        const studio::LiveGrowth growth{
            studio::kept_bytes(outcome.files), lesson.grows, lesson.seed, lesson.steps, lesson.title,
            studio::json_of_lesson(lesson)};
        const std::string page = studio::live_page(growth);
        const fs::path output = output_.empty() ? fs::path(lesson.file.stem()).concat(".html") : output_;
        write_html(output, page);
        if (wants_json()) {
            const Json json{{"path", output.string()},
                            {"bytes", page.size()},
                            {"at_first", outcome.at_first},
                            {"with_answer", outcome.with_answer}};
            fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
            return;
        }
        for (std::size_t i = 0; i < lesson.goals.size(); ++i) {
            const studio::Goal& goal = lesson.goals[i];
            const std::string answer =
                outcome.with_answer.empty() ? "" : ", with the answer " + format_general(outcome.with_answer[i]);
            fmt::print("{}: {} at first{}; {} is asked for\n", goal.text, format_general(outcome.at_first[i]), answer,
                       bounds_of(goal));
        }
        if (!lesson.goals.empty() && lesson.answer.empty()) {
            fmt::print(stderr, "warning: {} has no [answer], so nobody has shown that its goals can be reached\n",
                       lesson.file.string());
        }
        fmt::print("{}: {:.1f} MB\n", output.string(), static_cast<double>(page.size()) / 1e6);
    }

    fs::path file_, output_;
    bool data_ = false;
};

const RegisteredCommand<MakeLesson> lesson_entry{43};

}  // namespace
}  // namespace espalier::app
