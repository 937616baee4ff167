// A run as it lies on disk, or its frames in memory: for analysis, pictures and export, without growing it again.
#pragma once

#include "espalier/base/column.h"
#include "espalier/base/stations.h"
#include "espalier/geometry/frame_geometry.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace espalier::archive {

/// A row of lifespans.vtp: an internode where it was last seen.
struct RecordedLife {
    glm::vec3 base, tip;
    float base_radius, tip_radius;
    std::uint64_t identity, parent;
    std::uint32_t plant;
    std::uint16_t symbol, order, colour;
    std::int32_t birth, death;  ///< alive at the steps birth <= t < death
    bool alive;                 ///< at the end of the run
};

struct RecordedLives {
    std::vector<RecordedLife> lives;
    std::vector<std::string> symbol_names;
};

/// A field at its voxels' centres, x fastest.
struct RecordedField {
    std::string name, unit, meaning;
    glm::ivec3 size{0};
    glm::dvec3 origin{0};  ///< centre of the first voxel
    glm::dvec3 voxel{1};
    Column<float> values;

    float at(int x, int y, int z) const {
        return values[(static_cast<std::size_t>(z) * static_cast<std::size_t>(size.y) + static_cast<std::size_t>(y)) *
                          static_cast<std::size_t>(size.x) +
                      static_cast<std::size_t>(x)];
    }
};

/// statistics.csv and its like: a number per row and column; NaN where a cell is empty.
struct RecordedTable {
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;

    /// The column's index. Throws UserError naming the nearest, if there is none.
    std::size_t column(const std::string& name) const;
    /// Those of the last step, a row a plant.
    std::vector<std::vector<double>> last_rows() const;
};
/// The column `name`, which holds texts, is left out. Throws UserError naming the file if it is missing or damaged; a
/// row that is being written is none yet.
RecordedTable read_table(const std::filesystem::path& file);

struct RecordedPlant {
    std::uint32_t number = 0;
    std::string name, model;
};

/// A time of the run. What did not change is written once: several frames may name the same file.
struct RecordedFrame {
    int step = 0;
    double time = 0;
    std::filesystem::path plants;                         ///< empty where no plants were recorded
    std::map<std::string, std::filesystem::path> fields;  ///< .vti, or .vdb where only that was recorded
    std::shared_ptr<const FrameGeometry> geometry;        ///< the plants, where they are in memory instead of a file
    std::vector<std::filesystem::path> more_plants = {};  ///< further files of a frame that is cut between plants

    /// The frame once for each of its files, with this one alone: for those who need not hold all plants at once.
    std::vector<RecordedFrame> pieces() const;
};

/// How the author of a model looked at it, as its view file says.
struct RecordedView {
    glm::dvec3 towards_eye{0, 0, 1};  ///< from what is looked at; not 0
    double twist = 0;                 ///< degrees
    bool perspective = false;
    double angle = 45;                        ///< degrees, perspective only
    std::optional<glm::dvec3> towards_light;  ///< not 0
    std::optional<std::array<std::uint8_t, 3>> background;
};

/// What a recorded colour does not tell of the material behind it.
struct RecordedMaterial {
    glm::dvec3 emission{0};  ///< the part of the colour that it emits, in [0, 1] of the screen
    double opacity = 1;

    bool is_plain() const { return opacity == 1 && emission == glm::dvec3(0); }
};

/// background.vtp: the triangles of what stands around the plants.
struct RecordedBackground {
    Column<glm::vec3> points, normals;
    FrameCells triangles;
    Column<std::array<std::uint8_t, 3>> rgb;  ///< one colour a triangle, as the opacities
    Column<float> opacities;
};

/// How the run in a folder ended, as `RecordedRun::exit` says it. Throws UserError if there is none.
std::string exit_of_run(const std::filesystem::path& folder);

/// The folder of the run that a path names: itself, or the folder whose run a file of a timeline belongs to (run.json,
/// plants.pvd, plants/0012.vtp, fields/light/0012.vti, statistics.csv). A path to something else stays.
std::filesystem::path folder_of_run(const std::filesystem::path& path);

/// Opens a run's folder, or one of its files; also of a run that is still going. Everything that is missing or damaged,
/// at once or when it is loaded, throws UserError naming the file.
class RecordedRun {
public:
    explicit RecordedRun(const std::filesystem::path& path);
    /// A run that lies in no folder: `record` is what run.json would say. Throws UserError if it does not say it.
    RecordedRun(const std::string& record, std::vector<RecordedFrame> frames);

    /// Empty for a run that lies in none.
    const std::filesystem::path& folder() const { return folder_; }
    const std::string& scene() const { return scene_; }  ///< its name
    /// How it ended: "done", "interrupted", "failed: why", "killed"; "running" while it is going.
    const std::string& exit() const { return exit_; }
    const std::string& time_unit() const { return time_unit_; }
    double dt() const { return dt_; }  ///< length of a step, in time units
    /// Where 0 of the run lies on the map, m, y upwards; none: at 0.
    const std::optional<glm::dvec3>& origin() const { return origin_; }
    /// Units of the processes' quantities in `statistics`, by column; of those that have one.
    const std::map<std::string, std::string>& units() const { return units_; }
    /// Extent along x times extent along z of the domain of the scene or of a process, m2, if there is one.
    std::optional<double> ground_area() const { return ground_area_; }
    const std::vector<RecordedPlant>& plants() const { return plants_; }
    /// The number of the plant of that name. Throws UserError naming the nearest.
    std::uint32_t plant(const std::string& name) const;
    /// In the order of time; every step at most once.
    const std::vector<RecordedFrame>& frames() const { return frames_; }
    /// The frame of that step. Throws UserError naming the nearest.
    const RecordedFrame& frame(int step) const;
    std::vector<std::string> field_names() const;

    FrameGeometry geometry(const RecordedFrame& frame) const;
    RecordedField field(const RecordedFrame& frame, const std::string& name) const;
    /// None if no plant has a view file.
    const std::optional<RecordedView>& view() const { return view_; }
    /// None if the view files name no background scene.
    std::optional<RecordedBackground> background() const;
    /// The material behind a colour of `rgb`; of several with this colour the first that emits light or is transparent.
    RecordedMaterial material(const std::array<std::uint8_t, 3>& rgb) const;
    RecordedTable statistics() const;
    RecordedLives lifespans() const;

private:
    void take(const std::string& record);

    std::filesystem::path folder_;
    std::string scene_, exit_, time_unit_ = "step";
    double dt_ = 1;
    std::map<std::string, std::string> units_;
    std::optional<glm::dvec3> origin_;
    std::optional<double> ground_area_;
    std::vector<RecordedPlant> plants_;
    std::vector<RecordedFrame> frames_;
    std::optional<RecordedView> view_;
    std::map<std::array<std::uint8_t, 3>, RecordedMaterial> materials_;
};

}  // namespace espalier::archive
