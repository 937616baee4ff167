// The program's commands: what the command line asked for, and the functions that do it. Each returns an exit code.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace espalier {

namespace exit_code {
inline constexpr int done = 0, user_error = 1, run_failed = 2, interrupted = 130;
}

using KeyValues = std::vector<std::pair<std::string, std::string>>;

struct RunArguments {
    std::filesystem::path scene;  ///< a scene, or a model on its own
    KeyValues overrides;
    std::optional<int> steps;
    std::optional<std::uint64_t> seed;
    int threads = 0;  ///< 0: as many as the machine has
    std::filesystem::path output;
    bool overwrite = false;
    std::size_t memory = 0;
    bool quiet = false;
    bool json = false;
};
int run_command(const RunArguments& arguments);

struct CheckArguments {
    std::filesystem::path file;
    KeyValues overrides;  ///< of a scene
    KeyValues defines;    ///< of a model
    bool quirks = false;
    bool json = false;
};
int check_command(const CheckArguments& arguments);

struct DeriveArguments {
    std::filesystem::path model;
    std::optional<int> steps;
    std::optional<std::uint64_t> seed;
    KeyValues defines;
    std::string format = "text";
    bool before_exchange = false;
    bool quirks = false;
    std::size_t memory = 0;
};
int derive_command(const DeriveArguments& arguments);

struct InfoArguments {
    std::filesystem::path folder;
    bool json = false;
};
int info_command(const InfoArguments& arguments);

struct ListArguments {
    std::string kind;  ///< "" for everything
    std::string name;  ///< "" for all of a kind
    bool json = false;
};
int list_command(const ListArguments& arguments);

/// The kinds `list` knows, for the help of the command line.
std::vector<std::string> list_kinds();

}  // namespace espalier
