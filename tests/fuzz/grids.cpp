// Any bytes as a .vdb file of a recorded run: a field, or words.
#include "espalier/base/error.h"
#include "espalier/geometry/field.h"
#include "espalier/geometry/openvdb_grid.h"

#include "../temporary_folder.h"
#include "archive/field_reader.h"
#include "geometry/grids/grid_file.h"
#include "seeds_on_request.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>

namespace {

using namespace espalier;

constexpr std::size_t longest = 1 << 16;

/// Written as a run writes it, with voxels in a box of so many.
std::string written(const TemporaryFolder& folder, int voxels, bool has_tile) {
    initialize_openvdb();
    auto held = std::make_shared<FieldGrid>();
    held->grid = openvdb::FloatGrid::create(0.5F);
    auto accessor = held->grid->getAccessor();
    for (int i = 0; i < voxels; ++i) accessor.setValue({i % 17, i / 17 % 17 - 3, i / 289}, std::sin(float(i)));
    if (has_tile) held->grid->tree().addTile(1, {64, 64, 64}, 2, true);
    held->box = held->grid->evalActiveVoxelBoundingBox();
    geometry::write_vdb(folder.path() / "seed.vdb", {"light", "1", "light", held});
    return text_of(folder.path() / "seed.vdb");
}

void attempt(const std::function<void()>& read) {
    try {
        read();
    } catch (const UserError&) {
    } catch (const RunError&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    write_seeds_if_asked([](const auto& write) {
        const TemporaryFolder folder;
        for (const int voxels : {0, 1, 300}) write(std::to_string(voxels), written(folder, voxels, voxels == 1));
    });
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const TemporaryFolder folder;
    if (size > longest) return 0;
    const auto file = folder.write("a.vdb", std::string(reinterpret_cast<const char*>(data), size));
    attempt([&] { archive::read_field(file, "light"); });
    attempt([&] { archive::read_grid(file, "light"); });
    return 0;
}
