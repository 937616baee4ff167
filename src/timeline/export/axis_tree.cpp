#include "timeline/export/axis_tree.h"

namespace espalier {

std::vector<std::uint32_t> AxisTree::trunks() const {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < axes.size(); ++i) {
        if (axes[i].bearer == RecordedInternode::none) result.push_back(i);
    }
    return result;
}

AxisTree axis_tree(const RecordedGeometry& geometry, const ExportOptions& options) {
    AxisTree tree;
    std::vector<std::int32_t> number(geometry.lines.connectivity.size(), RecordedInternode::none);
    const std::vector<RecordedInternode> all = internodes_of(geometry);
    for (std::size_t i = 0; i < all.size(); ++i) {
        RecordedInternode internode = all[i];
        if (options.plant && internode.plant != *options.plant) continue;
        const auto here = static_cast<std::uint32_t>(tree.internodes.size());
        number[i] = static_cast<std::int32_t>(here);
        if (internode.bearer >= 0) internode.bearer = number[static_cast<std::size_t>(internode.bearer)];
        const bool begins = tree.axes.empty() || tree.internodes.back().axis != internode.axis;
        if (begins) {
            tree.axes.push_back({internode.plant, here, here, internode.bearer});
            if (internode.bearer >= 0) {
                tree.axes_borne[static_cast<std::size_t>(internode.bearer)].push_back(
                    static_cast<std::uint32_t>(tree.axes.size() - 1));
            }
        }
        tree.axes.back().end = here + 1;
        tree.internodes.push_back(internode);
        tree.axes_borne.emplace_back();
    }
    return tree;
}

}  // namespace espalier
