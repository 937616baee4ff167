// Scenes grow to the same bytes whether or not the processor has fused multiply-add. GLIBC_TUNABLES makes the C library
// take a processor for an older one; another C library does not read it, and then this compares 2 threads with 1.
#include "catch.h"
#include "program.h"

#include <regex>
#include <set>
#include <string>

namespace fs = std::filesystem;

namespace {

const char* const older_processor = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX512F";

std::set<std::string> named_processes(const std::string& scene) {
    static const std::regex named(R"re(\bprocess\s*=\s*"([^"]+)")re");
    std::set<std::string> processes;
    for (std::sregex_iterator it(scene.begin(), scene.end(), named), end; it != end; ++it) processes.insert((*it)[1]);
    return processes;
}

/// The first scene of each process, and those of species, whose plants differ most.
std::set<fs::path> scenes() {
    std::set<fs::path> all, chosen;
    for (const auto& entry : fs::directory_iterator(fs::path(ESPALIER_SOURCE_DIR) / "environments")) {
        if (entry.path().extension() == ".toml") all.insert(entry.path());
    }
    std::set<std::string> known;
    for (const fs::path& scene : all) {
        const std::size_t before = known.size();
        known.merge(named_processes(text_of(scene)));
        if (known.size() > before) chosen.insert(scene);
    }
    REQUIRE(known.size() >= 20);
    for (const auto& entry : fs::directory_iterator(fs::path(ESPALIER_SOURCE_DIR) / "environments/species")) {
        if (entry.path().extension() == ".toml") chosen.insert(entry.path());
    }
    return chosen;
}

/// Steps with many rays are long, and alike.
std::string steps_of(const fs::path& scene) {
    return text_of(scene).find("\"ray-light\"") == std::string::npos ? " --steps 12" : " --steps 4";
}

}  // namespace

TEST_CASE_METHOD(Workplace, "scenes of every process grow to the same bytes on a processor without fused multiply-add",
                 "[app]") {
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
