#include "espalier/base/file.h"

#include "espalier/base/error.h"

#include "catch.h"

#include <csignal>
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>

using namespace espalier;
namespace fs = std::filesystem;

namespace {

struct TemporaryFolder {
    fs::path path = fs::temp_directory_path() / ("espalier-file-" + std::to_string(getpid()));
    TemporaryFolder() { fs::create_directories(path); }
    ~TemporaryFolder() { fs::remove_all(path); }
};

// A file-size limit stands in for a full disk: writes fail part of the way.
struct SmallDisk {
    rlimit before{};
    explicit SmallDisk(rlim_t bytes) {
        std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &before);
        rlimit small = before;
        small.rlim_cur = bytes;
        setrlimit(RLIMIT_FSIZE, &small);
    }
    ~SmallDisk() { setrlimit(RLIMIT_FSIZE, &before); }
};

std::size_t entries(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("a file that cannot be written whole leaves the old one and nothing beside it", "[base]") {
    const TemporaryFolder folder;
    const fs::path file = folder.path / "run.json";
    write_text(file, "old");
    {
        const SmallDisk disk(100);
        CHECK_THROWS_AS(write_text(file, std::string(1000, 'x')), RunError);
    }
    CHECK(read_text(file) == "old");
    CHECK(entries(folder.path) == 1);
}

TEST_CASE("a writer that fails or throws leaves no file", "[base]") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(write_file(folder.path / "a.vtp", [](const fs::path&) { return false; }), RunError);
    CHECK_THROWS_AS(write_file(folder.path / "b.vtp",
                               [](const fs::path& temporary) -> bool {
                                   std::ofstream(temporary) << "half";
                                   throw RunError("the writer stopped");
                               }),
                    RunError);
    CHECK(entries(folder.path) == 0);
}

TEST_CASE("a missing file and a folder are told apart from text", "[base]") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(read_text(folder.path / "none.l"), UserError);
    CHECK_THROWS_AS(read_text(folder.path), UserError);
}

TEST_CASE("two holders of one folder are refused, and a released folder is free", "[base]") {
    const TemporaryFolder folder;
    {
        const FolderLock first(folder.path / "run");
        CHECK_THROWS_AS(FolderLock(folder.path / "run"), UserError);
    }
    CHECK_NOTHROW(FolderLock(folder.path / "run"));
}
