// Whether what a lesson asks for can be reached: it is grown as it begins, and with its answer.
#pragma once

#include "espalier/base/read_log.h"
#include "espalier/studio/studio.h"

#include "studio/lesson/lesson.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace espalier::studio {

/// Values of the goals, in their order.
struct LessonOutcome {
    std::vector<double> at_first, with_answer;             ///< the latter empty if the lesson has no answer
    std::map<std::filesystem::path, ReadLog::File> files;  ///< what its growth has read
};

/// `library`: the folder of the models that come with the program. Throws UserError at the place of a slider, a column
/// or a plant that there is none of, for a growth of more than a million modules, and where the answer does not reach
/// the goals, or they are all reached before it.
LessonOutcome try_lesson(const Lesson& lesson, const std::filesystem::path& library,
                         const std::function<Scene(const Opened&)>& read);

}  // namespace espalier::studio
