#include "archive/meshes/skin.h"

#include "espalier/base/error.h"

namespace espalier::archive {
namespace {

[[noreturn]] void refuse() {
    throw UserError(
        "a page makes no smooth skins, which are level sets of OpenVDB: the program that is installed does");
}

}  // namespace

double skin_voxel(std::span<const AxisLine>, const AxisSkin&) {
    refuse();
}

std::vector<Tube> skin_of(std::span<const AxisLine>, std::span<const int>, const AxisSkin&) {
    refuse();
}

}  // namespace espalier::archive
