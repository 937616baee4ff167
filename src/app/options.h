// Options that several commands share, and what they mean.
#pragma once

#include "base/number.h"
#include "model_arguments.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace espalier::app {

/// Of --quiet where something grows.
inline constexpr const char* quiet_growth_help =
    "print errors only, and warnings of what has not the effect it reads like";

/// `--option KEY=VALUE`; throws UserError if there is no '='.
std::pair<std::string, std::string> key_and_value(const std::string& text, const std::string& option);

/// "512M", "4G", "1.5GiB", "1000000": bytes; K, M, G, T are powers of 1024. Throws UserError naming the option.
std::size_t size_in_bytes(const std::string& text, const std::string& option);

/// All options of a command that take numbers read them as decimal: 010 is 10, 0x10 is no number. CLI11 reads whole
/// numbers as C does.
void read_decimal_numbers(CLI::App& command);

/// Its arguments are names, and an empty text is none: a script whose variable is not set.
void refuse_empty_names(CLI::App& command);

/// Accepts finite numbers above 0. CLI11's own tells of all of the range of a double.
CLI::Validator above_zero();

/// A scene, a model or an object, with the side files given beside it.
class ModelOptions {
public:
    enum class Files { reading, reading_and_drawing };

    /// `name` and `help` are the positional argument's.
    ModelOptions(CLI::App& command, const std::string& name, const std::string& help, Files files);

    ModelArguments arguments() const;

private:
    ModelArguments model_;
    std::vector<std::string> defines_;
};

/// --set KEY=VALUE.
class SetOptions {
public:
    explicit SetOptions(CLI::App& command);

    KeyValues overrides() const;

private:
    std::vector<std::string> sets_;
};

/// --memory.
class MemoryOption {
public:
    explicit MemoryOption(CLI::App& command);

    std::size_t bytes() const;  ///< 0: not given

private:
    std::string memory_;
};

/// --timeout.
class TimeoutOption {
public:
    explicit TimeoutOption(CLI::App& command);

    double seconds() const { return seconds_; }  ///< below 0: not given

private:
    double seconds_ = -1;
};

/// --steps, --seed, --memory and --trust.
class GrowthOptions {
public:
    explicit GrowthOptions(CLI::App& command);

    std::optional<int> steps() const { return steps_ < 0 ? std::nullopt : std::optional(steps_); }
    std::optional<std::uint64_t> seed() const {
        return seed_ < 0 ? std::nullopt : std::optional(static_cast<std::uint64_t>(seed_));
    }
    std::size_t memory() const { return memory_.bytes(); }  ///< 0: not given
    bool trust() const { return trust_; }

private:
    void read_seed(const std::string& text);

    int steps_ = -1;
    std::int64_t seed_ = -1;
    MemoryOption memory_;
    bool trust_ = false;
};

/// --disk.
class DiskOption {
public:
    explicit DiskOption(CLI::App& command);

    std::size_t bytes() const;  ///< 0: not given

private:
    std::string disk_;
};

/// --every and --checkpoint-every.
class IntervalOptions {
public:
    explicit IntervalOptions(CLI::App& command);

    /// Adds what --every means for the scene.
    void add_to(KeyValues& overrides) const;
    int checkpoint_every() const { return checkpoint_every_; }  ///< 0: not given

private:
    int every_ = 0, checkpoint_every_ = 0;
};

/// --blocks and --resident.
class BlockOptions {
public:
    explicit BlockOptions(CLI::App& command);

    std::size_t blocks() const { return blocks_; }  ///< 0: not given
    std::size_t resident() const { return resident_; }

private:
    std::size_t blocks_ = 0, resident_ = 1;
};

}  // namespace espalier::app
