// A frame of a recorded run as the studio's page draws it.
#pragma once

#include "espalier/archive/organ_history.h"
#include "espalier/archive/recorded_run.h"

#include "studio/packets/limb_axes.h"
#include "studio/packets/packet_parts.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace espalier::studio {

/// A module that a frame shows.
struct RecordedModule {
    OrganKey organ;
    std::uint64_t parent = 0;
    std::uint16_t symbol = 0;
    int birth = 0, order = 0;
    std::optional<std::size_t> point;  ///< the row of its parameters; none: they are not recorded
};

/// What pages ask of a frame. Modules are counted plant after plant, in the order in which the file has them.
class DrawnFrame {
public:
    DrawnFrame(const RecordedRun& run, const RecordedFrame& frame);

    const std::vector<RecordedModule>& modules() const { return modules_; }
    std::size_t internodes() const { return parts_.internodes.size(); }
    const std::string& symbol_name(std::uint16_t symbol) const { return geometry_.symbol_names.at(symbol); }
    /// The recorded parameters that the module has, by their names.
    std::vector<std::pair<std::string, double>> parameters(const RecordedModule& module) const;
    /// All recorded parameters, by point; NaN where a module has none.
    const std::map<std::string, Column<double>>& parameter_columns() const { return geometry_.parameters; }
    const std::map<std::string, std::string>& units() const { return geometry_.units; }
    /// "age", "plant", "symbol", "order", then the recorded parameters.
    std::vector<std::string> columns() const;
    /// The messages of docs/developer/studio-protocol.md. Throws UserError if there is no such column.
    std::string column(std::uint32_t growth, int step, const std::string& name) const;
    std::string packet(std::uint32_t growth, int step) const { return parts_.bytes(growth, step); }
    /// They wear nothing: packets of recorded frames name no textures.
    LimbAxes limb_axes() const;

private:
    void find_modules(const RecordedRun& run, const std::vector<FrameInternode>& internodes);
    void add_internodes(const std::vector<FrameInternode>& internodes);
    void add_surfaces(const RecordedRun& run);
    std::uint32_t number_of(const OrganKey& organ) const { return numbers_.at(organ); }

    FrameGeometry geometry_;
    std::vector<RecordedModule> modules_;
    std::map<OrganKey, std::uint32_t> numbers_;
    PacketParts parts_;
};

}  // namespace espalier::studio
