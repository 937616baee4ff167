// profile: numbers by height and time from a table, as thermometers and penetrometers give them.
#include "espalier/environment/environment_process.h"

#include "base/csv_rows.h"
#include "base/text.h"
#include "environment/exchange/answer_statistics.h"
#include "environment/exchange/rising.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

namespace espalier::environment {
namespace {

double mixed(double a, double b, double share) {
    return share > 0 ? a + share * (b - a) : a;
}

/// Rows of times and columns of heights, both rising.
class ProfileTable {
public:
    explicit ProfileTable(const std::filesystem::path& path) : path_(path.string()), table_(path) {
        if (table_.rows().size() < 2) {
            throw UserError({path_, 1, 0}, "a profile has a line of heights and at least one line of values");
        }
        read_heights(table_.rows().front());
        for (auto row = table_.rows().begin() + 1; row != table_.rows().end(); ++row) read_line(*row);
    }

    /// The values at all heights at a time; a table of one line holds for ever.
    std::vector<double> at(double time) const {
        require_covered(times_, time, path_, "lines");
        const Between place = find_between(times_, time);
        std::vector<double> line = lines_[place.index];
        if (place.share > 0) {
            const std::vector<double>& next = lines_[place.index + 1];
            for (std::size_t k = 0; k < line.size(); ++k) line[k] = mixed(line[k], next[k], place.share);
        }
        return line;
    }

    const std::vector<double>& heights() const { return heights_; }

private:
    // Tables run downwards as a rule; the heights are kept rising.
    void read_heights(const CsvRow& row) {
        for (std::size_t column = 1; column < row.cells.size(); ++column)
            heights_.push_back(table_.number(row, column));
        falling_ = heights_.size() > 1 && heights_[1] < heights_[0];
        if (falling_) std::reverse(heights_.begin(), heights_.end());
        const bool is_rising =
            std::adjacent_find(heights_.begin(), heights_.end(), std::greater_equal<>()) == heights_.end();
        if (heights_.empty() || !is_rising) {
            throw UserError(table_.place(row),
                            "the first line holds the word 'time' and then heights in metres that rise or fall");
        }
    }

    void read_line(const CsvRow& row) {
        if (row.cells.size() != heights_.size() + 1) {
            throw UserError(table_.place(row), fmt::format("this line has {} cells, and the first {}", row.cells.size(),
                                                           heights_.size() + 1));
        }
        const double time = table_.number(row, 0);
        if (!times_.empty() && time <= times_.back()) {
            throw UserError(table_.place(row, 0), fmt::format("time {} is not behind time {} of the line before",
                                                              format_general(time), format_general(times_.back())));
        }
        times_.push_back(time);
        std::vector<double>& line = lines_.emplace_back();
        for (std::size_t column = 1; column < row.cells.size(); ++column)
            line.push_back(table_.measured(row, column, "a profile"));
        if (falling_) std::reverse(line.begin(), line.end());
    }

    std::string path_;
    CsvRows table_;
    bool falling_ = false;  ///< the file's heights
    std::vector<double> heights_, times_;
    std::vector<std::vector<double>> lines_;
};

class Profile final : public EnvironmentProcess {
public:
    Profile(Settings& settings, const EnvironmentContext& context, Fields&)
        : table_(settings.path("file")), statistics_(context.plants) {}

    void advance(const WorldView& world, Queries, Fields&) override { line_ = table_.at(world.time); }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        const std::vector<double>& heights = table_.heights();
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const Between place = find_between(heights, queries[i].pose.position.y);
            const std::size_t next = std::min(place.index + 1, heights.size() - 1);
            const bool has_slope = !place.is_outside && next > place.index;
            answers[i][0] = mixed(line_[place.index], line_[next], place.share);
            if (answers[i].size() < 2) continue;
            answers[i][1] = has_slope ? (line_[next] - line_[place.index]) / (heights[next] - heights[place.index]) : 0;
        }
        statistics_.sum_up(queries, answers);
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override { return statistics_.quantities(plant); }
    std::pair<int, int> query_arity() const override { return {1, 2}; }
    Spreading spreading() const override { return Spreading::reach; }

private:
    ProfileTable table_;
    std::vector<double> line_;  ///< values at this step's time
    AnswerStatistics statistics_;
};

const Registered<ProcessType> entry{
    {"profile", "numbers by height and time, from a table: temperature, penetration resistance",
     R"(?name(v)    -> the value at the height of the position and the time of the step, interpolated linearly
?name(v, s) -> and its slope upwards, per metre

Above the highest and below the lowest height of the table, their values hold.

file   required; a table, relative to the scene, whose cells commas, semicolons or tabs separate

The first line of the table has heights in metres, the others a time in the scene's unit and a value for each height:
"time, 0, -0.2, -0.6", then "0, 8, 10, 11", then "30, 16, 14, 12". A table of one line of values holds for ever; others
must cover the run. Lines that begin with # are comments.

Statistics of a plant: mean, min, max of the values; queries.)",
     construct<Profile>}};

}  // namespace
}  // namespace espalier::environment
