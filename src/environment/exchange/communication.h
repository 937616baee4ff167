// How a question reaches a process: numbers as text would carry them, because a model may count on their rounding.
#pragma once

#include "espalier/base/settings.h"
#include "espalier/turtle/query.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::environment {

/// A printf format of up to three numbers. "%.4f %.0f %.4f" rounds the first and third coordinate to four decimals and
/// the second to whole numbers.
class TurtleFormat {
public:
    /// Throws UserError for anything that does not print numbers.
    static TurtleFormat read(const std::string& text, const Place& place);

    /// Prints and reads back; a number without a field in the format is not sent, which makes it 0.
    void round(std::span<double> numbers) const;
    /// With the text around them.
    std::string print(std::span<const double> numbers) const;

private:
    /// One conversion.
    struct Field {
        std::string text;       ///< from its % on
        bool is_fixed = false;  ///< %f: so many decimals; else significant digits
        int precision = 6;

        std::string print(double number) const;
        double round(double number) const;
    };
    static Field read_field(const std::string& text, std::size_t& at, const Place& place);

    std::vector<Field> fields_;
    std::vector<std::string> between_{""};  ///< the text before each field, and after the last
};

/// What a process of the scene receives of a query, and with what precision.
class Communication {
public:
    /// The keys `turtle`, `digits` and `following_module` of an [environment.<name>] table.
    explicit Communication(const Settings& table);

    bool rounds_parameters() const { return digits_ > 0; }
    double rounded(double parameter) const;
    bool changes_queries() const;
    /// Everything but the parameters of the query.
    void send(Query& query) const;
    bool sends_following_module() const { return following_module_; }

    // As another program reads them.
    std::string text_of(double parameter) const;
    /// Each vector and number of the turtle that has a format, on a line of its own.
    std::string turtle_text(const Query& query) const;

private:
    int digits_ = 0;
    bool following_module_ = true;
    std::optional<TurtleFormat> position_, heading_, left_, up_, line_width_, scale_factor_;
};

}  // namespace espalier::environment
