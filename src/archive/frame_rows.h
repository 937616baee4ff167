// What a frame holds as the rows of a table: internodes, organs and answered queries.
#pragma once

#include "espalier/archive/recorded_run.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>

namespace espalier::archive {

struct FrameRow {
    enum class What : std::uint8_t { internode, organ, query };

    What what;
    const FrameAttributes& of;  ///< whose row `attributes` tells plant, symbol, identity, ...
    std::size_t attributes;
    std::size_t point;  ///< whose parameters it has
    glm::vec3 base,
        end{std::nanf("")};  ///< of an organ its first corner, and the farthest from there; of a query its place
    double length = std::nan(""), radius = std::nan("");  ///< m
    double area = std::nan("");                           ///< m2; of an organ one side
    double volume = std::nan("");                         ///< m3
};

/// "internode", "organ", "query".
const char* name_of(FrameRow::What what);

/// Internodes axis after axis, then organs, then queries. Neighbouring polygons of one module are one organ. `run` is
/// the folder whence textures are found.
void for_each_row(const FrameGeometry& geometry, const std::filesystem::path& run,
                  const std::function<void(const FrameRow&)>& visit);

}  // namespace espalier::archive
