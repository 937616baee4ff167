#include "archive/frame_organs.h"

#include "base/csv_file.h"

#include <fmt/format.h>

namespace espalier::archive {

FrameOrgans::FrameOrgans(const FrameGeometry& geometry) : geometry_(geometry) {
    for (const FrameInternode& internode : internodes_of(geometry)) {
        add(geometry.of_points, internode.tip_point.row(), false);
    }
    for (std::size_t line = 0; line < geometry.lines.size(); ++line) {
        const std::size_t row = geometry.lines.first + line;
        if (geometry.of_cells.kinds[row] != Kind::axis) add(geometry.of_cells, row, true);
    }
    for (std::size_t cell = 0; cell < geometry.polygons.size(); ++cell) {
        add(geometry.of_cells, geometry.polygons.first + cell, true);
    }
}

void FrameOrgans::add(const FrameAttributes& of, std::size_t row, bool is_leaf) {
    const auto number = static_cast<std::uint32_t>(organs_.size());
    const auto [at, is_new] = numbers_.try_emplace({of.identities[row], of.plants[row], is_leaf}, number);
    if (!is_new) return;
    organs_.push_back({of.plants[row], of.identities[row], of.symbols[row], of.orders[row], of.births[row], is_leaf});
}

std::optional<std::uint32_t> FrameOrgans::find(const FrameAttributes& of, std::size_t row, bool is_leaf) const {
    const auto found = numbers_.find({of.identities[row], of.plants[row], is_leaf});
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::uint32_t> FrameOrgans::of_point(std::size_t row) const {
    const auto axis = find(geometry_.of_points, row, false);
    return axis ? axis : find(geometry_.of_points, row, true);  // of an outline
}

std::optional<std::uint32_t> FrameOrgans::of_cell(std::size_t row) const {
    return find(geometry_.of_cells, row, true);
}

std::string organ_table(const FrameOrgans& organs, const std::vector<std::string>& symbols,
                        const std::vector<std::string>& plants, int step, const std::vector<std::size_t>& pixels) {
    std::string text = "organ,plant,name,identity,symbol_number,symbol,order,birth,age,leaf";
    text += pixels.empty() ? "\n" : ",pixels\n";
    for (std::size_t i = 0; i < organs.all().size(); ++i) {
        const FrameOrgan& organ = organs.all()[i];
        text += fmt::format("{},{},{},{},{},{},{},{},{},{}", i, organ.plant, csv_text(plants.at(organ.plant)),
                            organ.identity, organ.symbol, csv_text(symbols.at(organ.symbol)), organ.order, organ.birth,
                            step - organ.birth, organ.is_leaf ? 1 : 0);
        if (!pixels.empty()) text += fmt::format(",{}", pixels[i]);
        text += '\n';
    }
    return text;
}

}  // namespace espalier::archive
