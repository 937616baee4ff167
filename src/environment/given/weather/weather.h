// The air over a scene by time: what the process weather gives to others.
#pragma once

#include "espalier/base/settings.h"
#include "espalier/environment/environment_process.h"
#include "espalier/geometry/field.h"

#include "environment/given/weather/weather_table.h"

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace espalier::environment {

/// Degrees that count at a temperature: none below the base, rising to optimum - base, then falling to none at the
/// ceiling; without a ceiling they stay (Wang & Engel 1998 name the three cardinal temperatures).
struct ThermalTime {
    double base = 0, optimum = std::numeric_limits<double>::infinity();
    double ceiling = std::numeric_limits<double>::infinity();

    double at(double temperature) const;
    /// The mean while the temperature changes evenly from one to another, exactly.
    double mean_between(double begin, double end) const;

private:
    double integral_to(double temperature) const;
};

/// The air of a step: means, and sums since the step before.
struct AirOfStep {
    double temperature = 25, highest = 25, lowest = 25;
    double humidity = 0.6;
    double wind = 1;  ///< 2 m above the ground
    double pressure = 101.325;
    double carbon_dioxide = 400;
    double daylength = 12;   ///< hours, of the day in whose course the step begins
    double rain = 0;         ///< mm
    double radiation = 0;    ///< MJ m-2
    double thermal = 0;      ///< degree-days
    double evaporation = 0;  ///< of the reference lawn, mm; NaN where no radiation is known
};

class Weather final : public FieldSource {
public:
    /// Reads the keys of `weather_help`. Throws UserError.
    explicit Weather(const Settings& settings, std::vector<Diagnostic>* warnings = nullptr);

    /// The weather that a process of the scene shares under the name at this key; null without the key. Throws
    /// UserError if no process before this one does.
    static std::shared_ptr<const Weather> named_by(const Settings& settings, const char* key, const Fields& fields);

    /// That a unit of the scene's time stands for.
    double days() const { return days_; }
    /// Of a step that ends at `time`, in the scene's units; the beginning, step 0, has the air of step 1 and no sums.
    /// Throws RunError beyond the file.
    AirOfStep of_step(int step, double time, double dt) const;
    /// What `of_step` gave last to the process.
    const AirOfStep& now() const { return now_; }
    void set_now(const AirOfStep& now) { now_ = now; }

    /// What the scene gives as numbers.
    std::vector<ChangingSetting> changing_settings();

    /// Null: all is constant.
    const std::shared_ptr<const WeatherTable>& table() const { return table_; }
    const GroundPlace& place() const { return place_; }
    double year() const { return year_; }
    double day() const { return day_; }
    bool repeats() const { return repeats_; }
    bool has_radiation() const { return table_ && table_->has(AirQuantity::global); }
    bool has_rain() const { return of(AirQuantity::rain) || (table_ && table_->has(AirQuantity::rain)); }

    // By days since the beginning, as far as the file goes (RunError).
    double rain_rate(double day) const;  ///< mm/d
    /// What the reference lawn of FAO-56 evaporates, mm/d: the day's sum, spread as its radiation is, hour by hour.
    double evaporation_rate(double day) const;
    /// When rain or evaporation changes next.
    double next_change(double day) const;
    /// mm/d, from the midnight `day`.
    double reference_of_day(double day) const;

private:
    using Visit = std::function<void(double begin, double end, double hours)>;
    struct Extremes {
        double highest = -300, lowest = 300;
    };

    std::optional<double>& of(AirQuantity quantity) { return constants_[static_cast<std::size_t>(quantity)]; }
    const std::optional<double>& of(AirQuantity quantity) const {
        return constants_[static_cast<std::size_t>(quantity)];
    }
    void read_numbers(const Settings& settings);
    void read_number(const Settings& settings, const char* key, AirQuantity quantity, Range range);
    void read_file(const Settings& settings, std::vector<Diagnostic>* warnings);
    void read_days(const Settings& settings);
    void read_place(const Settings& settings);
    void read_height(const Settings& settings);
    void begin_at_day(WeatherTable& table) const;
    void take_defaults(const Settings& settings, std::vector<Diagnostic>* warnings);

    void require_covered(double from, double to) const;
    double period() const;
    /// Calls visit(value at the begin, at the end, hours) for each piece of a column between two times.
    void for_pieces(AirQuantity quantity, double from, double to, const Visit& visit) const;
    void for_pieces_of_file(AirQuantity quantity, double from, double to, const Visit& visit) const;
    double integral(AirQuantity quantity, double from, double to) const;
    double mean(AirQuantity quantity, double from, double to) const;
    double wind_at_2_m(double from, double to) const;
    Extremes extremes(double from, double to) const;
    double evaporation_between(double from, double to) const;

    std::array<std::optional<double>, air_quantities> constants_;
    std::shared_ptr<const WeatherTable> table_;
    GroundPlace place_;
    double year_ = 2025, day_ = 172, days_ = 1, height_ = 0, wind_factor_ = 1, below_ = 0.833;
    bool repeats_ = false;
    ThermalTime thermal_;
    AirOfStep now_;
};

/// Reads `fill`, `fill_hours` of a table.
std::optional<double> read_fill_hours(const Settings& settings);

/// The key `days` of a process: days that a unit of time stands for, which are the weather's, if it has one. Throws
/// UserError where it says others.
double read_days(const Settings& settings, const Weather* weather);

/// What users read of its keys.
const std::string& weather_help();

}  // namespace espalier::environment
