#include "base/usable_memory.h"

#include "base/number.h"
#include "base/platform.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace espalier {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

// "max" is no number: there is no limit.
std::size_t limit_in(const fs::path& file) {
    std::ifstream in(file);
    std::size_t bytes = 0;
    return in >> bytes ? bytes : unlimited;
}

/// A file system of control groups: which group its folder is, and where the folder is.
struct GroupMount {
    fs::path group, folder;
    bool is_second_version = false;
};

std::vector<std::string> words_of(const std::string& line) {
    std::istringstream in(line);
    return {std::istream_iterator<std::string>(in), {}};
}

bool is_listed(const std::string& name, const std::string& list) {
    return ("," + list + ",").find("," + name + ",") != std::string::npos;
}

// "36 35 0:32 / /sys/fs/cgroup rw shared:9 - cgroup2 cgroup2 rw,nsdelegate": see proc(5).
std::optional<GroupMount> mount_in(const std::string& line) {
    constexpr std::size_t group = 3, folder = 4, type = 1, options = 3;
    const std::vector<std::string> words = words_of(line);
    const auto dash = std::find(words.begin(), words.end(), "-");
    if (dash - words.begin() <= static_cast<std::ptrdiff_t>(folder) || words.end() - dash <= 3) return std::nullopt;
    GroupMount mount{words[group], words[folder], dash[type] == "cgroup2"};
    if (mount.is_second_version || (dash[type] == "cgroup" && is_listed("memory", dash[options]))) return mount;
    return std::nullopt;
}

// "0::/user.slice" is of version 2, "4:memory:/slurm/uid_0/job_7" of version 1: see cgroups(7).
std::optional<fs::path> group_of_process(const fs::path& root, bool is_second_version) {
    std::ifstream in(root / "proc/self/cgroup");
    for (std::string line; std::getline(in, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        if (is_second_version ? controllers.empty() : is_listed("memory", controllers)) return line.substr(second + 1);
    }
    return std::nullopt;
}

// A container sees its own group as the topmost one, and may be told of a group that it does not see.
fs::path below_mount(const GroupMount& mount, const fs::path& group) {
    const fs::path below = group.lexically_normal().lexically_relative(mount.group);
    return below.empty() || *below.begin() == ".." || *below.begin() == "." ? fs::path() : below;
}

std::size_t limit_of_group(const fs::path& folder, bool is_second_version) {
    if (!is_second_version) return limit_in(folder / "memory.limit_in_bytes");
    return std::min(limit_in(folder / "memory.max"), limit_in(folder / "memory.high"));
}

std::size_t limit_of_groups(const fs::path& root) {
    std::size_t least = unlimited;
    std::ifstream mounts(root / "proc/self/mountinfo");
    for (std::string line; std::getline(mounts, line);) {
        const std::optional<GroupMount> mount = mount_in(line);
        if (!mount) continue;
        const std::optional<fs::path> group = group_of_process(root, mount->is_second_version);
        if (!group) continue;
        fs::path folder = root / mount->folder.relative_path();
        least = std::min(least, limit_of_group(folder, mount->is_second_version));
        for (const fs::path& name : below_mount(*mount, *group)) {
            folder /= name;
            least = std::min(least, limit_of_group(folder, mount->is_second_version));
        }
    }
    return least;
}

// Slurm counts in MiB; 0 is all there is.
std::size_t limit_of_slurm(const MemoryLimits& limits) {
    constexpr std::size_t most = unlimited >> 20;
    const auto number = [&](const char* name) {
        const char* const text = limits.variable(name);
        return text ? whole_text_as<std::size_t>(text).value_or(0) : 0;
    };
    if (const std::size_t node = number("SLURM_MEM_PER_NODE"); node > 0 && node < most) return node << 20;
    const std::size_t each = number("SLURM_MEM_PER_CPU"), count = number("SLURM_CPUS_ON_NODE");
    if (each == 0 || count == 0 || each >= most / count) return unlimited;
    return each * count << 20;
}

}  // namespace

std::size_t usable_memory(const MemoryLimits& limits) {
    return std::min({limits.machine, limit_of_groups(limits.root), limit_of_slurm(limits)});
}

std::size_t usable_memory() {
    return usable_memory({platform::machine_memory()});
}

}  // namespace espalier
