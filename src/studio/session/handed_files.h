// Files that the pages may fetch, by numbers instead of paths.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>

namespace espalier::studio {

class HandedFiles {
public:
    /// The same number for the same file.
    std::uint32_t number(const std::filesystem::path& file) {
        const auto [place, is_new] = numbers_.try_emplace(file, static_cast<std::uint32_t>(numbers_.size() + 1));
        if (is_new) files_[place->second] = file;
        return place->second;
    }
    std::optional<std::filesystem::path> find(std::uint32_t number) const {
        const auto found = files_.find(number);
        return found == files_.end() ? std::nullopt : std::optional(found->second);
    }

private:
    std::map<std::filesystem::path, std::uint32_t> numbers_;
    std::map<std::uint32_t, std::filesystem::path> files_;
};

}  // namespace espalier::studio
