#include "espalier/base/read_log.h"

#include "espalier/base/file.h"

#include "catch.h"
#include "temporary_folder.h"

#include <thread>

using Catch::Contains;
using espalier::ReadLog;
namespace fs = std::filesystem;

TEST_CASE("the digest is FNV-1a's", "[base]") {
    // The authors' own test values.
    CHECK(espalier::digest("") == 0xcbf29ce484222325);
    CHECK(espalier::digest("a") == 0xaf63dc4c8601ec8c);
    CHECK(espalier::digest("foobar") == 0x85944171f73967e8);
}

TEST_CASE("a log notes what is read while it lives, once, under one name", "[base]") {
    const TemporaryFolder folder;
    const auto path = folder.write("a.txt", "first");
    espalier::read_text(path);
    const ReadLog log;
    CHECK(log.files().empty());
    espalier::read_text(path);
    folder.write("a.txt", "second");
    espalier::read_text(folder.path() / "." / "a.txt");

    const auto files = log.files();
    REQUIRE(files.size() == 1);
    CHECK(files.begin()->first == path);
    CHECK(files.begin()->second.bytes == "first");
    CHECK(files.begin()->second.digest == espalier::digest("first"));
}

TEST_CASE("each thread has its own log, and may note in another's", "[base]") {
    const TemporaryFolder folder;
    const auto mine = folder.write("mine", "1"), yours = folder.write("yours", "2"), ours = folder.write("ours", "3");
    ReadLog log;
    std::thread([&] {
        espalier::read_text(mine);
        const ReadLog other;
        espalier::read_text(yours);
        CHECK(other.files().size() == 1);
        const ReadLog::Scope scope(&log);
        espalier::read_text(ours);
        CHECK(other.files().size() == 1);
    }).join();
    CHECK(ReadLog::current() == &log);
    REQUIRE(log.files().size() == 1);
    CHECK(log.files().count(ours) == 1);
}

TEST_CASE("a log keeps no more bytes than it may, but knows every file", "[base]") {
    const TemporaryFolder folder;
    const ReadLog log(10);
    espalier::read_text(folder.write("large", std::string(11, 'x')));
    espalier::read_text(folder.write("small", "0123456789"));
    espalier::read_text(folder.write("more", "y"));
    const auto files = log.files();
    CHECK_FALSE(files.at(folder.path() / "large").kept);
    CHECK(files.at(folder.path() / "large").size == 11);
    CHECK(files.at(folder.path() / "small").kept);
    CHECK_FALSE(files.at(folder.path() / "more").kept);
}

TEST_CASE("a permission holds for its folders, whatever links lead out, and for the logs within", "[base]") {
    const TemporaryFolder mine, theirs;
    const fs::path own = mine.write("own.l", "own"), secret = theirs.write("secret", "secret");
    fs::create_symlink(secret, mine.path() / "link.l");
    fs::create_directory(mine.path() / "deeper");
    const fs::path sibling = mine.path().string() + "-sibling";
    fs::create_directory(sibling);
    std::ofstream(sibling / "a.l") << "a";
    {
        const espalier::ReadLog log(100, {}, espalier::ReadPermission{{mine.path()}, 10});
        const espalier::ReadLog within;
        CHECK(espalier::read_text(own) == "own");
        CHECK(espalier::read_text(mine.path() / "deeper/../own.l") == "own");
        for (const fs::path& path : {secret, mine.path() / "link.l", sibling / "a.l", mine.path() / ".." / "none",
                                     fs::path("/proc/self/environ")}) {
            INFO(path.string());
            CHECK_FALSE(espalier::is_readable(path));
            CHECK_THROWS_WITH(espalier::read_text(path), Contains("what is open reads only files below"));
        }
        CHECK_THROWS_WITH(espalier::read_text(mine.write("long.l", std::string(11, 'x'))), Contains("11 bytes"));
    }
    CHECK(espalier::read_text(secret) == "secret");
    fs::remove_all(sibling);
}
