// A field: a named OpenVDB grid with unit and meaning. Processes share fields; recorders write them.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/geometry/plant_geometry.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace espalier::geometry {

/// Holds an OpenVDB grid; defined in espalier/geometry/openvdb_grid.h, the one public header that includes OpenVDB.
struct FieldGrid;

/// What made a field, or is shared without one, as far as other processes may work together with it: a soil with the
/// roots in it, the weather over plants.
class FieldSource {
public:
    virtual ~FieldSource() = default;
};

struct Field {
    std::string name;     ///< "light", "water", "pot.distance"
    std::string unit;     ///< "1", "m3/m3", "m"
    std::string meaning;  ///< one line
    std::shared_ptr<const FieldGrid> grid;
    /// Static fields (a shape that does not move) are recorded once.
    bool changes = true;
    /// Gives the grid as it is at present, for fields that are made when they are asked for; else empty.
    std::function<std::shared_ptr<const FieldGrid>()> current = {};
    FieldSource* source = nullptr;  ///< lives as long as the fields; null: none
};

/// The fields of a world by name: where processes meet. Asking for a field may make it; ask from one thread only. A
/// grid that only the fields hold may be written over in the next step: keep the pointer to keep the values.
class Fields {
public:
    /// Adds or replaces.
    void provide(Field field);
    /// Throws UserError naming the fields there are, if `name` is none of them.
    const Field& need(const std::string& name) const;
    const Field* find(const std::string& name) const;
    const std::map<std::string, Field>& all() const;

    /// What is the same everywhere needs no grid: processes find it by the name of the one that has it.
    void share(const std::string& name, FieldSource& source) { shared_[name] = &source; }
    /// Null: no process has shared this name.
    FieldSource* shared(const std::string& name) const;

private:
    mutable std::map<std::string, Field> fields_;
    std::map<std::string, FieldSource*> shared_;
};

}  // namespace espalier::geometry
