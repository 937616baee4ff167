// Scenes grow to the same bytes whether or not the processor has fused multiply-add. GLIBC_TUNABLES makes the C library
// take a processor for an older one; another C library does not read it, and then this compares 2 threads with 1.
#include "catch.h"
#include "program.h"

#include <set>

namespace fs = std::filesystem;

namespace {

const char* const older_processor = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX512F";

/// Scenes, not what scenes are made of.
std::set<fs::path> scenes() {
    std::set<fs::path> found;
    for (const char* folder : {"environments", "environments/species"}) {
        for (const auto& entry : fs::directory_iterator(fs::path(ESPALIER_SOURCE_DIR) / folder)) {
            if (entry.path().extension() == ".toml") found.insert(entry.path());
        }
    }
    return found;
}

/// Steps with many rays are long, and alike.
std::string steps_of(const fs::path& scene) {
    return text_of(scene).find("\"ray-light\"") == std::string::npos ? " --steps 12" : " --steps 4";
}

}  // namespace

TEST_CASE_METHOD(Workplace, "every scene grows to the same bytes on a processor without fused multiply-add", "[app]") {
    // Pictures of leaves are recorded by their path from where the program runs.
    const std::string at_source = "cd '" + std::string(ESPALIER_SOURCE_DIR) + "' && ";
    const std::string folder = "'" + (path() / "first").string() + "'";
    for (const fs::path& scene : scenes()) {
        INFO(scene);
        const std::string relative = fs::relative(scene, ESPALIER_SOURCE_DIR).string();
        const Outcome first =
            run("run " + relative + steps_of(scene) + " --every 3 --quiet --threads 2 --overwrite --output " + folder,
                at_source);
        INFO(first.err);
        REQUIRE(first.code == 0);
        const Outcome again = run("rerun " + folder + " --quiet --threads 1", at_source + older_processor);
        CHECK(again.out == "");
        CHECK(again.code == 0);
    }
}
