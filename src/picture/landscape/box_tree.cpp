#include "picture/landscape/box_tree.h"

#include <algorithm>
#include <numeric>

namespace espalier::picture {
namespace {

constexpr std::size_t bins = 16;
constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

glm::vec3 centre_of(const RayBox& box) {
    return 0.5F * (box.lower + box.upper);
}

int longest_axis(const RayBox& box) {
    const glm::vec3 size = box.upper - box.lower;
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
}

struct Bin {
    RayBox box;
    std::size_t count = 0;
};

/// Behind which bin a split costs least.
std::size_t best_split(const std::array<Bin, bins>& all) {
    std::array<float, bins> before{}, behind{};
    const auto cost = [](const RayBox& box, std::size_t count) {
        return count == 0 ? 0.0F : box.area() * static_cast<float>(count);
    };
    RayBox box;
    std::size_t count = 0;
    for (std::size_t i = 0; i < bins; ++i) {
        box.add(all[i].box);
        before[i] = cost(box, count += all[i].count);
    }
    box = {};
    count = 0;
    for (std::size_t i = bins; i-- > 1;) {
        box.add(all[i].box);
        behind[i - 1] = cost(box, count += all[i].count);
    }
    std::size_t best = 0;
    for (std::size_t i = 1; i + 1 < bins; ++i) {
        if (before[i] + behind[i] < before[best] + behind[best]) best = i;
    }
    return best;
}

}  // namespace

BoxTree::BoxTree(std::span<const RayBox> boxes) : items_(boxes.size()) {
    std::iota(items_.begin(), items_.end(), 0U);
    std::vector<Part> parts;
    if (!boxes.empty()) parts.push_back({0, boxes.size(), none});
    while (!parts.empty()) {
        const Part part = parts.back();
        parts.pop_back();
        const std::size_t number = nodes_.size();
        if (part.node != none) nodes_[part.node].first = static_cast<std::uint32_t>(number);
        Node node{{}, static_cast<std::uint32_t>(part.first), static_cast<std::uint32_t>(part.last - part.first)};
        RayBox centres;
        for (std::size_t i = part.first; i < part.last; ++i) {
            node.box.add(boxes[items_[i]]);
            centres.add(centre_of(boxes[items_[i]]));
        }
        if (node.count > most_of_leaf) {
            const std::size_t middle = split(boxes, part.first, part.last, centres);
            node.count = 0;
            parts.push_back({middle, part.last, number});
            parts.push_back({part.first, middle, none});
        }
        nodes_.push_back(node);
    }
}

// Halves what the heuristic would leave nearly whole, so that the depth is bounded.
std::size_t BoxTree::split(std::span<const RayBox> boxes, std::size_t first, std::size_t last, const RayBox& centres) {
    const int axis = longest_axis(centres);
    const float low = centres.lower[axis], length = centres.upper[axis] - low;
    const auto begin = items_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = items_.begin() + static_cast<std::ptrdiff_t>(last);
    if (length > 0) {
        const auto bin_of = [&](std::uint32_t item) {
            const float share = (centre_of(boxes[item])[axis] - low) / length;
            return share < 1 ? static_cast<std::size_t>(std::max(share, 0.0F) * bins) : bins - 1;
        };
        std::array<Bin, bins> all;
        for (auto item = begin; item != end; ++item) {
            Bin& bin = all[bin_of(*item)];
            bin.box.add(boxes[*item]);
            ++bin.count;
        }
        const std::size_t best = best_split(all);
        const auto middle = std::partition(begin, end, [&](std::uint32_t item) { return bin_of(item) <= best; });
        const auto smaller = std::min(middle - begin, end - middle);
        if (8 * smaller >= end - begin) return static_cast<std::size_t>(middle - items_.begin());
    }
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(centre_of(boxes[a])[axis], a) < std::pair(centre_of(boxes[b])[axis], b);
    });
    return static_cast<std::size_t>(middle - items_.begin());
}

}  // namespace espalier::picture
