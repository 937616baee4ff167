// What a scene says about a soil whose water follows Richards' equation, read and checked.
#pragma once

#include "espalier/environment/shape.h"

#include "environment/given/weather/time_series.h"
#include "environment/soil/grid/parameters.h"
#include "environment/soil/hydraulics/hydraulics.h"
#include "environment/soil/richards/texture_map.h"

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace espalier::environment {

/// The heads, cm, or the contents that a part of the soil begins with.
struct SoilBeginning {
    enum class Kind { head, table, content } kind = Kind::head;
    double value = -100;                   ///< cm; m, the height of the water table of hydrostatic soil; m3/m3
    std::vector<double> heights, profile;  ///< if any: of heads or contents, linear between rising heights, m
    Place place;

    double at(double height) const;
};

/// Heads that were measured at heights: linear between these, and each holds until the next time.
struct MeasuredHeads {
    std::vector<double> heights;  ///< m, rising
    std::vector<TimeSeries> heads;

    bool any() const { return !heads.empty(); }
    double at(double height, double day) const;
};

/// A side across: a head there, or the height of a water table, m.
struct SoilSide {
    enum class Kind { closed, head, table } kind = Kind::closed;
    TimeSeries value;

    bool is_open() const { return kind != Kind::closed; }
};

struct SoilLayer {
    LayerHeights heights;  ///< at x = 0
    double rise = 0;       ///< m of height per m along x
    std::optional<std::size_t> kind;
    std::optional<SoilBeginning> beginning;
};

/// A lens: a part of another soil, or one that begins with other water.
struct SoilRegion {
    std::shared_ptr<const Shape> shape;
    std::optional<std::size_t> kind;
    std::optional<SoilBeginning> beginning;
};

/// Water that is brought into a part of the soil, as by a drip line.
struct SoilInflow {
    std::shared_ptr<const Shape> shape;
    double rate = 0;  ///< content per day
    Place place;
};

struct SoilSurface {
    enum class Kind { closed, atmosphere, flux, head } kind = Kind::closed;
    TimeSeries rain, evaporation, flux, head;  ///< mm/d, mm/d potential, mm/d into the soil, cm
    double dry_limit = -10000;                 ///< cm: no head at the surface is lower
    double ponding = 0;                        ///< mm that stand on the surface before water runs off
};

struct SoilFloor {
    enum class Kind { closed, free_drainage, seepage, flux, head } kind = Kind::closed;
    TimeSeries flux, head;        ///< mm/d into the soil; cm at the bottom face
    std::optional<double> table;  ///< m: the height of the water table instead of a head
};

/// What becomes of a root that leaves the soil through a side or the floor.
enum class OutsideSoil {
    root_ends,  ///< there; what is drawn behind counts no more
    ignored,    ///< it goes on, and takes nothing up outside
    error
};

/// Reads the key `outside`. Throws UserError.
OutsideSoil read_outside(const Settings& settings);

struct SoilParameters {
    SoilSpace space;
    SoilQuerying querying;
    double days = 1;  ///< what a time unit of the scene is
    std::vector<SoilHydraulics> kinds;
    std::vector<std::string> kind_names;
    std::set<std::string> names_in_use;  ///< of soils of the scene or the library
    std::string map_field;               ///< a field whose values count `map`, from 0; empty: none
    TextureMap map_file;                 ///< instead of a field
    std::vector<std::size_t> map_kinds;  ///< kinds that the values of either stand for
    std::size_t kind = 0;                ///< of soil that no layer, region or map names
    SoilBeginning beginning;
    std::vector<SoilLayer> layers;
    std::vector<SoilRegion> regions;
    std::vector<SoilInflow> inflows;
    SoilSurface surface;
    SoilFloor floor;
    bool periodic = false;
    std::array<SoilSide, 4> sides;  ///< left, right, back, front
    bool is_still = false;          ///< heads are given, and nothing changes them
    MeasuredHeads measured;         ///< instead of `beginning`; only of still soil
    OutsideSoil outside = OutsideSoil::root_ends;
    double accuracy = 0.005;       ///< m3/m3: the error in time of a substep
    double max_substep = 1;        ///< days
    double wilting_head = -15000;  ///< cm: what queries leave in the soil
};

/// `is_still`: what model = "still" reads. `fields`: of the scene, with its weather. Throws UserError.
SoilParameters read_soil_parameters(Settings& settings, const EnvironmentContext& context, bool is_still = false,
                                    const Fields& fields = {});

/// Adds to `warnings`, unless null, that a root has left the soil, and sets the pointer to null.
void warn_of_root_outside(std::vector<Diagnostic>*& warnings, const SoilParameters& soil, const std::string& process,
                          std::uint32_t plant, const glm::dvec3& point);

/// What `espalier list` prints of model = "richards".
extern const char* const richards_help;

}  // namespace espalier::environment
