#include "archive/joined_pieces.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace espalier::archive {
namespace {

template <class Column>
void append(Column& to, const Column& from, std::size_t first, std::size_t count) {
    const auto begin = from.begin() + static_cast<std::ptrdiff_t>(first);
    to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
}

/// A column that some pieces lack, as it would be if they had it.
template <class Column>
void append_or_fill(Column& to, std::size_t rows_before, const Column& from, std::size_t first, std::size_t count,
                    typename Column::value_type missing) {
    if (from.empty() && to.empty()) return;
    to.resize(rows_before, missing);
    if (from.empty())
        to.resize(rows_before + count, missing);
    else
        append(to, from, first, count);
}

void append(FrameAttributes& to, FrameAttributes& from, std::size_t first, std::size_t count) {
    const std::size_t before = to.size();
    append_or_fill(to.rgb, before, from.rgb, first, count, {});
    append_or_fill(to.organs, before, from.organs, first, count, 0);
    append(to.identities, from.identities, first, count);
    append(to.parents, from.parents, first, count);
    append(to.plants, from.plants, first, count);
    append(to.symbols, from.symbols, first, count);
    append(to.births, from.births, first, count);
    append(to.orders, from.orders, first, count);
    append(to.colours, from.colours, first, count);
    append(to.kinds, from.kinds, first, count);
}

void append_points(FrameGeometry& to, FrameGeometry& from) {
    const std::size_t before = to.points.size(), count = from.points.size();
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    append(to.points, from.points, 0, count);
    append(to.normals, from.normals, 0, count);
    append(to.uvs, from.uvs, 0, count);
    append(to.radii, from.radii, 0, count);
    append_or_fill(to.pixels, before, from.pixels, 0, count, 0);
    append(to.of_points, from.of_points, 0, count);
    for (const auto& parameter : from.parameters) to.parameters[parameter.first].resize(before, none);
    for (auto& [name, column] : to.parameters) {
        const auto found = from.parameters.find(name);
        if (found == from.parameters.end())
            column.resize(before + count, none);
        else
            append(column, found->second, 0, count);
    }
}

/// The cells of one kind, of all pieces; `firsts`: their first points in the whole.
void append_cells(FrameGeometry& to, std::vector<FrameGeometry>& pieces, const std::vector<std::int32_t>& firsts,
                  FrameCells FrameGeometry::*kind) {
    FrameCells& cells = to.*kind;
    cells.first = to.of_cells.size();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        FrameGeometry& piece = pieces[i];
        const FrameCells& from = piece.*kind;
        const auto corners = static_cast<std::int32_t>(cells.connectivity.size());
        for (const std::int32_t point : from.connectivity) cells.connectivity.push_back(firsts[i] + point);
        for (std::size_t cell = 1; cell <= from.size(); ++cell) cells.offsets.push_back(corners + from.offsets[cell]);
        append(to.of_cells, piece.of_cells, from.first, from.size());
        append(to.textures, piece.textures, from.first, from.size());
        append(to.back_colours, piece.back_colours, from.first, from.size());
    }
}

std::vector<std::int32_t> first_points(const std::vector<FrameGeometry>& pieces) {
    std::vector<std::int32_t> firsts;
    std::size_t points = 0, corners = 0;
    for (const FrameGeometry& piece : pieces) {
        firsts.push_back(static_cast<std::int32_t>(points));
        points += piece.points.size();
        corners += piece.lines.connectivity.size() + piece.polygons.connectivity.size();
        if (std::max(points, corners) > std::size_t{std::numeric_limits<std::int32_t>::max()}) {
            throw UserError(
                fmt::format("a frame of more than {} points does not fit; look at a piece of it, as "
                            "the files that plants.pvd names",
                            std::numeric_limits<std::int32_t>::max()));
        }
    }
    return firsts;
}

}  // namespace

FrameGeometry joined(std::vector<FrameGeometry> pieces) {
    if (pieces.size() == 1) return std::move(pieces.front());
    FrameGeometry all;
    const std::vector<std::int32_t> firsts = first_points(pieces);
    for (FrameGeometry& piece : pieces) {
        append_points(all, piece);
        all.units.insert(piece.units.begin(), piece.units.end());
        all.label_texts.insert(all.label_texts.end(), piece.label_texts.begin(), piece.label_texts.end());
    }
    append_cells(all, pieces, firsts, &FrameGeometry::vertices);
    append_cells(all, pieces, firsts, &FrameGeometry::lines);
    append_cells(all, pieces, firsts, &FrameGeometry::polygons);
    all.symbol_names = std::move(pieces.back().symbol_names);
    all.texture_files = std::move(pieces.back().texture_files);
    return all;
}

}  // namespace espalier::archive
