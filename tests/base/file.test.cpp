#include "espalier/base/file.h"

#include "espalier/base/error.h"

#include "base/folder.h"
#include "catch.h"
#include "small_disk.h"
#include "temporary_folder.h"

#include <fstream>
#include <string_view>
#include <sys/stat.h>

using namespace espalier;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

std::size_t entries(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("a file that cannot be written whole leaves the old one and nothing beside it", "[base]") {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "run.json";
    write_text(file, "old");
    {
        const SmallDisk disk(100);
        CHECK_THROWS_AS(write_text(file, std::string(1000, 'x')), RunError);
    }
    CHECK(read_text(file) == "old");
    CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a file of very many parts, some of them empty, holds them in their order", "[base]") {
    const TemporaryFolder folder;
    std::vector<std::string> texts;
    std::string whole;
    for (int i = 0; i < 3000; ++i) {
        texts.push_back(i % 7 == 0 ? "" : std::to_string(i) + std::string(std::size_t(i % 50), 'x'));
        whole += texts.back();
    }
    const std::vector<std::string_view> parts(texts.begin(), texts.end());
    write_text(folder.path() / "many", parts);
    CHECK(read_text(folder.path() / "many") == whole);
    write_text(folder.path() / "none", std::vector<std::string_view>(3));
    CHECK(read_text(folder.path() / "none").empty());
}

TEST_CASE("a writer that fails or throws leaves no file", "[base]") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(write_file(folder.path() / "a.vtp", [](const fs::path&) { return false; }), RunError);
    CHECK_THROWS_AS(write_file(folder.path() / "b.vtp",
                               [](const fs::path& temporary) -> bool {
                                   std::ofstream(temporary) << "half";
                                   throw RunError("the writer stopped");
                               }),
                    RunError);
    CHECK(entries(folder.path()) == 0);
}

TEST_CASE("a missing file and a folder are told apart from text", "[base]") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(read_text(folder.path() / "none.l"), UserError);
    CHECK_THROWS_AS(read_text(folder.path()), UserError);
}

TEST_CASE("two holders of one folder are refused, and a released folder is free", "[base]") {
    const TemporaryFolder folder;
    {
        const FolderLock first(folder.path() / "run");
        CHECK_THROWS_AS(FolderLock(folder.path() / "run"), UserError);
    }
    CHECK_NOTHROW(FolderLock(folder.path() / "run"));
}

TEST_CASE("devices and pipes, which may never end, are no files to read", "[base]") {
    const TemporaryFolder folder;
    const fs::path pipe = folder.path() / "pipe";
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    for (const fs::path& path : {pipe, fs::path("/dev/zero"), fs::path("/dev/null")}) {
        INFO(path.string());
        CHECK_FALSE(is_readable(path));
        CHECK_THROWS_WITH(read_text(path), Contains("cannot read " + path.string()) && Contains("no regular file"));
    }
    const std::string name("a.l\0b", 5);
    CHECK_THROWS_WITH(read_text(folder.path() / name), Contains("zero byte"));
}

TEST_CASE("a file of more than 4 GiB is refused before it fills the memory", "[base]") {
    const TemporaryFolder folder;
    const fs::path file = folder.write("large.l", "x");
    std::error_code error;
    fs::resize_file(file, (std::uintmax_t{4} << 30) + 1, error);
    if (error) return;  // the file system has no holes in files
    CHECK_THROWS_WITH(read_text(file), Contains("it has 4294967297 bytes"));
}

TEST_CASE("a text of one's own is for its owner alone", "[base]") {
    const TemporaryFolder folder;
    const fs::path file = folder.write("state.json", "old");
    write_private_text(file, "new");
    CHECK(read_text(file) == "new");
    CHECK((fs::status(file).permissions() & fs::perms::all) == (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("no link is followed for writing: neither the file, nor what is written beside it, nor the lock", "[base]") {
    const TemporaryFolder folder, elsewhere;
    const fs::path victim = elsewhere.write("victim", "theirs");
    const fs::path file = folder.path() / "a.csv";
    fs::create_symlink(victim, file);
    CHECK_THROWS_WITH(append_text(file, "ours"), Contains("a.csv: it is a link, which is not followed for writing"));
    const fs::path beside = folder.path() / (".a." + std::to_string(getpid()) + ".part.csv");
    fs::create_symlink(victim, beside);
    write_text(file, "ours");
    CHECK(read_text(file) == "ours");
    CHECK_FALSE(fs::is_symlink(file));
    CHECK_FALSE(fs::exists(fs::symlink_status(beside)));
    append_text(file, ", too");
    CHECK(read_text(file) == "ours, too");
    fs::create_symlink(elsewhere.path() / "new", folder.path() / ".lock");
    CHECK_THROWS_WITH(FolderLock(folder.path()), Contains(".lock: it is a link"));
    CHECK_FALSE(fs::exists(elsewhere.path() / "new"));
    CHECK(read_text(victim) == "theirs");
}
