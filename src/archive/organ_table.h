// The organs of one frame, each once, found by their modules.
#pragma once

#include "espalier/archive/organ_history.h"

namespace espalier::archive {

/// All that a module draws in a frame, gathered.
struct OrganRow {
    OrganKey key;
    std::uint64_t parent;
    std::int32_t birth;
    std::uint16_t symbol, order;
    Kind kind;
    glm::vec3 base, tip;
    float base_radius, tip_radius;
    double length, area;  ///< m, m2; where faces wear a picture, what that leaves opaque
    std::int32_t point;   ///< whose parameters it has
};

class OrganTable {
public:
    /// `run` is the folder whence textures are found.
    OrganTable(const FrameGeometry& geometry, const std::filesystem::path& run);

    /// Null if the frame has no such organ.
    const OrganRow* find(const OrganKey& key) const;
    const std::string& symbol(const OrganRow& row) const { return symbol_names_[row.symbol]; }
    const std::vector<std::string>& parameter_names() const { return parameter_names_; }
    /// Returns the values of a row of this table, in the order of `names`; NaN where the frame has no such parameter.
    std::vector<double> parameters(const OrganRow& row, const std::vector<std::string>& names) const;
    std::size_t bytes() const;

private:
    void gather(const FrameGeometry& geometry, const std::filesystem::path& run);
    void keep_parameters(const FrameGeometry& geometry);

    std::vector<OrganRow> rows_;  ///< by key
    std::vector<std::string> symbol_names_, parameter_names_;
    std::vector<double> parameters_;  ///< row after row
};

}  // namespace espalier::archive
