#include "base/scratch_file.h"

#include "espalier/base/error.h"

#include "base/parallel.h"
#include "catch.h"
#include "small_disk.h"
#include "temporary_folder.h"

#include <algorithm>
#include <string>
#include <vector>

using namespace espalier;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// Of another length and other letters for each number; some are longer than what is kept back before it is written.
std::string piece(std::size_t number) {
    const std::size_t size = number % 50 == 7 ? 300'000 + number : number * number % 20'011;
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(number * 31 + i * 7 + i / 251);
    return bytes;
}

}  // namespace

TEST_CASE("what several threads put into a scratch file is read as it was", "[base]") {
    const TemporaryFolder folder;
    ScratchFile file(folder.path());
    for (const bool is_cleared : {false, true}) {
        if (is_cleared) file.clear();
        CHECK(file.size() == 0);
        std::vector<std::uint64_t> places(400);
        std::vector<char> same(places.size());
        for_in_parallel(std::size_t{0}, places.size(), [&](std::size_t i) { places[i] = file.append(piece(i)); });
        for_in_parallel(std::size_t{0}, places.size(), [&](std::size_t i) {
            const std::string written = piece(i);
            same[i] = file.read(places[i], written.size()) == written;
        });
        CHECK(std::count(same.begin(), same.end(), char{1}) == 400);
    }
}

TEST_CASE("what was put into a scratch file after it was read lies behind that", "[base]") {
    const TemporaryFolder folder;
    ScratchFile file(folder.path());
    const std::uint64_t first = file.append("one");
    CHECK(file.read(first, 3) == "one");
    const std::uint64_t second = file.append(""), third = file.append("three");
    CHECK((first == 0 && second == 3 && third == 3 && file.size() == 8));
    CHECK(file.read(second, 0).empty());
    CHECK(file.read(first, 8) == "onethree");
    CHECK_THROWS_WITH(file.read(third, 6), Contains("cannot read a file for what waits on disk in"));
}

TEST_CASE("a scratch file tells that the disk is full, and leaves nothing in its folder", "[base]") {
    const TemporaryFolder folder;
    {
        ScratchFile file(folder.path());
        const SmallDisk disk(100'000);
        CHECK_THROWS_WITH(file.append(std::string(500'000, 'x')),
                          Contains("cannot write a file for what waits on disk"));
        file.append("kept back");
        CHECK_THROWS_AS(file.read(0, 500'000), RunError);
    }
    CHECK(fs::is_empty(folder.path()));
    CHECK_THROWS_WITH(ScratchFile(folder.path() / "missing"), Contains("cannot make a file"));
}
