// A frame's plants as the points, cells and arrays that its file holds.
#pragma once

#include "espalier/base/settings.h"
#include "espalier/geometry/frame_geometry.h"
#include "espalier/timeline/frame.h"

#include "geometry/drawn/mesh_size.h"
#include "geometry/drawn/plant_mesh.h"
#include "timeline/meshes/attribute_arrays.h"
#include "timeline/meshes/chosen_parameters.h"
#include "timeline/meshes/symbol_numbers.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::timeline {

/// What processes know of organs and a scene wants recorded: `organs = ["light.absorbed"]`.
class OrganQuantities {
public:
    /// Reads the key `organs` of [timeline].
    explicit OrganQuantities(const Settings& timeline);

    const std::vector<std::string>& names() const { return names_; }
    std::size_t size() const { return names_.size(); }
    /// Looks them up, once, among those of the frame's environment. Throws UserError naming the nearest.
    void find(const Frame& frame);
    /// Once they are found.
    std::span<const OrganQuantity> known() const { return known_; }
    /// "light.absorbed: mol", one for each.
    std::vector<std::string> units() const;

private:
    std::vector<std::string> names_;
    Place place_;
    std::vector<OrganQuantity> known_;
};

class VtkFile;

/// Written anew for every frame, over the frame before.
class FrameColumns {
public:
    /// Files of textures are named from `folder`, or by their whole paths if there is none. Queries are shown where one
    /// of their parameters is chosen.
    /// `timeline` chooses parameters and quantities of organs.
    FrameColumns(std::optional<std::filesystem::path> folder, const Settings& timeline);

    /// Throws UserError for parameters that none of the models has.
    void require_known(std::span<const Model* const> models) const { timeline::require_known(chosen_, models); }
    /// Frames show plants of these models from now on: their symbols have numbers in this order, behind those known.
    void expect(std::span<const Model* const> models);
    /// Throws UserError for quantities of organs that no process knows.
    void fill(const Frame& frame);
    /// Adds all but the time to a file that has begun.
    void put_into(VtkFile& file, double time, int step) const;
    FrameGeometry geometry() const;
    /// Since the frame before.
    bool changed() const;

    /// Frees the memory of the frame.
    void release();

    /// How large a plant's part of the mesh will be. Thread safe.
    MeshSize foreseen(const Interpretation& interpretation) const;
    /// How many numbers of each module are chosen.
    std::size_t chosen() const { return chosen_.size() + organ_quantities_.size(); }
    const std::vector<std::string>& organs() const { return organ_quantities_.names(); }
    /// What it takes to find the parameters of a string.
    std::size_t bytes_of_offsets(const ModuleString& string) const {
        return chosen_.empty() ? 0 : sizeof(std::size_t) * string.size();
    }
    /// Those of all frames so far, the first "".
    const std::vector<std::string>& texture_files() const { return texture_files_; }
    /// The files come first, as after the frames that had them.
    void expect(std::vector<std::string> texture_files) { texture_files_ = std::move(texture_files); }

private:
    void fill_mesh(const Frame& frame);
    void fill_arrays(const Frame& frame);
    bool shows_queries() const;
    void add_asked_queries(const PlantFrame& plant, std::uint32_t index);

    std::optional<std::filesystem::path> folder_;
    std::vector<ChosenParameter> chosen_;
    OrganQuantities organ_quantities_;
    OrganSource organs_;
    mutable SurfaceSizes surface_sizes_;
    SymbolNumbers symbols_;
    std::vector<std::string> texture_files_;

    PlantMesh mesh_;
    Owners cell_owners_;  ///< VTK counts a data set's cells so: vertices, lines, polygons
    OwnerArrays of_points_, of_cells_;
    std::size_t texts_before_ = 0;  ///< texture files and symbols, which only grow
    bool texts_changed_ = false;
};

}  // namespace espalier::timeline
