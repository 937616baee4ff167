#include "geometry/grids/vdb_tree.h"

#include <fmt/format.h>
#include <openvdb/io/Compression.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <map>
#include <vector>

namespace espalier::geometry {
namespace {

constexpr unsigned upper = 5, lower = 4, leaf = 3;  ///< binary logarithms of their edges in values of their own
constexpr std::int32_t root_edge = 1 << (upper + lower + leaf);
constexpr std::int32_t farthest = 1 << 30;  ///< voxels; boxes of more cannot be counted in 32 bits

template <unsigned edge>
using Mask = std::array<std::uint64_t, (1u << (3 * edge)) / 64>;

using Origin = std::array<std::int32_t, 3>;

class Walk {
public:
    Walk(VdbBytes& file, const VdbTree& tree) : file_(file), tree_(tree) {}

    void tree() {
        if (file_.get<std::int32_t>() != 1) throw VdbError("a tree in it has several buffers");
        file_.skip(tree_.value);  // the background
        const auto tiles = file_.get<std::uint32_t>(), children = file_.get<std::uint32_t>();
        for (std::uint32_t i = 0; i < tiles; ++i) tile();
        for (std::uint32_t i = 0; i < children; ++i) child();
        // The values come in the order of the places, whatever that of the nodes was.
        for (const auto& [place, leaves] : leaves_below_) {
            for (std::size_t i = leaves.first; i < leaves.end; ++i) values_of(masks_[i]);
        }
    }

private:
    struct Leaves {
        std::size_t first, end;
    };

    void hold(std::uint64_t bytes) {
        held_ += bytes;
        if (held_ <= tree_.memory) return;
        throw VdbError(
            fmt::format("a grid in it takes more than {:.3g} GB of memory", static_cast<double>(tree_.memory) / 1e9));
    }

    Origin origin() {
        Origin place{};
        for (std::int32_t& at : place) at = file_.get<std::int32_t>();
        const bool is_right = std::all_of(place.begin(), place.end(), [](std::int32_t at) {
            return at % root_edge == 0 && at >= -farthest && at < farthest;
        });
        if (!is_right || leaves_below_.contains(place)) throw VdbError("a node in it lies where there can be none");
        return place;
    }

    void tile() {
        hold(sizeof(void*) * 8 + tree_.value);
        leaves_below_[origin()] = {0, 0};
        file_.skip(tree_.value);
        if (file_.get<std::uint8_t>() > 1) throw VdbError("a tile in it is neither active nor inactive");
    }

    void child() {
        const Origin place = origin();
        const std::size_t first = masks_.size();
        node<upper>();
        leaves_below_[place] = {first, masks_.size()};
    }

    template <unsigned edge>
    Mask<edge> mask() {
        Mask<edge> bits;
        file_.take(bits.data(), sizeof bits);
        return bits;
    }

    template <unsigned edge>
    static std::uint64_t count(const Mask<edge>& bits) {
        std::uint64_t count = 0;
        for (const std::uint64_t word : bits) count += static_cast<std::uint64_t>(std::popcount(word));
        return count;
    }

    template <unsigned edge>
    void node() {
        const auto children = mask<edge>(), active = mask<edge>();
        for (std::size_t i = 0; i < children.size(); ++i) {
            if (children[i] & active[i]) throw VdbError("a node in it is a value as well");
        }
        constexpr std::uint64_t places = std::uint64_t{1} << (3 * edge);
        hold(places * std::max<std::uint64_t>(tree_.value, sizeof(void*)));
        values(places, count<edge>(active));
        for (std::uint64_t i = count<edge>(children); i > 0; --i) {
            if constexpr (edge == upper) {
                node<lower>();
            } else {
                hold((std::uint64_t{1} << (3 * leaf)) * tree_.value + sizeof(Mask<leaf>));
                masks_.push_back(mask<leaf>());
            }
        }
    }

    void values_of(const Mask<leaf>& active) {
        if (mask<leaf>() != active) throw VdbError("two masks of a node in it differ");
        values(std::uint64_t{1} << (3 * leaf), count<leaf>(active));
    }

    /// As openvdb::io::readCompressedValues() reads them.
    void values(std::uint64_t places, std::uint64_t active) {
        using namespace openvdb::io;
        const int kind = file_.get<std::int8_t>();
        if (kind < NO_MASK_OR_INACTIVE_VALS || kind > NO_MASK_AND_ALL_VALS) {
            throw VdbError("values in it are stored in no way that there is");
        }
        const bool has_two = kind == MASK_AND_TWO_INACTIVE_VALS;
        const bool has_one = kind == NO_MASK_AND_ONE_INACTIVE_VAL || kind == MASK_AND_ONE_INACTIVE_VAL;
        const bool has_mask = kind == MASK_AND_NO_INACTIVE_VALS || kind == MASK_AND_ONE_INACTIVE_VAL || has_two;
        file_.skip((has_two ? 2 : has_one ? 1 : 0) * tree_.value + (has_mask ? places / 8 : 0));
        const bool active_only = (tree_.compression & COMPRESS_ACTIVE_MASK) && kind != NO_MASK_AND_ALL_VALS;
        const std::uint64_t stored = active_only ? active : places;
        if (tree_.is_half && stored == 0) return;
        block(stored * (tree_.is_half ? tree_.half : tree_.value));
    }

    /// As bloscFromStream() and unzipFromStream() read it.
    void block(std::uint64_t bytes) {
        using namespace openvdb::io;
        if (!(tree_.compression & (COMPRESS_BLOSC | COMPRESS_ZIP))) return file_.skip(bytes);
        const auto packed = file_.get<std::int64_t>();
        if (packed <= 0) {
            if (packed != -static_cast<std::int64_t>(bytes))
                throw VdbError("a block in it has another size than it says");
            return file_.skip(bytes);
        }
        const auto length = static_cast<std::uint64_t>(packed);
        file_.require(length);
        if (!(tree_.compression & COMPRESS_BLOSC)) return file_.skip(length);
        require_blosc(length, bytes);
    }

    // Blosc takes the length of what it unpacks from the block itself.
    void require_blosc(std::uint64_t length, std::uint64_t bytes) {
        struct Header {
            std::uint8_t version, version_of_packer, flags, type_size;
            std::uint32_t bytes, block, length;
        };
        static_assert(sizeof(Header) == 16);
        if (length < sizeof(Header)) throw VdbError("a block in it has another size than it says");
        const auto header = file_.get<Header>();
        if (header.length != length || header.bytes != bytes) {
            throw VdbError("a block in it has another size than it says");
        }
        file_.skip(length - sizeof(Header));
    }

    VdbBytes& file_;
    const VdbTree& tree_;
    std::uint64_t held_ = 0;
    std::vector<Mask<leaf>> masks_;
    std::map<Origin, Leaves> leaves_below_;  ///< of the nodes below the root
};

}  // namespace

void require_whole(VdbBytes& file, const VdbTree& tree) {
    Walk(file, tree).tree();
}

}  // namespace espalier::geometry
