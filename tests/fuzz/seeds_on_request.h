// Seeds that a fuzz target makes itself, because they are bytes that this program writes: `./dev fuzz` asks for them.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

/// With ESPALIER_FUZZ_SEEDS=FOLDER in the environment `write` is called with what puts a seed into the folder, and the
/// program ends.
inline void write_seeds_if_asked(
    const std::function<void(const std::function<void(const std::string& name, const std::string& bytes)>&)>& write) {
    const char* const folder = std::getenv("ESPALIER_FUZZ_SEEDS");
    if (!folder) return;
    write([&](const std::string& name, const std::string& bytes) {
        std::ofstream(std::filesystem::path(folder) / ("seed-" + name), std::ios::binary) << bytes;
    });
    std::_Exit(0);
}
