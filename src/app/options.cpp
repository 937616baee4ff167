#include "options.h"

#include "espalier/base/error.h"

#include "program_data.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace espalier::app {
namespace {

// "512M", "4G", "1.5GiB", "1000000": bytes; K, M, G, T are powers of 1024.
std::size_t memory_size(const std::string& text) {
    std::size_t used = 0;
    double number = 0;
    try {
        number = std::stod(text, &used);
    } catch (const std::exception&) {
    }
    const std::string unit = text.substr(used);
    const std::size_t power = unit.empty() || unit == "B" ? 0 : std::string("KMGT").find(unit[0]) + 1;
    const std::string rest = power == 0 ? "" : unit.substr(1);
    const bool known = power <= 4 && (rest.empty() || rest == "B" || rest == "iB");
    const double bytes = number * std::pow(1024.0, static_cast<double>(known ? power : 0));
    if (!known || used == 0 || !(bytes >= 1) || bytes > 1e18) {
        throw UserError(fmt::format("--memory {}: expected a size such as 512M or 4G", text));
    }
    return static_cast<std::size_t>(bytes);
}

KeyValues split(const std::vector<std::string>& texts, const std::string& option) {
    KeyValues result;
    for (const std::string& text : texts) result.push_back(key_and_value(text, option));
    return result;
}

}  // namespace

std::pair<std::string, std::string> key_and_value(const std::string& text, const std::string& option) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
        throw UserError(fmt::format("{} {}: expected KEY=VALUE", option, text));
    }
    return {text.substr(0, equals), text.substr(equals + 1)};
}

CLI::Validator above_zero() {
    const auto check = [](const std::string& text) {
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool is_number = error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
        return is_number && value > 0 ? std::string() : fmt::format("expected a number above 0, found {}", text);
    };
    return {check, "ABOVE 0"};
}

ModelOptions::ModelOptions(CLI::App& command, const std::string& name, const std::string& help, Files files) {
    command.add_option(name, model_.file, help)->required();
    command.add_option("--view", model_.view, "view file (.v): settings of the turtle, surfaces, contours, functions");
    command.add_option("--environment", model_.environment, "environment file (.e): the process that answers ?E");
    command.add_flag("--without-environment", model_.without_environment,
                     "do not answer queries; they keep their parameters");
    command.add_option("--define", defines_, "NAME=VALUE replaces a #define of the model; may be repeated")
        ->allow_extra_args(false);
    command.add_flag("--cpfg-quirks", model_.quirks,
                     "compute like cpfg: trunc rounds, x/0 = x, subscripts are clamped");
    if (files == Files::reading) return;
    command.add_option("--animate", model_.animation, "animation file (.a): the steps that become frames");
    command.add_option("--colour-map", model_.colour_maps, "colour map (.map), or N=FILE for set N; may be repeated")
        ->allow_extra_args(false);
    command.add_option("--materials", model_.materials, "materials (.mat), or N=FILE for set N; may be repeated")
        ->allow_extra_args(false);
}

ModelArguments ModelOptions::arguments() const {
    ModelArguments arguments = model_;
    arguments.file = here_or_with_program(model_.file);
    arguments.defines = split(defines_, "--define");
    return arguments;
}

SetOptions::SetOptions(CLI::App& command) {
    command.add_option("--set", sets_, "KEY=VALUE replaces one value of the scene; may be repeated")
        ->allow_extra_args(false);
}

KeyValues SetOptions::overrides() const {
    return split(sets_, "--set");
}

GrowthOptions::GrowthOptions(CLI::App& command) {
    command.add_option("--steps", steps_, "number of derivation steps; default: that of the scene or the model")
        ->check(CLI::Range(0, 1000000000));
    command.add_option("--seed", seed_, "of all random numbers; the same seed gives the same result")
        ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()));
    command.add_option("--memory", memory_, "memory that the run may use, such as 4G; default: half of the machine");
}

std::size_t GrowthOptions::memory() const {
    return memory_.empty() ? 0 : memory_size(memory_);
}

}  // namespace espalier::app
