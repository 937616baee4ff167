// The steps of one growth: what the page draws of each, and the strings behind it.
#pragma once

#include "espalier/lsystem/module_string.h"
#include "espalier/timeline/frame.h"

#include "studio/growth/kept_messages.h"
#include "studio/growth/spool.h"
#include "studio/growth/step_strings.h"
#include "studio/packets/limb_axes.h"
#include "studio/packets/packet.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace espalier::studio {

/// Written by the thread that grows, read by the one that serves and by growths that follow. The newest steps are kept
/// in memory, older ones in a file.
class KeptSteps {
public:
    static constexpr std::size_t most_memory = std::size_t(512) << 20;  ///< bytes

    KeptSteps(std::uint32_t growth, const std::filesystem::path& file, std::size_t memory = most_memory);

    /// The surfaces of the scene, before anything is drawn: packets then call them the same, whichever is drawn first.
    void expect(const Scene& scene);
    /// The strings of another growth that serve this scene, changed where it has other constants; of one with exchanges
    /// all to its end, with what processes knew. Returns the last step that there is; -1: none.
    int inherit(const KeptSteps& before, const Origin& now);
    /// Models ended the growth at this step.
    void note_stop(int step);
    /// Throws RunError if the disk is full, as add().
    void add_derived(DerivedStep derived, std::shared_ptr<const Origin> origin);
    /// What is drawn of a step; and its strings, if they are not there. Returns the number of internodes.
    std::size_t add(const timeline::Frame& frame);

    /// It has been derived.
    bool has(int step) const;
    /// It has been drawn.
    bool has_packet(int step) const;
    /// The packet of a step that was drawn.
    std::string packet(int step) const;
    /// Its axes.
    LimbAxes limb_axes(int step) const;
    /// The messages with all surfaces that packets have used so far, in the order in which they came.
    std::vector<std::string> shapes() const;
    /// What packets have worn so far.
    std::vector<BrowserTexture> textures() const;
    /// What a step that there is goes on from.
    DerivedStep derived(int step) const;
    /// What processes told of each plant of a step.
    std::vector<std::vector<Quantity>> quantities(int step) const;
    /// Fields of the steps, and what processes know of organs, as messages; a growth that inherits shares them.
    KeptMessages& fields() const { return *fields_; }
    KeptMessages& organs() const { return *organs_; }
    /// The strings of the plants at a step that there is.
    std::vector<ModuleString> strings(int step) const;
    /// The string of one plant.
    ModuleString string(int step, std::size_t plant) const;

private:
    struct Drawing {
        std::string packet;
        KeptAxes axes;
    };
    struct FiledDrawing {
        Spool::Place packet, axes;
    };
    struct Step {
        std::shared_ptr<const Drawing> drawing;  ///< null: it was not drawn, or is in the file
        std::optional<FiledDrawing> filed_drawing;
        std::shared_ptr<const StepStrings> strings;
        std::shared_ptr<const ReusePlan> changes;  ///< to be made in the strings; null: none
        std::vector<std::vector<Quantity>> quantities = {};

        std::size_t bytes() const {
            return (drawing ? drawing->packet.size() + drawing->axes.size() : 0) + strings->bytes();
        }
        bool is_in_memory() const { return drawing || !strings->is_filed(); }
        ModuleString string(std::size_t plant) const;
    };

    void keep(int number, Step step);
    void file_oldest();
    Step step(int number) const;

    PacketWriter writer_;
    const std::filesystem::path file_;
    const std::size_t memory_;
    std::size_t in_memory_ = 0;  ///< bytes
    std::shared_ptr<Spool> spool_;
    std::shared_ptr<KeptMessages> fields_, organs_;
    int stopped_at_ = -1;
    mutable std::mutex mutex_;
    std::map<int, Step> steps_;
    std::vector<std::string> shapes_;
    std::vector<BrowserTexture> textures_;
};

}  // namespace espalier::studio
