#include "geometry/grid_operations.h"

#include "espalier/base/error.h"

#include "base/platform.h"

#include <fmt/format.h>

#include <atomic>

namespace espalier::geometry {
namespace {

constinit std::atomic<const GridOperations*> known = nullptr;

/// Beside the library that this is part of, or the program, in which it may be, too.
void open_beside() {
    const std::filesystem::path file = platform::file_of(&grid_operations).parent_path() / ESPALIER_GRID_LIBRARY;
    std::string why;
    if (!platform::open_library(file, /*shared=*/true, why)) throw RunError("cannot open " + why);
    if (!known) throw RunError(fmt::format("{} is of another version", file.string()));
}

}  // namespace

void open_grid_library() {
    if (known) return;
    static const bool opened = (open_beside(), true);
    static_cast<void>(opened);
}

const GridOperations& grid_operations() {
    open_grid_library();
    return *known;
}

GridLibrary::GridLibrary(const GridOperations& operations) {
    known = &operations;
}

}  // namespace espalier::geometry
