#include "base/folder.h"

#include "catch.h"
#include "temporary_folder.h"

using namespace espalier;
using Catch::Contains;
namespace fs = std::filesystem;

TEST_CASE("what lies below a folder is told whatever links lead there or out", "[base]") {
    const TemporaryFolder place;
    const fs::path inside = fs::canonical(place.path()) / "inside", outside = fs::canonical(place.path()) / "outside";
    fs::create_directories(inside);
    fs::create_directories(outside);
    fs::create_directory_symlink(inside, outside / "in");
    fs::create_directory_symlink(outside, inside / "out");
    std::error_code error;
    CHECK(resolved_below(inside, inside, error) == inside);
    CHECK(resolved_below(inside / "no" / ".." / "file", inside, error) == inside / "file");
    CHECK(resolved_below(outside / "in" / "file", inside, error) == inside / "file");
    CHECK(resolved_below(inside / "file", outside / "in", error) == inside / "file");
    CHECK(resolved_below(inside / "out" / "file", inside, error).empty());
    CHECK(resolved_below(inside / ".." / "outside", inside, error).empty());
    CHECK(resolved_below(fs::path(inside.string() + "-too"), inside, error).empty());
    CHECK(resolved_below("nowhere/file", fs::current_path() / "nowhere", error) == fs::current_path() / "nowhere/file");
    CHECK_FALSE(error);
    fs::create_symlink(outside / "new", inside / "dangling");
    CHECK(resolved_below(inside / "dangling", inside, error).empty());
    CHECK(resolved_below(inside / "dangling" / "file", inside, error).empty());
    CHECK_FALSE(error);
    fs::create_symlink(inside / "loop", inside / "loop");
    CHECK(resolved_below(inside / "loop" / "file", inside, error).empty());
    CHECK(error == std::errc::too_many_symbolic_link_levels);
}

TEST_CASE("folders are made below another that may be a link, but through no link below it", "[base]") {
    const TemporaryFolder place;
    const fs::path inside = place.path() / "inside", outside = place.path() / "outside";
    fs::create_directories(inside / "plants");
    fs::create_directories(outside);
    fs::create_directory_symlink(inside, place.path() / "run");
    make_folder_below(place.path() / "run", "fields/light");
    CHECK(fs::is_directory(inside / "fields/light"));
    fs::create_directory_symlink(outside, inside / "fields/water");
    CHECK_THROWS_WITH(make_folder_below(inside, "fields/water"), Contains("water is a link, which is not followed"));
    CHECK_THROWS_WITH(make_folder_below(inside, "fields/water/deep"), Contains("water is a link"));
    CHECK(fs::is_empty(outside));
    CHECK(is_folder_itself(inside / "plants"));
    CHECK_FALSE(is_folder_itself(inside / "fields/water"));
    CHECK_FALSE(is_folder_itself(inside / "none"));
}
