#include "options.h"

#include "espalier/base/error.h"

#include "base/number.h"
#include "program_data.h"
#include "trust.h"

#include <fmt/format.h>

#include <cmath>
#include <random>

namespace espalier::app {
namespace {

// "", "B", "M", "MB" and "MiB" are units; nothing else is.
std::optional<double> bytes_of_unit(const std::string& unit) {
    if (unit.empty() || unit == "B") return 1;
    const std::size_t power = std::string("KMGT").find(unit[0]);
    const std::string rest = unit.substr(1);
    if (power == std::string::npos || (!rest.empty() && rest != "B" && rest != "iB")) return std::nullopt;
    return std::pow(1024.0, static_cast<double>(power + 1));
}

constexpr const char* above_zero_name = "ABOVE 0";

std::string_view without_plus(std::string_view text) {
    return text.starts_with('+') ? text.substr(1) : text;
}

/// The text becomes the number as CLI11 reads no other; returns what is wrong with it.
std::string to_decimal(std::string& text, std::string_view type) {
    if (type == "FLOAT") {
        if (finite_number(without_plus(text))) return "";
        return fmt::format("a number is expected, not '{}'", text);
    }
    const std::string_view digits = without_plus(text);
    if (type == "UINT") {
        const auto number = whole_text_as<std::uint64_t>(digits);
        if (number) text = std::to_string(*number);
        return number ? "" : fmt::format("a whole number of at least 0 is expected, not '{}'", text);
    }
    const auto number = whole_text_as<std::int64_t>(digits);
    if (number) text = std::to_string(*number);
    return number ? "" : fmt::format("a whole number is expected, not '{}'", text);
}

KeyValues split(const std::vector<std::string>& texts, const std::string& option) {
    KeyValues result;
    for (const std::string& text : texts) result.push_back(key_and_value(text, option));
    return result;
}

}  // namespace

std::size_t size_in_bytes(const std::string& text, const std::string& option) {
    double number = 0;
    const auto [behind, error] = read_number(text.data(), text.data() + text.size(), number);
    const double bytes = number * bytes_of_unit(behind).value_or(0);
    if (error != std::errc() || !(bytes >= 1) || bytes > 1e18) {
        throw UserError(fmt::format("{} {}: expected a size such as 512M or 4G", option, text));
    }
    return static_cast<std::size_t>(bytes);
}

std::pair<std::string, std::string> key_and_value(const std::string& text, const std::string& option) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
        throw UserError(fmt::format("{} {}: expected KEY=VALUE", option, text));
    }
    return {text.substr(0, equals), text.substr(equals + 1)};
}

void read_decimal_numbers(CLI::App& command) {
    for (CLI::Option* option : command.get_options()) {
        const std::string type = option->get_type_name();
        for (const std::string word : {"INT", "UINT", "FLOAT"}) {
            const bool checks_itself = type.ends_with(above_zero_name);
            if (checks_itself || (type != word && !type.starts_with(word + ":"))) continue;
            option->transform(
                CLI::Validator([word](std::string& text) { return to_decimal(text, word); }, "", "decimal"));
        }
    }
}

void refuse_empty_names(CLI::App& command) {
    const auto check = [](const std::string& text) { return text.empty() ? "the name is empty" : std::string(); };
    for (CLI::Option* option : command.get_options([](const CLI::Option* any) { return any->get_positional(); })) {
        option->check(CLI::Validator(check, "", "named"));
    }
}

CLI::Validator above_zero() {
    const auto check = [](const std::string& text) {
        const std::optional<double> value = finite_number(text);
        return value && *value > 0 ? std::string() : fmt::format("expected a number above 0, found {}", text);
    };
    return {check, above_zero_name};
}

ModelOptions::ModelOptions(CLI::App& command, const std::string& name, const std::string& help, Files files) {
    command.add_option(name, model_.file, help)->required();
    command.add_option("--view", model_.view, "view file (.v): settings of the turtle, surfaces, contours, functions");
    command.add_option("--environment", model_.environment, "environment file (.e): the process that answers ?E");
    command.add_flag("--without-environment", model_.without_environment,
                     "do not answer queries; they keep their parameters");
    command.add_option("--define", defines_, "NAME=VALUE replaces a #define of the model; may be repeated")
        ->allow_extra_args(false);
    command
        .add_option("--insert", model_.insertions,
                    "MODULES@STEP or MODULES@STEP:SYMBOL.NUMBER puts modules into the string of a step, at its "
                    "beginning or before a module, as a mouse did in cpfg's window; may be repeated")
        ->allow_extra_args(false);
    command
        .add_option_function<std::string>(
            "--arithmetic", [this](const std::string& text) { model_.arithmetic = arithmetic_called(text); },
            "double, or cpfg: compute like cpfg, with 32-bit parameters and its quirks; default: cpfg for the folder "
            "of "
            "an object and for a model with --view, --animate or --environment, else double")
        ->check(CLI::IsMember({"double", "cpfg"}));
    command.add_flag_callback(
        "--cpfg-quirks", [this] { model_.arithmetic = Arithmetic::cpfg; }, "another name for --arithmetic cpfg");
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

MemoryOption::MemoryOption(CLI::App& command) {
    command.add_option("--memory", memory_,
                       "memory that the run may use, such as 4G; default: half of what the machine, the container or "
                       "the job of a cluster has");
}

std::size_t MemoryOption::bytes() const {
    return memory_.empty() ? 0 : size_in_bytes(memory_, "--memory");
}

TimeoutOption::TimeoutOption(CLI::App& command) {
    command
        .add_option("--timeout", seconds_,
                    "seconds that a process may take to answer the queries of one step; 0: any time; default: 3600")
        ->check(CLI::Range(0.0, 1e9));
}

GrowthOptions::GrowthOptions(CLI::App& command) : memory_(command) {
    command.add_option("--steps", steps_, "number of derivation steps; default: that of the scene or the model")
        ->check(CLI::Range(0, 1000000000));
    command
        .add_option_function<std::string>(
            "--seed", [this](const std::string& text) { read_seed(text); },
            "seed of all random numbers; the same seed gives the same result. random: draw a seed and print it")
        ->type_name("INT|random");
    command.add_flag("--trust", trust_, trust_help);
}

void GrowthOptions::read_seed(const std::string& text) {
    if (text == "random") {
        seed_ = std::random_device{}();
        fmt::print(stderr, "seed {}\n", seed_);
        return;
    }
    if (const auto seed = whole_text_as<decltype(seed_)>(text); seed && *seed >= 0) {
        seed_ = *seed;
        return;
    }
    throw CLI::ValidationError("--seed", "a whole number of at least 0, or random, is expected, not " + text);
}

DiskOption::DiskOption(CLI::App& command) {
    command.add_option("--disk", disk_, "how much the run may write, such as 100G; default: 20G");
}

std::size_t DiskOption::bytes() const {
    return disk_.empty() ? 0 : size_in_bytes(disk_, "--disk");
}

IntervalOptions::IntervalOptions(CLI::App& command) {
    command.add_option("--every", every_, "record a frame every N steps; default: as the scene says, or 1")
        ->check(CLI::Range(1, 1000000000));
    command
        .add_option("--checkpoint-every", checkpoint_every_,
                    "write a checkpoint every N steps for `espalier resume`; default: every minute, before steps that "
                    "take long, and when interrupted")
        ->check(CLI::Range(1, 1000000000));
}

void IntervalOptions::add_to(KeyValues& overrides) const {
    if (every_ > 0) overrides.emplace_back("timeline.every", std::to_string(every_));
}

BlockOptions::BlockOptions(CLI::App& command) {
    constexpr std::size_t most = 1000000;
    CLI::Option* const blocks =
        command
            .add_option(
                "--blocks", blocks_,
                "divide the plants (of each rank) into N blocks, of which some are in memory while the others wait on "
                "disk, in the output folder: for worlds larger than memory. Changes no byte of the timeline")
            ->check(CLI::Range(std::size_t{1}, most));
    command.add_option("--resident", resident_, "how many of the blocks are in memory at once; default: 1")
        ->check(CLI::Range(std::size_t{1}, most))
        ->needs(blocks);
}

}  // namespace espalier::app
