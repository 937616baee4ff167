#include "timeline/files/collection_file.h"

#include "espalier/base/error.h"

#include "catch.h"
#include "small_disk.h"
#include "timeline/collections.h"
#include "timeline/frames.h"

#include <fmt/format.h>

#include <sys/stat.h>
#include <utility>

using namespace espalier;
using namespace espalier::timeline;

namespace {

ino_t file_number(const std::filesystem::path& path) {
    struct stat status = {};
    REQUIRE(::stat(path.c_str(), &status) == 0);
    return status.st_ino;
}

}  // namespace

TEST_CASE("an index is whole after every frame, and seldom written anew", "[timeline]") {
    const RunFolder folder;
    std::filesystem::create_directories(folder.path);
    const std::filesystem::path path = folder.path / "plants.pvd";
    CollectionFile collection(path);
    int written_anew = 0;
    ino_t last = 0;
    for (int step = 0; step < 400; ++step) {
        collection.add(0.1 * step, 0, "plants", fmt::format("plants/{:04}.vtp", step));
        collection.add(0.1 * step, 1, "a & b", fmt::format("plants/{:04}.vtp", step));
        collection.write();
        const std::vector<DataSetEntry> entries = read_collection(path);
        REQUIRE(entries.size() == 2 * static_cast<std::size_t>(step) + 2);
        CHECK(entries.back().name == "a & b");
        CHECK(entries.back().file == fmt::format("plants/{:04}.vtp", step));
        written_anew += file_number(path) != std::exchange(last, file_number(path));
    }
    const auto pages = static_cast<int>(std::filesystem::file_size(path) / 4096) + 1;
    CHECK(written_anew <= 2 * pages);
}

TEST_CASE("an index that finds no room for a frame stays as it was, and goes on when there is room", "[timeline]") {
    const RunFolder folder;
    std::filesystem::create_directories(folder.path);
    const std::filesystem::path path = folder.path / "plants.pvd";
    CollectionFile collection(path);
    collection.add(0, 0, "plants", "plants/0000.vtp");
    collection.write();
    collection.add(1, 0, "plants", "plants/0001.vtp");
    {
        const SmallDisk disk(std::filesystem::file_size(path) + 30);
        CHECK_THROWS_AS(collection.write(), RunError);
        CHECK(read_collection(path).size() == 1);
    }
    collection.write();
    CHECK(read_collection(path).size() == 2);
}
