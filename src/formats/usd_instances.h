// Organs that look alike as one shape in many places: USD's point instancers.
#pragma once

#include "formats/growth_nodes.h"
#include "formats/usd_materials.h"

#include <map>
#include <string>
#include <vector>

namespace espalier::formats::usd {

class Instancers {
public:
    Instancers(const ExportJob& job, UsdMaterials& materials);

    /// Appends the instancer of a plant, whose prim has this path.
    void append_to(std::string& text, std::uint32_t plant, const std::string& path) const;

    std::size_t vertices() const { return vertices_; }
    std::size_t triangles() const { return triangles_; }

private:
    struct Shape {
        const NodeShape* shape;
        std::map<std::string, std::vector<std::size_t>> faces;  ///< triangles that wear each material
    };
    struct ByKey {
        bool operator()(const NodeShape& a, const NodeShape& b) const { return a.key() < b.key(); }
    };

    void append_shapes(std::string& text, std::uint32_t plant) const;
    void append_places(std::string& text, std::uint32_t plant) const;

    const ExportJob& job_;
    GrowthNodes nodes_;
    std::map<std::uint32_t, std::vector<Shape>> shapes_;  ///< shapes of each plant
    std::vector<std::size_t> shape_of_;                   ///< shape of each node, among those of its plant
    std::size_t vertices_ = 0, triangles_ = 0;
};

}  // namespace espalier::formats::usd
