// Where the light of many paths has gone, summed by several threads to the same bytes.
#pragma once

#include "environment/light/rays/light_path.h"

#include <cstdint>
#include <vector>

namespace espalier::environment {

/// Sums are in units of 2^-32 paths, so that their order does not matter.
class LightTally {
public:
    using OfBands = std::array<std::uint64_t, most_bands>;
    /// Where light begins and ends but for organs. Nearly every path adds to it, so each thread has its own.
    struct Ends {
        OfBands brought{}, soil{}, solids{}, escaped{};

        void add(const Ends& other);
    };

    /// `cells`: of all sensors.
    LightTally(std::size_t bands, std::size_t cells) : bands_(bands) { through_sensors_.resize(cells * bands); }

    /// All sums are 0 from now on, of so many modules and paths.
    void begin(std::size_t slots, std::uint32_t paths);

    // By any thread:
    void absorb(std::size_t slot, const BandWeights& weights) { add(absorbed_, slot, weights); }
    void meet_front(std::size_t slot, const BandWeights& weights) { add(front_, slot, weights); }
    void meet_back(std::size_t slot, const BandWeights& weights) { add(back_, slot, weights); }
    void pass_cell(std::size_t cell, const BandWeights& weights) { add(through_sensors_, cell, weights); }
    /// Light that nothing has scattered before, in PAR.
    void meet_first(std::size_t slot, const LightPath& path);
    void add(OfBands& sums, const BandWeights& weights) const;
    void take(OfBands& sums, const BandWeights& weights) const;

    /// By one thread at a time.
    void add(const Ends& ends) { ends_.add(ends); }

    /// Light that has come straight to a module, of which `kept` is absorbed. By one thread for each slot: these sums
    /// need no units.
    void meet_directly(std::size_t slot, const LightPath& path, bool on_back, const BandWeights& kept);

    // Shares of the light of all paths:
    double absorbed(std::size_t slot, std::size_t band) const {
        return share(absorbed_[slot * bands_ + band], direct(slot)[3 * band + 2]);
    }
    double front(std::size_t slot, std::size_t band) const {
        return share(front_[slot * bands_ + band], direct(slot)[3 * band]);
    }
    double back(std::size_t slot, std::size_t band) const {
        return share(back_[slot * bands_ + band], direct(slot)[3 * band + 1]);
    }
    double passed(std::size_t cell, std::size_t band) const { return share(through_sensors_[cell * bands_ + band]); }
    double sun(std::size_t slot) const { return share(sun_[slot], direct(slot)[3 * bands_]); }
    glm::dvec3 towards(std::size_t slot) const;
    double ended(OfBands Ends::*where, std::size_t band) const { return share((ends_.*where)[band]); }

private:
    using Sums = std::vector<std::uint64_t>;

    double share(std::uint64_t sum, double direct = 0) const {
        return (static_cast<double>(static_cast<std::int64_t>(sum)) * 0x1p-32 + direct) / paths_;
    }
    void add(Sums& sums, std::size_t slot, const BandWeights& weights) const;
    std::size_t of_slot() const { return 3 * bands_ + 4; }
    const double* direct(std::size_t slot) const { return &direct_[slot * of_slot()]; }

    std::size_t bands_;
    std::uint32_t paths_ = 1;
    std::vector<double> direct_;  ///< of each slot: front, back, absorbed by band; sun, towards
    Sums absorbed_, front_, back_, sun_, towards_, through_sensors_;
    Ends ends_;
};

}  // namespace espalier::environment
