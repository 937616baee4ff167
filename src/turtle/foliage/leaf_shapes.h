// What leaves look like, added to the shapes of a plant's view file.
#pragma once

#include "espalier/geometry/shapes.h"

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>

namespace espalier::turtle {

/// A plant's shapes with those of its leaves, and where these stand among them.
struct LeafShapes {
    std::shared_ptr<const Shapes> before, with;
    std::uint32_t surface = 0;  ///< 0: none was added
    std::uint16_t texture = 0;  ///< 0: none was added
};

/// Adds one surface and one texture to whatever shapes a plant has. The same shapes give the same object, because
/// recorders know shapes by their address. Thread safe.
class LeafShapeAdder {
public:
    LeafShapeAdder(std::optional<Surface> surface, std::filesystem::path texture);

    LeafShapes to(const std::shared_ptr<const Shapes>& before) const;

private:
    std::optional<Surface> surface_;
    std::filesystem::path texture_;
    mutable std::mutex mutex_;
    mutable std::optional<LeafShapes> last_;
};

}  // namespace espalier::turtle
