#include "studio/lesson/lesson.h"

#include "espalier/base/file.h"
#include "espalier/base/settings.h"

#include "base/number.h"
#include "studio/lesson/marked_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view fence = "+++\n";

struct Parts {
    std::string table, text;
    int first_line = 1;  ///< of the text
};

Parts parts_of(const fs::path& file, std::string all) {
    std::erase(all, '\r');
    const std::size_t end = all.starts_with(fence) ? all.find("\n" + std::string(fence), fence.size() - 1) : all.npos;
    if (end == all.npos) {
        throw UserError({file.string(), 1, 0},
                        "a lesson begins with a line '+++', a table in TOML that says what it grows, and another line "
                        "'+++'; `espalier lesson --help` shows one");
    }
    // The line of the fence stays, so that places are those of the file.
    Parts parts{"\n" + all.substr(fence.size(), end - fence.size() + 1), all.substr(end + 1 + fence.size())};
    parts.first_line = 2 + static_cast<int>(std::count(parts.table.begin(), parts.table.end(), '\n'));
    return parts;
}

std::optional<double> bound(const Settings& goal, const char* key) {
    if (!goal.has(key)) return std::nullopt;
    return goal.number(key);
}

Goal goal_of(const Settings& table) {
    Goal goal{table.text("text"),       table.text("column"),    table.text_or("plant", ""),
              bound(table, "at_least"), bound(table, "at_most"), table.place("column")};
    if (goal.least || goal.most) return goal;
    throw UserError(table.place(), "a goal has a bound: at_least, at_most or both");
}

Question question_of(const Settings& table) {
    Question question{table.text("text"), table.text_or("why", ""), table.texts_or("choices", {}), 0};
    if (question.choices.size() < 2) throw UserError(table.place("choices"), "a question has two choices or more");
    const auto count = static_cast<double>(question.choices.size());
    question.right = static_cast<std::size_t>(table.integer("right", Range::between(1, count))) - 1;
    return question;
}

fs::path existing(const Settings& table, const char* key) {
    const fs::path path = fs::absolute(table.path(key)).lexically_normal();
    if (fs::exists(path)) return path;
    throw UserError(table.place(key), fmt::format("there is no file '{}'", path.string()));
}

void read_table(const Settings& table, Lesson& lesson) {
    lesson.title = table.text("title");
    lesson.grows = existing(table, "grow");
    if (table.has("next")) lesson.next = existing(table, "next");
    constexpr auto most = static_cast<double>(std::numeric_limits<std::int32_t>::max());
    if (table.has("seed")) lesson.seed = static_cast<std::uint64_t>(table.integer("seed", Range::between(0, most)));
    if (table.has("steps")) lesson.steps = static_cast<int>(table.integer("steps", Range::between(0, 1e8)));
    lesson.texts = table.choice_or("texts", "locked", {"hidden", "locked", "free"});
    lesson.sliders = table.texts_or("sliders", {});
    for (const std::string& slider : lesson.sliders) lesson.places[slider] = table.place("sliders");
    lesson.charts = table.texts_or("charts", {});
    for (const Settings& goal : table.tables("goal")) lesson.goals.push_back(goal_of(goal));
    for (const Settings& question : table.tables("question")) lesson.questions.push_back(question_of(question));
    const Settings answer = table.table("answer");
    for (const std::string& name : answer.keys()) {
        lesson.answer[name] = answer.value_text(name);
        lesson.places.try_emplace(name, answer.place(name));
    }
    table.reject_unread();
}

Json or_null(const std::optional<double>& value) {
    return value ? Json(*value) : Json();
}

}  // namespace

Lesson read_lesson(const fs::path& file) {
    const Parts parts = parts_of(file, read_text(file));
    Lesson lesson;
    lesson.file = file;
    read_table(Settings::parse_toml(parts.table, file.string(), file.parent_path()), lesson);
    const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
    MarkedText text = html_of_markdown(parts.text, folder, file.string(), parts.first_line);
    lesson.html = std::move(text.html);
    lesson.warnings = std::move(text.warnings);
    return lesson;
}

std::string json_of_lesson(const Lesson& lesson) {
    Json goals = Json::array(), questions = Json::array();
    for (const Goal& goal : lesson.goals) {
        goals.push_back({{"text", goal.text},
                         {"column", goal.column},
                         {"plant", goal.plant},
                         {"least", or_null(goal.least)},
                         {"most", or_null(goal.most)}});
    }
    for (const Question& question : lesson.questions) {
        questions.push_back(
            {{"text", question.text}, {"choices", question.choices}, {"right", question.right}, {"why", question.why}});
    }
    const Json all{{"title", lesson.title},
                   {"html", lesson.html},
                   {"texts", lesson.texts},
                   {"sliders", lesson.sliders},
                   {"charts", lesson.charts},
                   {"goals", std::move(goals)},
                   {"questions", questions},
                   {"answer", lesson.answer},
                   {"next", lesson.next.empty() ? "" : fs::path(lesson.next.stem()).concat(".html").string()}};
    return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace espalier::studio
