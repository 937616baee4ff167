// The water there is, and the account of where it came from and went.
#pragma once

#include "environment/soil/grid/grid.h"
#include "environment/soil/linear/diffusion.h"

#include <functional>
#include <iosfwd>
#include <vector>

namespace espalier::environment {

/// In content times voxels; all but `total` add up from the beginning.
struct WaterBalance {
    double start = 0;
    double added = 0;     ///< by sources
    double boundary = 0;  ///< net, inwards through the sides
    double drunk = 0;
    double displaced = 0;  ///< out of voxels that a moving obstacle filled
    double runoff = 0;     ///< the part of what was added that found no room
    double total = 0;      ///< what there is now
    double minimum = 0, maximum = 0;

    /// What the account misses, relative to its largest entry.
    double relative_error() const;
};

class WaterStock {
public:
    /// `free`: one flag per voxel, x fastest.
    WaterStock(const WaterGrid& grid, const WaterParameters& parameters, std::vector<std::uint8_t> free);

    const WaterBrick& contents() const { return contents_; }
    const WaterFaces& faces() const { return faces_; }
    const WaterBalance& balance() const { return balance_; }

    /// Obstacles have moved: what stood in their new voxels is displaced; voxels they left begin empty.
    void set_free(std::vector<std::uint8_t> free);

    /// The content that a source holds, or the rate at which it gains.
    void set_source(std::size_t source, double value);

    /// Restarts at the steady state of diffusion.
    void settle(const WaterDiffusion& diffusion);

    /// Sources that hold a content fill their voxels; no time passes.
    void hold();
    void diffuse(WaterDiffusion& diffusion, double dt);
    void relax(double dt);

    /// Lets `take` take from the contents; it returns how much, in content times voxels.
    void drink(const std::function<double(WaterBrick&)>& take) { balance_.drunk += take(contents_); }

    /// Brings total, minimum and maximum of the balance up to date.
    void measure();

    void save(std::ostream& out) const;
    /// Throws RunError if the bytes are of another grid.
    void restore(std::istream& in);

private:
    struct Source {
        WaterSource source;
        std::vector<std::size_t> cells;
    };

    void paint();
    void find_sources();
    void gain(double dt);
    void run_off(const Source& source);

    WaterGrid grid_;
    WaterParameters parameters_;
    std::vector<std::uint8_t> free_;
    WaterFaces faces_;
    WaterBrick contents_, spare_;
    std::vector<Source> sources_;
    WaterBalance balance_;
};

}  // namespace espalier::environment
