// Fields as they are at one moment, for turtles that read them.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/geometry/field.h"

#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace espalier::geometry {

/// Many threads may read at once.
class FieldValues {
public:
    /// Keeps the grids that the fields so named have now.
    void take(const Fields& fields, const std::vector<std::string>& names);
    void forget() { grids_.clear(); }

    /// Linear between the centres of voxels; 0 for a field that has no grid.
    double value(const std::string& name, const glm::dvec3& position) const;
    /// Per metre, by differences over two voxels.
    glm::dvec3 gradient(const std::string& name, const glm::dvec3& position) const;

    /// Every value, to the last bit.
    void save(std::ostream& out) const;
    void restore(std::istream& in);

private:
    const FieldGrid* find(const std::string& name) const;

    std::map<std::string, std::shared_ptr<const FieldGrid>> grids_;
};

}  // namespace espalier::geometry
