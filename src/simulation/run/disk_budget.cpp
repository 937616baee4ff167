#include "simulation/run/disk_budget.h"

#include "base/folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

namespace espalier::simulation {

namespace fs = std::filesystem;

DiskBudget::DiskBudget(const fs::path& folder, std::uintmax_t bytes, bool resumed) : folder_(folder), bytes_(bytes) {
    look();
    if (!resumed) before_ = std::exchange(written_, 0);
}

bool DiskBudget::is_spent() {
    if (std::has_single_bit(++asked_) || std::chrono::steady_clock::now() >= next_) look();
    return written_ > bytes_;
}

void DiskBudget::look() {
    constexpr int part_of_the_time = 50;
    const auto begin = std::chrono::steady_clock::now();
    const std::uintmax_t bytes = bytes_below(folder_);
    written_ = bytes - std::min(bytes, before_);
    const auto end = std::chrono::steady_clock::now();
    next_ = end + part_of_the_time * (end - begin);
}

std::string size_text(std::uintmax_t bytes) {
    const char* const units[] = {"bytes", "KiB", "MiB", "GiB", "TiB"};
    auto size = static_cast<double>(bytes);
    std::size_t unit = 0;
    for (; size >= 1024 && unit + 1 < std::size(units); ++unit) size /= 1024;
    return fmt::format("{:.4g} {}", size, units[unit]);
}

}  // namespace espalier::simulation
