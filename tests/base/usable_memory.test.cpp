// Limits of control groups as Linux shows them, in a folder that stands for the root of the file system.
#include "base/usable_memory.h"

#include "catch.h"
#include "temporary_folder.h"

#include <map>
#include <string>

using namespace espalier;

namespace {

constexpr std::size_t mebibyte = std::size_t{1} << 20;
constexpr std::size_t machine = 64 * 1024 * mebibyte;

class Machine {
public:
    void file(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((folder_.path() / name).parent_path());
        folder_.write(name, text);
    }
    void variable(const std::string& name, const std::string& value) { variables_[name] = value; }

    std::size_t usable() const {
        const auto value = [this](const char* name) {
            const auto found = variables_.find(name);
            return found == variables_.end() ? nullptr : found->second.c_str();
        };
        return usable_memory({machine, folder_.path(), value});
    }

private:
    TemporaryFolder folder_;
    std::map<std::string, std::string> variables_;
};

/// As on Debian 12: one hierarchy of version 2.
class SecondVersion : public Machine {
public:
    SecondVersion() {
        file("proc/self/mountinfo",
             "25 30 0:22 / /proc rw,nosuid shared:13 - proc proc rw\n"
             "31 24 0:27 / /sys/fs/cgroup rw,nosuid,nodev shared:9 - cgroup2 cgroup2 rw,nsdelegate\n");
    }
};

/// As on Debian 10: a hierarchy for each controller of version 1, and one of version 2 without controllers.
class FirstVersion : public Machine {
public:
    FirstVersion() {
        file("proc/self/mountinfo",
             "31 24 0:27 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw,nsdelegate\n"
             "35 24 0:32 / /sys/fs/cgroup/memory rw,relatime shared:17 - cgroup cgroup rw,memory\n"
             "36 24 0:33 / /sys/fs/cgroup/cpu,cpuacct rw shared:18 - cgroup cgroup rw,cpu,cpuacct\n");
        file("proc/self/cgroup", "9:cpu,cpuacct:/\n4:memory:/slurm/uid_1000/job_7/step_batch\n0::/system.slice\n");
    }
};

}  // namespace

TEST_CASE_METHOD(Machine, "a process without limits may use the machine", "[base]") {
    CHECK(usable() == machine);
    file("proc/self/cgroup", "nonsense\n::\n0:\n");
    file("proc/self/mountinfo",
         "1 2 3\n31 24 0:27 / /sys/fs/cgroup rw -\n31 24 0:27 / /sys/fs/cgroup rw - cgroup2 x rw\n");
    CHECK(usable() == machine);
}

TEST_CASE_METHOD(SecondVersion, "the least limit of a group and of those that it is in counts", "[base]") {
    file("proc/self/cgroup", "0::/system.slice/job_7/step_0\n");
    const std::string groups = "sys/fs/cgroup/";
    file(groups + "system.slice/job_7/step_0/memory.max", "max\n");
    CHECK(usable() == machine);
    file(groups + "system.slice/job_7/memory.max", std::to_string(4096 * mebibyte) + "\n");
    CHECK(usable() == 4096 * mebibyte);
    file(groups + "system.slice/memory.high", std::to_string(3000 * mebibyte) + "\n");
    CHECK(usable() == 3000 * mebibyte);
    file(groups + "system.slice/job_7/step_0/memory.max", std::to_string(512 * mebibyte) + "\n");
    CHECK(usable() == 512 * mebibyte);
    file(groups + "system.slice/other/memory.max", std::to_string(mebibyte) + "\n");  // of others
    CHECK(usable() == 512 * mebibyte);
}

TEST_CASE_METHOD(SecondVersion, "a container sees its own group as the topmost one", "[base]") {
    file("sys/fs/cgroup/memory.max", std::to_string(2048 * mebibyte) + "\n");
    for (const char* group : {"0::/\n", "0::/docker/4f2a\n", "0::/../outside\n"}) {
        CAPTURE(group);
        file("proc/self/cgroup", group);
        CHECK(usable() == 2048 * mebibyte);
    }
}

TEST_CASE_METHOD(FirstVersion, "groups of version 1 limit memory where that controller is mounted", "[base]") {
    file("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    CHECK(usable() == machine);
    file("sys/fs/cgroup/memory/slurm/uid_1000/job_7/memory.limit_in_bytes", std::to_string(1500 * mebibyte) + "\n");
    CHECK(usable() == 1500 * mebibyte);
    file("sys/fs/cgroup/unified/system.slice/memory.max", std::to_string(1000 * mebibyte) + "\n");
    CHECK(usable() == 1000 * mebibyte);
}

TEST_CASE_METHOD(FirstVersion, "a mount that shows a part of the groups is read from that part on", "[base]") {
    file("proc/self/mountinfo", "35 24 0:32 /slurm/uid_1000 /groups rw - cgroup cgroup rw,memory\n");
    file("groups/job_7/memory.limit_in_bytes", std::to_string(700 * mebibyte) + "\n");
    CHECK(usable() == 700 * mebibyte);
}

TEST_CASE_METHOD(Machine, "what Slurm gives a job on a node counts", "[base]") {
    variable("SLURM_MEM_PER_CPU", "2000");
    CHECK(usable() == machine);  // of how many processors is unknown
    variable("SLURM_CPUS_ON_NODE", "4");
    CHECK(usable() == 8000 * mebibyte);
    variable("SLURM_MEM_PER_NODE", "3000");
    CHECK(usable() == 3000 * mebibyte);
    variable("SLURM_MEM_PER_NODE", "0");  // all of the node
    variable("SLURM_MEM_PER_CPU", "0");
    CHECK(usable() == machine);
    for (const char* nonsense : {"much", "-1", "18446744073709551615", ""}) {
        CAPTURE(nonsense);
        variable("SLURM_MEM_PER_NODE", nonsense);
        CHECK(usable() == machine);
    }
}

TEST_CASE("this process may use some of its machine", "[base]") {
    CHECK(usable_memory() > mebibyte);
}
