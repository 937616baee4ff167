// The steps of one growth: what the page draws of each, and the strings behind it.
#pragma once

#include "espalier/lsystem/module_string.h"
#include "espalier/timeline/frame.h"

#include "studio/packet.h"
#include "studio/spool.h"

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace espalier::studio {

/// Written by the thread that grows, read by the one that serves.
class KeptSteps {
public:
    KeptSteps(std::uint32_t growth, const std::filesystem::path& file) : writer_(growth), spool_(file) {}

    /// Returns the number of internodes.
    std::size_t add(const timeline::Frame& frame);

    bool has(int step) const;
    /// The packet of a step that there is.
    std::string packet(int step) const;
    /// The messages with all surfaces that packets have used so far, in the order in which they came.
    std::vector<std::string> shapes() const;
    /// The strings of the plants at a step that there is.
    std::vector<ModuleString> strings(int step) const;
    /// The string of one plant.
    ModuleString string(int step, std::size_t plant) const;

private:
    struct KeptString {
        Spool::Place letters, parameters, births;
        SiblingTable siblings;
    };
    struct Step {
        Spool::Place packet;
        std::vector<KeptString> strings;
    };

    Step step(int number) const;
    ModuleString read(const KeptString& kept) const;

    PacketWriter writer_;
    Spool spool_;
    mutable std::mutex mutex_;
    std::map<int, Step> steps_;
    std::vector<std::string> shapes_;
};

}  // namespace espalier::studio
