#include "environment/exchange/communication.h"

#include "base/decimal.h"
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace espalier::environment {
namespace {

constexpr int widest = 99;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

void round(std::optional<TurtleFormat> const& format, glm::dvec3& vector) {
    if (format) format->round({&vector.x, 3});
}

std::optional<TurtleFormat> read_format(const Settings& table, const char* key) {
    const std::string text = table.text_or(key, "");
    if (text.empty()) return std::nullopt;
    return TurtleFormat::read(text, table.place(key));
}

}  // namespace

// `at` is left behind it. Only what prints a double, and no wider than a buffer.
TurtleFormat::Field TurtleFormat::read_field(const std::string& text, std::size_t& at, const Place& place) {
    Field field{"%"};
    const auto take_number = [&] {
        std::string digits;
        while (at < text.size() && is_digit(text[at])) digits += text[at++];
        if (digits.size() > 2) {
            throw UserError(place, fmt::format("a number in this format may be at most {} wide: {}", widest, text));
        }
        field.text += digits;
        return digits.empty() ? 0 : std::stoi(digits);
    };
    while (at < text.size() && std::string("-+ 0#").find(text[at]) != std::string::npos) field.text += text[at++];
    take_number();
    if (at < text.size() && text[at] == '.') {
        field.text += text[at++];
        field.precision = take_number();
    }
    while (at < text.size() && (text[at] == 'l' || text[at] == 'L')) ++at;
    if (at == text.size() || std::string("feEgG").find(text[at]) == std::string::npos) {
        throw UserError(place, fmt::format("only %f, %e and %g print a coordinate, as in '%.4f %.4f %.4f': {}", text));
    }
    field.is_fixed = text[at] == 'f';
    // %e has one digit more, and %g at least one.
    if (!field.is_fixed)
        field.precision = text[at] == 'e' || text[at] == 'E' ? field.precision + 1 : std::max(field.precision, 1);
    field.text += text[at++];
    return field;
}

std::string TurtleFormat::Field::print(double number) const {
    char printed[512];  // the largest double has 309 digits, before at most 99 decimals
    std::snprintf(printed, sizeof printed, text.c_str(), number);
    return printed;
}

double TurtleFormat::Field::round(double number) const {
    const double rounded = is_fixed ? rounded_to_decimals(number, precision) : rounded_to_digits(number, precision);
    return (std::isnan(rounded) ? std::strtod(print(number).c_str(), nullptr) : rounded) + 0.0;  // no negative zero
}

TurtleFormat TurtleFormat::read(const std::string& text, const Place& place) {
    TurtleFormat format;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at++];
        const bool is_doubled = c == '%' && at < text.size() && text[at] == '%';
        if (c != '%' || is_doubled) {
            format.between_.back() += c;
            at += is_doubled;
            continue;
        }
        if (format.fields_.size() == 3) throw UserError(place, fmt::format("more than three numbers: {}", text));
        format.fields_.push_back(read_field(text, at, place));
        format.between_.emplace_back();
    }
    return format;
}

void TurtleFormat::round(std::span<double> numbers) const {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        numbers[i] = i < fields_.size() ? fields_[i].round(numbers[i]) : 0;
    }
}

std::string TurtleFormat::print(std::span<const double> numbers) const {
    std::string text = between_[0];
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        text += fields_[i].print(i < numbers.size() ? numbers[i] : 0) + between_[i + 1];
    }
    return text;
}

Communication::Communication(const Settings& table)
    : digits_(static_cast<int>(table.integer_or("digits", 0, Range::between(0, 17)))),
      following_module_(table.flag_or("following_module", true)) {
    const Settings turtle = table.table("turtle");
    position_ = read_format(turtle, "position");
    heading_ = read_format(turtle, "heading");
    left_ = read_format(turtle, "left");
    up_ = read_format(turtle, "up");
    line_width_ = read_format(turtle, "line_width");
    scale_factor_ = read_format(turtle, "scale_factor");
}

double Communication::rounded(double parameter) const {
    if (digits_ == 0) return parameter;
    const double rounded = rounded_to_digits(parameter, digits_);
    return std::isnan(rounded) ? std::strtod(text_of(parameter).c_str(), nullptr) : rounded;
}

std::string Communication::text_of(double parameter) const {
    if (digits_ == 0) return format_exact(parameter);
    char text[64];
    std::snprintf(text, sizeof text, "%.*g", digits_, parameter);
    return text;
}

std::string Communication::turtle_text(const Query& query) const {
    std::string text;
    const auto add = [&](const std::optional<TurtleFormat>& format, std::span<const double> numbers) {
        if (format) text += format->print(numbers) + "\n";
    };
    add(position_, {&query.pose.position.x, 3});
    add(heading_, {&query.pose.heading.x, 3});
    add(left_, {&query.pose.left.x, 3});
    add(up_, {&query.pose.up.x, 3});
    add(line_width_, {&query.width, 1});
    add(scale_factor_, {&query.scale, 1});
    return text;
}

bool Communication::changes_queries() const {
    return !following_module_ || position_ || heading_ || left_ || up_ || line_width_ || scale_factor_;
}

void Communication::send(Query& query) const {
    environment::round(position_, query.pose.position);
    environment::round(heading_, query.pose.heading);
    environment::round(left_, query.pose.left);
    environment::round(up_, query.pose.up);
    if (line_width_) line_width_->round({&query.width, 1});
    if (scale_factor_) scale_factor_->round({&query.scale, 1});
    if (following_module_) return;
    query.following = no_letter;
    query.following_parameters = {};
    query.following_identity = 0;
}

}  // namespace espalier::environment
