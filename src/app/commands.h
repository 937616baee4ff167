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

/// A model on its own, or the folder of an object, and the side files given with it.
struct ModelArguments {
    std::filesystem::path file;  ///< may be a scene where a command takes one
    std::filesystem::path view, animation, environment;
    std::vector<std::string> colour_maps, materials;  ///< FILE, or N=FILE for set N
    bool without_environment = false;
    KeyValues defines;
    bool quirks = false;
};

struct RunArguments {
    ModelArguments model;
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
    ModelArguments model;  ///< or a side file alone
    KeyValues overrides;   ///< of a scene
    bool json = false;
};
int check_command(const CheckArguments& arguments);

struct DeriveArguments {
    ModelArguments model;
    std::optional<int> steps;
    std::optional<std::uint64_t> seed;
    std::string format = "text";
    bool before_exchange = false;
    std::filesystem::path files;  ///< where files go that the model writes; empty: nowhere
    bool quiet = false;
    std::size_t memory = 0;
};
int derive_command(const DeriveArguments& arguments);

struct InfoArguments {
    std::filesystem::path folder;
    bool json = false;
};
int info_command(const InfoArguments& arguments);

struct ListArguments {
    std::string kind;              ///< "" for everything
    std::string name;              ///< "" for all of a kind
    std::filesystem::path models;  ///< the library of models; empty: where it is usually found
    bool json = false;
};
int list_command(const ListArguments& arguments);

/// The kinds `list` knows, for the help of the command line.
std::vector<std::string> list_kinds();

}  // namespace espalier
