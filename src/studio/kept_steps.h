// The steps of one growth: what the page draws of each, and the strings behind it.
#pragma once

#include "espalier/lsystem/module_string.h"
#include "espalier/timeline/frame.h"

#include "studio/packet.h"
#include "studio/spool.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace espalier::studio {

/// Written by the thread that grows, read by the one that serves. The newest steps are kept in memory, older ones in a
/// file.
class KeptSteps {
public:
    static constexpr std::size_t most_memory = std::size_t(512) << 20;  ///< bytes

    KeptSteps(std::uint32_t growth, std::filesystem::path file, std::size_t memory = most_memory)
        : writer_(growth, file.parent_path()), file_(std::move(file)), memory_(memory) {}

    /// Returns the number of internodes. Throws RunError if the disk is full.
    std::size_t add(const timeline::Frame& frame);

    bool has(int step) const;
    /// The packet of a step that there is.
    std::string packet(int step) const;
    /// The messages with all surfaces that packets have used so far, in the order in which they came.
    std::vector<std::string> shapes() const;
    /// What packets have worn so far.
    std::vector<WornPicture> textures() const;
    /// The strings of the plants at a step that there is.
    std::vector<ModuleString> strings(int step) const;
    /// The string of one plant.
    ModuleString string(int step, std::size_t plant) const;

private:
    /// A string in the file.
    struct FiledString {
        Spool::Place letters, parameters, births;
        SiblingTable siblings;
    };
    struct Step {
        std::shared_ptr<const std::string> packet;  ///< null: all of the step is in the file
        std::vector<std::shared_ptr<const ModuleString>> strings;
        Spool::Place filed_packet;
        std::vector<FiledString> filed_strings;

        std::size_t bytes() const;
    };

    void file_oldest();
    Step step(int number) const;
    ModuleString read(const Step& step, std::size_t plant) const;

    PacketWriter writer_;
    const std::filesystem::path file_;
    const std::size_t memory_;
    std::size_t in_memory_ = 0;  ///< bytes
    std::unique_ptr<Spool> spool_;
    mutable std::mutex mutex_;
    std::map<int, Step> steps_;
    std::vector<std::string> shapes_;
    std::vector<WornPicture> textures_;
};

}  // namespace espalier::studio
