// A field: a named OpenVDB grid with unit and meaning. Processes share fields; recorders write them.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace espalier {

/// Holds an OpenVDB grid; defined in espalier/environment/openvdb_grid.h, the one public header that includes OpenVDB.
struct FieldGrid;

struct Field {
    std::string name;     ///< "light", "water", "pot.distance"
    std::string unit;     ///< "1", "m3/m3", "m"
    std::string meaning;  ///< one line
    std::shared_ptr<const FieldGrid> grid;
    /// Static fields (a shape that does not move) are recorded once.
    bool changes = true;
};

/// The fields of a world by name: where processes meet.
class Fields {
public:
    /// Adds or replaces.
    void provide(Field field);
    /// Throws UserError naming the fields there are, if `name` is none of them.
    const Field& need(const std::string& name) const;
    const Field* find(const std::string& name) const;
    const std::map<std::string, Field>& all() const { return fields_; }

private:
    std::map<std::string, Field> fields_;
};

}  // namespace espalier
