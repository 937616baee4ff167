// OpenVDB files as our own reader checks them before OpenVDB sees them.
#include "geometry/grids/vdb_file.h"

#include "espalier/geometry/openvdb_grid.h"

#include "catch.h"

#include <openvdb/io/Stream.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

using namespace espalier;
using namespace espalier::geometry;
using Catch::Contains;

namespace {

constexpr std::uint64_t plenty = std::uint64_t{1} << 40;

template <class Grid>
typename Grid::Ptr waves(const std::string& name) {
    using Value = typename Grid::ValueType;
    initialize_openvdb();
    const auto grid = Grid::create(openvdb::zeroVal<Value>());
    grid->setName(name);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    for (int x = -20; x < 20; x += 3) {
        for (int z = 0; z < 5; ++z) {
            grid->tree().setValue({x, 7 * z, z}, Value(static_cast<float>(std::sin(x)) + 2 * z));
        }
    }
    grid->fill(openvdb::CoordBBox({4096, 0, 0}, {4096 + 127, 127, 127}), Value(3));                       // a tile
    grid->fill(openvdb::CoordBBox({-8192, 0, 0}, {-4097, 4095, 4095}), Value(5), false);                  // of the root
    grid->tree().addLeaf(new typename Grid::TreeType::LeafNodeType(openvdb::Coord(40, 0, 0), Value(2)));  // inactive
    return grid;
}

std::string bytes_of(const openvdb::GridCPtrVec& grids, std::uint32_t compression) {
    std::ostringstream out(std::ios::binary);
    openvdb::io::Stream stream(out);
    stream.setCompression(compression);
    stream.write(grids);
    return std::move(out).str();
}

template <class Grid>
typename Grid::Ptr read(const std::string& bytes, const std::string& name, std::uint64_t memory = plenty) {
    std::istringstream in(bytes, std::ios::binary);
    VdbFile file(in, memory);
    return openvdb::gridPtrCast<Grid>(file.read(name));
}

std::string why_not(const std::string& bytes, std::uint64_t memory = plenty) {
    try {
        std::istringstream in(bytes, std::ios::binary);
        VdbFile file(in, memory);
        for (const std::string& name : file.names()) (void)file.read(name);
    } catch (const VdbError& error) {
        return error.what();
    }
    return "";
}

template <class T>
void put_at(std::string& bytes, std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
}

template <class Grid>
void check_same(const Grid& a, const Grid& b) {
    CHECK(a.transform() == b.transform());
    CHECK(a.tree().hasSameTopology(b.tree()));
    CHECK(a.activeVoxelCount() == b.activeVoxelCount());
    for (auto value = a.cbeginValueOn(); value; ++value) REQUIRE(b.tree().getValue(value.getCoord()) == *value);
}

const std::uint32_t compressions[] = {openvdb::io::COMPRESS_NONE, openvdb::io::COMPRESS_ACTIVE_MASK,
                                      openvdb::io::COMPRESS_ACTIVE_MASK | openvdb::io::COMPRESS_ZIP,
                                      openvdb::io::COMPRESS_ACTIVE_MASK | openvdb::io::COMPRESS_BLOSC};

}  // namespace

TEMPLATE_TEST_CASE("grids of all types and compressions are read as they were written", "[geometry][vdb]",
                   openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Vec3SGrid, openvdb::Vec3DGrid) {
    for (const std::uint32_t compression : compressions) {
        const auto first = waves<TestType>("first");
        const auto other = waves<TestType>("other");
        other->setSaveFloatAsHalf(true);
        other->insertMeta("unit", openvdb::StringMetadata("mol"));
        const std::string bytes = bytes_of({first, other}, compression);
        check_same(*first, *read<TestType>(bytes, "first"));
        const auto half = read<TestType>(bytes, "other");
        REQUIRE(half);
        CHECK(half->tree().hasSameTopology(other->tree()));
        CHECK(half->template metaValue<std::string>("unit") == "mol");
    }
}

TEST_CASE("a grid that shares the tree of another is read with it", "[geometry][vdb]") {
    const auto first = waves<openvdb::FloatGrid>("first");
    const openvdb::GridBase::Ptr second = first->copyGrid();  // shares the tree
    second->setName("second");
    second->setTransform(openvdb::math::Transform::createLinearTransform(2));
    const auto read_again = read<openvdb::FloatGrid>(bytes_of({first, second}, compressions[3]), "second");
    REQUIRE(read_again);
    CHECK(read_again->voxelSize().x() == 2);
    CHECK(read_again->tree().hasSameTopology(first->tree()));
}

TEST_CASE("grids of other types may stand in the file and are not read", "[geometry][vdb]") {
    initialize_openvdb();
    const auto mask = openvdb::MaskGrid::create();
    mask->setName("mask");
    std::ostringstream out(std::ios::binary);
    const std::string bytes = bytes_of({waves<openvdb::FloatGrid>("heat")}, compressions[1]);
    CHECK(read<openvdb::FloatGrid>(bytes, "heat"));
    CHECK_THAT(why_not(bytes_of({mask}, compressions[1])), Contains("does not say where a grid of type"));
}

TEST_CASE("a file that ends anywhere before its end is refused", "[geometry][vdb]") {
    for (const std::uint32_t compression : compressions) {
        const std::string bytes = bytes_of({waves<openvdb::FloatGrid>("first")}, compression);
        REQUIRE(why_not(bytes).empty());
        for (std::size_t length = 0; length < bytes.size(); length = length < 500 ? length + 1 : length + 997) {
            INFO(length);
            CHECK_FALSE(why_not(bytes.substr(0, length)).empty());
        }
        CHECK_FALSE(why_not(bytes.substr(0, bytes.size() - 1)).empty());
    }
}

TEST_CASE("lengths that reach one byte behind the end, and formats one too old, are refused", "[geometry][vdb]") {
    const std::string bytes = bytes_of({waves<openvdb::FloatGrid>("first")}, compressions[1]);
    std::string old = bytes, newer = bytes;
    put_at<std::uint32_t>(old, 8, 221);
    put_at<std::uint32_t>(newer, 8, 225);
    CHECK_THAT(why_not(old), Contains("it has format 221; 222 to 224 are read"));
    CHECK_THAT(why_not(newer), Contains("225"));

    const std::size_t name = bytes.find("first"), type = bytes.find("Tree_float");
    REQUIRE(name < type);
    std::string longer = bytes;
    put_at(longer, name - 4, static_cast<std::uint32_t>(bytes.size() - name + 1));
    CHECK_THAT(why_not(longer), Contains("a length in it is wrong"));
}

TEST_CASE("nodes and blocks that a file claims are compared with it", "[geometry][vdb]") {
    const auto grid = waves<openvdb::FloatGrid>("first");
    const std::string bytes = bytes_of({grid}, compressions[0]);
    // Behind the name of its map and that map's numbers, the tree: buffers, background, tiles, children.
    const std::size_t tree = bytes.find("UniformScaleMap") + 15 + 15 * sizeof(double);
    std::uint32_t children = 0;
    std::memcpy(&children, bytes.data() + tree + 12, sizeof children);
    REQUIRE(children == grid->tree().root().childCount());
    std::string more = bytes;
    put_at(more, tree + 12, children + 1);
    CHECK_FALSE(why_not(more).empty());

    // The first child's place: its edge is 4096.
    std::string beside = bytes;
    const std::size_t tiles = 1, tile = 12 + 4 + 1, place = tree + 16 + tiles * tile;
    std::int32_t x = 0;
    std::memcpy(&x, bytes.data() + place, sizeof x);
    put_at(beside, place, x + 1);
    CHECK_THAT(why_not(beside), Contains("lies where there can be none"));
}

TEST_CASE("a grid takes as much memory as it is allowed, and no byte more", "[geometry][vdb]") {
    const auto grid = waves<openvdb::FloatGrid>("first");
    const std::string bytes = bytes_of({grid}, compressions[3]);
    const std::uint64_t leaves = grid->tree().leafCount();
    std::uint64_t low = 0, high = std::uint64_t{1} << 32;
    while (high - low > 1) {
        const std::uint64_t middle = (low + high) / 2;
        (why_not(bytes, middle).empty() ? high : low) = middle;
    }
    CHECK(why_not(bytes, high).empty());
    CHECK_THAT(why_not(bytes, high - 1), Contains("of memory"));
    // What OpenVDB says that it holds is near to it.
    CHECK(double(high) == Approx(double(grid->memUsage())).epsilon(0.1));
    CHECK(leaves * 2048 < high);
}
