#include "turtle/foliage/leaf_shapes.h"

#include <utility>

namespace espalier::turtle {
namespace {

/// The first that no view file can name: behind the last code point.
constexpr std::uint32_t first_id = 0x110000;

}  // namespace

LeafShapeAdder::LeafShapeAdder(std::optional<Surface> surface, std::filesystem::path texture)
    : surface_(std::move(surface)), texture_(std::move(texture)) {}

LeafShapes LeafShapeAdder::to(const std::shared_ptr<const Shapes>& before) const {
    const std::lock_guard lock(mutex_);
    if (last_ && last_->before == before) return *last_;
    LeafShapes leaf{before, before};
    if (surface_ || !texture_.empty()) {
        auto shapes = before ? std::make_shared<Shapes>(*before) : std::make_shared<Shapes>();
        if (surface_) {
            leaf.surface = first_id;
            while (shapes->surfaces.contains(leaf.surface)) ++leaf.surface;
            shapes->surfaces.emplace(leaf.surface, *surface_);
        }
        if (!texture_.empty()) {
            shapes->textures.push_back({texture_});
            leaf.texture = static_cast<std::uint16_t>(shapes->textures.size());
        }
        leaf.with = std::move(shapes);
    }
    last_ = leaf;
    return leaf;
}

}  // namespace espalier::turtle
