// The organs of one frame by number: what the points of a scan and the pixels of a picture are labelled with.
#pragma once

#include "espalier/base/random.h"
#include "espalier/geometry/frame_geometry.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace espalier::archive {

struct FrameOrgan {
    std::uint32_t plant = 0;
    std::uint64_t identity = 0;
    std::uint16_t symbol = 0, order = 0;  ///< the symbol as the frame numbers it
    std::int32_t birth = 0;               ///< step
    bool is_leaf = false;                 ///< a polygon, patch or other surface; else a piece of an axis
};

/// All that one module draws of axes is an organ, and all that it draws of surfaces another. Axes come first, in the
/// order of internodes_of(), then outlines and surfaces in the order of their cells.
class FrameOrgans {
public:
    explicit FrameOrgans(const FrameGeometry& geometry);

    const std::vector<FrameOrgan>& all() const { return organs_; }
    /// The number of the organ behind a row of `of_points` or of `of_cells`; none: of what is not drawn.
    std::optional<std::uint32_t> of_point(std::size_t row) const;
    std::optional<std::uint32_t> of_cell(std::size_t row) const;

private:
    void add(const FrameAttributes& of, std::size_t row, bool is_leaf);
    std::optional<std::uint32_t> find(const FrameAttributes& of, std::size_t row, bool is_leaf) const;

    const FrameGeometry& geometry_;
    std::vector<FrameOrgan> organs_;
    struct Key {
        std::uint64_t identity;
        std::uint32_t plant;
        bool is_leaf;
        bool operator==(const Key&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Key& key) const {
            return mix(key.identity, 2 * std::uint64_t{key.plant} + key.is_leaf);
        }
    };
    std::unordered_map<Key, std::uint32_t, Hash> numbers_;
};

/// A table with a row for each organ: its number, plant, identity, symbol, order, birth and age (steps), and whether it
/// is a leaf. `plants`: their names by number. `pixels`: how many show it, by organ; empty: no such column.
std::string organ_table(const FrameOrgans& organs, const std::vector<std::string>& symbols,
                        const std::vector<std::string>& plants, int step, const std::vector<std::size_t>& pixels = {});

}  // namespace espalier::archive
