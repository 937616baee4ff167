// Months of the Baseline Surface Radiation Network in its station-to-archive form (Hegner et al. 1998, "Technical plan
// for BSRN data management", WMO TD 882): logical records that begin with a star and their number.
#include "base/text.h"
#include "environment/given/weather/weather_text.h"

#include <fmt/format.h>

namespace espalier::environment {
namespace {

using Words = std::vector<std::string>;

// Of both lines of a minute, one after the other.
constexpr std::size_t day_word = 0, minute_word = 1, words_of_first = 10, words_of_minute = 21;
constexpr std::array<FormColumn, 5> columns{{{Measure::global, 2, 1, -99},
                                             {Measure::diffuse, 10, 1, -99},
                                             {Measure::temperature, 18, 1, -99},
                                             {Measure::humidity, 19, 0.01, -99},
                                             {Measure::pressure, 20, 0.1, -99}}};

constexpr const char* blanks = " \t";

class Month {
public:
    Month(const std::filesystem::path& path, TextLines lines, const WeatherReading& reading)
        : reading_(reading), rows_(path.string(), reading) {
        rows_.set_time(RowTime::span_begins);
        for (const TextLine& line : lines) read(line);
    }

    WeatherTable table() {
        if (rows_.is_empty()) rows_.refuse(0, 0, "this BSRN file has no minutes: its logical record 0100 is missing");
        WeatherTable table = rows_.table();
        table.year = year_;
        table.day = calendar_.day();
        table.place = place_;
        table.height = height_;
        return table;
    }

private:
    void read(const TextLine& line) {
        if (line.text.starts_with('*')) {
            record_ = line.text.size() >= 6 ? line.text.substr(2, 4) : "";
            line_of_record_ = 0;
            begun_.clear();
            return;
        }
        ++line_of_record_;
        if (record_ == "0001" && line_of_record_ == 1) read_month(line);
        if (record_ == "0004" && line_of_record_ == 6) read_place(line);
        if (record_ == "0100") read_minute(line);
    }

    void read_month(const TextLine& line) {
        const Words words = words_of(line.text, blanks);
        month_ = static_cast<int>(number(words, 1, line, "the month"));
        year_ = static_cast<int>(number(words, 2, line, "the year"));
    }

    /// Latitudes count from the south pole, longitudes from 180 degrees west.
    void read_place(const TextLine& line) {
        const Words words = words_of(line.text, blanks);
        place_ =
            GroundPlace{number(words, 0, line, "the latitude") - 90, number(words, 1, line, "the longitude") - 180, 0};
        height_ = number(words, 2, line, "the height");
    }

    void read_minute(const TextLine& line) {
        Words words = words_of(line.text, blanks);
        if (begun_.empty() && words.size() == words_of_first) {
            begun_ = std::move(words);
            return;
        }
        begun_.insert(begun_.end(), words.begin(), words.end());
        if (begun_.size() != words_of_minute) {
            rows_.refuse(line.number, 0,
                         fmt::format("a minute of record 0100 has two lines of 10 and 11 numbers, not {} "
                                     "together",
                                     begun_.size()));
        }
        const double day = number(begun_, day_word, line, "the day"),
                     minute = number(begun_, minute_word, line, "the minute");
        rows_.begin(calendar_.hours(rows_, line.number, year_, month_, static_cast<int>(day), minute / 60),
                    line.number);
        set_cells(rows_, columns, begun_, line.number, reading_);
        begun_.clear();
    }

    double number(const Words& words, std::size_t i, const TextLine& line, const char* what) const {
        const std::optional<double> number = i < words.size() ? weather_number(words[i]) : std::nullopt;
        if (!number) rows_.refuse(line.number, static_cast<int>(i + 1), fmt::format("{} must stand here", what));
        return *number;
    }

    const WeatherReading& reading_;
    WeatherRows rows_;
    CalendarOfMonths calendar_;
    std::optional<GroundPlace> place_;  ///< none: record 0004 is missing
    std::string record_;
    int line_of_record_ = 0, year_ = 0, month_ = 0;
    std::optional<double> height_;
    Words begun_;  ///< the minute whose second line is to come
};

}  // namespace

WeatherTable read_bsrn(const std::filesystem::path& path, TextLines lines, const WeatherReading& reading) {
    return Month(path, lines, reading).table();
}

}  // namespace espalier::environment
