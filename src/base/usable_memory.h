// How much of a machine's memory this process may use: less than all in a container and in a job of a cluster.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <functional>

namespace espalier {

/// What says so; tests give their own.
struct MemoryLimits {
    std::size_t machine;               ///< bytes
    std::filesystem::path root = "/";  ///< of the file system: Linux tells of control groups in proc and sys
    std::function<const char*(const char* name)> variable = [](const char* name) { return std::getenv(name); };
};

/// The least of: the machine's memory; the limits of the process' control group and of all groups that this one is in
/// (versions 1 and 2; beyond such a limit the kernel ends the process); what Slurm gave the job on this machine,
/// SLURM_MEM_PER_NODE or SLURM_MEM_PER_CPU for SLURM_CPUS_ON_NODE processors. In bytes.
std::size_t usable_memory(const MemoryLimits& limits);
/// That of this process.
std::size_t usable_memory();

}  // namespace espalier
