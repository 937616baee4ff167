// The Makefile and the Snakefile of the page on sweeps, where these programs are: a run that fails in between goes on.
#include "app/program.h"
#include "catch.h"
#include "page.h"
#include "recorded_files.h"

#include <algorithm>

namespace {

namespace fs = std::filesystem;

std::string block_of(const std::string& language) {
    std::string text;
    for (const pages::Block& block : pages::blocks_of("docs/sweeps.md")) {
        if (block.language != language) continue;
        for (const std::string& line : block.lines) text += line + "\n";
    }
    return text;
}

/// The second run fails at first, with a checkpoint: it may write next to nothing.
class Workflow : public Workplace {
public:
    Workflow() {
        for (const char* file : {"environments/course-light.toml", "models/course/08-light.l"}) {
            fs::create_directories((path() / file).parent_path());
            fs::copy_file(pages::root / file, path() / file);
        }
        fs::create_directory(path() / "bin");
        fs::permissions(write("bin/espalier",
                              "#!/bin/sh\n"
                              "case \"$*\" in *'--seed 2 '*) [ -e failed ] || set -- \"$@\" --disk 1K ;; esac\n"
                              "case \"$*\" in *'--disk 1K'*) touch failed ;; esac\n"
                              "exec '" ESPALIER_PROGRAM "' \"$@\"\n"),
                        fs::perms::owner_all);
    }

    int shell(const std::string& command) const {
        return code_of(std::system(("cd '" + path().string() + "' && PATH=\"$PWD/bin:$PATH\" HOME=\"$PWD\" && " + "{ " +
                                    command + "; } >.out 2>.err </dev/null")
                                       .c_str()));
    }
    fs::path run_of(int seed) const { return path() / "output/seeds" / std::to_string(seed); }
    int count_complete() const {
        int count = 0;
        for (int seed = 1; seed <= 3; ++seed) count += fs::exists(run_of(seed) / "complete");
        return count;
    }

    /// `again`: does nothing else than to say by its code whether something is left to do.
    void check(const std::string& start, const std::string& is_done) const {
        CHECK(shell(start) != 0);
        INFO(text_of(path() / ".out") << text_of(path() / ".err"));
        CHECK(fs::exists(run_of(2) / "statistics.csv"));
        CHECK(fs::exists(run_of(2) / "checkpoint"));
        CHECK_FALSE(fs::exists(run_of(2) / "complete"));
        CHECK(shell(start) == 0);
        INFO(text_of(path() / ".out") << text_of(path() / ".err"));
        CHECK(count_complete() == 3);
        REQUIRE(run("run environments/course-light.toml --seed 2 --quiet --output whole").code == 0);
        CHECK((recorded_files(run_of(2)) == recorded_files(path() / "whole")));
        CHECK(shell(is_done) == 0);
        // What is younger, but has not changed, costs a look.
        const auto then = fs::last_write_time(run_of(1) / "plants.pvd");
        fs::last_write_time(path() / "environments/course-light.toml", fs::file_time_type::clock::now());
        CHECK(shell(start) == 0);
        CHECK(shell(is_done) == 0);
        CHECK(fs::last_write_time(run_of(1) / "plants.pvd") == then);
    }
};

}  // namespace

TEST_CASE_METHOD(Workflow, "make takes no run for complete that is not", "[docs]") {
    if (!pages::is_installed("make")) return;
    write("Makefile", block_of("make"));
    check("make --keep-going", "make --question");
    const std::string summaries = text_of(path() / "output/seeds.json");
    std::size_t count = 0;
    for (std::size_t at = summaries.find("\"done\""); at != std::string::npos;
         at = summaries.find("\"done\"", at + 1)) {
        ++count;
    }
    CHECK(count == 3);
}

TEST_CASE_METHOD(Workflow, "Snakemake takes no run for complete that is not", "[docs]") {
    if (!pages::is_installed("snakemake")) return;
    write("Snakefile", block_of("python"));
    check("snakemake --cores 2 --rerun-incomplete --keep-going",
          "snakemake --cores 2 --dry-run 2>&1 | grep -q 'Nothing to be done'");
}
