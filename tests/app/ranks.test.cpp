// The program as mpiexec starts it: several processes, one run.
#include "catch.h"
#include "program.h"
#include "recorded_files.h"

#include <filesystem>
#include <map>

using Catch::Contains;
namespace fs = std::filesystem;

namespace {

const char* const growing =
    "environment light;\nlsystem: 1\nseed: 2\nderivation length: 40\naxiom: A(1)\n"
    "A(x) --> F(x)[+A(x*0.9)?light(1)] : 1\nA(x) --> F(x)A(x*0.99) : 2\nF(x) : x < 4 --> F(x*1.01)\nendlsystem\n";

const char* const stand =
    "[[plant]]\nmodel = \"growing.l\"\ngrid = { columns = 2, rows = 2, spacing = 1 }\n"
    "[environment.light]\nprocess = \"voxel-shade\"\n[timeline]\nfields = [\"light\"]\n";

// The same plants, a file each in every frame, which all ranks write.
const char* const stand_in_pieces =
    "[[plant]]\nmodel = \"growing.l\"\ngrid = { columns = 2, rows = 2, spacing = 1 }\n"
    "[environment.light]\nprocess = \"voxel-shade\"\n"
    "[timeline]\nstatistics = false\nlifespans = false\npoints_per_file = 1\n";

/// Debian's mpiexec, on a machine with fewer cores than ranks, for whoever runs the tests.
const std::string mpiexec = "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpiexec --oversubscribe ";

// False where the program was built without MPI.
bool has_ranks() {
    if (!ESPALIER_RANKS) return false;
    REQUIRE(std::system("command -v mpiexec >/dev/null") == 0);
    return true;
}

class Launched : public Workplace {
public:
    Launched() {
        write("growing.l", growing);
        write("stand.toml", stand);
        write("pieces.toml", stand_in_pieces);
    }

    Outcome launch(int ranks, const std::string& arguments) const {
        return run(arguments, mpiexec + "-n " + std::to_string(ranks));
    }

    std::map<std::string, std::string> files(const std::string& folder) const {
        return recorded_files(path() / folder);
    }
};

}  // namespace

TEST_CASE_METHOD(Launched, "mpiexec grows a scene as one process does, and only the first rank speaks",
                 "[app][ranks]") {
    if (!has_ranks()) return;
    const std::string scene = GENERATE("stand.toml", "pieces.toml");
    const std::string blocks = GENERATE("", " --blocks 2");
    REQUIRE(run("run " + scene + " --quiet --output alone").code == 0);
    const Outcome outcome = launch(3, "run " + scene + " --output spread --threads 1" + blocks);
    INFO(blocks << outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.out, Contains("40 of 40 steps"));
    CHECK(outcome.out.find("40 of 40 steps") == outcome.out.rfind("40 of 40 steps"));
    CHECK(files("spread") == files("alone"));
    CHECK_THAT(text_of(path() / "spread" / "run.json"), Contains("\"ranks\": 3"));
}

TEST_CASE_METHOD(Launched, "a rank that is killed ends the run, and resume goes on with other ranks", "[app][ranks]") {
    if (!has_ranks()) return;
    const std::string scene = GENERATE("stand.toml", "pieces.toml");
    const std::string blocks = GENERATE("", " --blocks 2");
    REQUIRE(run("run " + scene + " --quiet --output alone").code == 0);
    // The shell knows rank 1 by its variable, and kills it once there is a checkpoint.
    write("rank.sh",
          "if [ \"$OMPI_COMM_WORLD_RANK\" = 1 ]; then\n"
          "  '" ESPALIER_PROGRAM
          "' \"$@\" & process=$!\n"
          "  while [ ! -e again/checkpoint ] && kill -0 $process; do sleep 0.01; done\n"
          "  kill -9 $process; wait $process\n"
          "else exec '" ESPALIER_PROGRAM "' \"$@\"; fi\n");
    const std::string command = "cd '" + path().string() + "' && " + mpiexec + "-n 2 sh rank.sh run " + scene +
                                " --quiet --threads 1 --output again --checkpoint-every 1" + blocks + " >.out 2>.err";
    CHECK(code_of(std::system(command.c_str())) != 0);
    REQUIRE(fs::exists(path() / "again" / "checkpoint"));
    const Outcome resumed = launch(3, "resume again --quiet --threads 1");
    INFO(resumed.err);
    CHECK(resumed.code == 0);
    CHECK(files("again") == files("alone"));
}

TEST_CASE_METHOD(Launched, "a disk that is full for one rank ends all; what was whole stays, and resume goes on",
                 "[app][ranks]") {
    if (!has_ranks()) return;
    REQUIRE(run("run pieces.toml --quiet --output alone").code == 0);
    write("rank.sh", "[ \"$OMPI_COMM_WORLD_RANK\" = 1 ] && ulimit -f 16\nexec '" ESPALIER_PROGRAM "' \"$@\"\n");
    const std::string command =
        "cd '" + path().string() + "' && " + mpiexec +
        "-n 2 sh rank.sh run pieces.toml --quiet --threads 1 --output full --checkpoint-every 1 >.out 2>.err";
    const int code = code_of(std::system(command.c_str()));
    const std::string told = text_of(path() / ".err");
    if (told.find("shared memory initialization") != std::string::npos) {
        WARN("skipped: this MPI needs larger files for its own memory");  // Open MPI 5
        return;
    }
    CHECK(code == 2);
    CHECK_THAT(told, Contains("rank 1 of 2") && Contains("cannot write"));
    CHECK(told.find("cannot write") == told.rfind("cannot write"));
    const std::string index = text_of(path() / "full" / "plants.pvd");
    for (int step = 0; step <= 40; ++step) {
        const std::string number = (step < 10 ? "000" : "00") + std::to_string(step);
        INFO(number);
        for (const char* piece : {"", "-1", "-2", "-3"}) {
            const std::string file = "plants/" + number + piece + ".vtp";
            if (index.find(file) != std::string::npos) CHECK(fs::exists(path() / "full" / file));
        }
    }
    CHECK_THAT(index, Contains("plants/0005-3.vtp") && !Contains("plants/0040"));
    REQUIRE(launch(3, "resume full --quiet --threads 1").code == 0);
    CHECK(files("full") == files("alone"));
}

// Without Slurm, the script takes mpiexec, which hands the signal on as srun does.
TEST_CASE_METHOD(Launched, "the script for Slurm begins a run, goes on with it, and knows when it is complete",
                 "[app][ranks]") {
    if (!has_ranks()) return;
    write("patient.l", models::patient);
    write("two.toml", "[[plant]]\nmodel = \"patient.l\"\ngrid = { columns = 2, rows = 1, spacing = 1 }\n");
    REQUIRE(run("run two.toml --quiet --output alone --steps 200 --every 50").code == 0);
    fs::create_directory(path() / "bin");
    fs::permissions(write("bin/srun", "#!/bin/sh\nexit 1\n"), fs::perms::owner_all);
    const std::string job =
        "PATH=\"$PWD/bin:$(dirname '" ESPALIER_PROGRAM
        "'):$PATH\" SLURM_JOB_NUM_NODES=2 "
        "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
        "bash '" ESPALIER_SOURCE_DIR "/docs/run.slurm' two.toml jobs --steps 200 --every 50 --checkpoint-every 100";
    const auto in_place = [&](const std::string& commands) {
        return code_of(std::system(("cd '" + path().string() + "' && { " + commands + "; } >.out 2>.err").c_str()));
    };
    const int stopped =
        in_place(job +
                 " & job=$!; while [ ! -e jobs/timings.csv ] && kill -0 $job; do sleep 0.02; done; sleep 0.2; "
                 "kill -USR1 $job; wait $job");
    INFO(text_of(path() / ".err"));
    CHECK(stopped == 130);
    CHECK(fs::exists(path() / "jobs/checkpoint"));
    CHECK(in_place(job) == 0);
    CHECK_THAT(text_of(path() / ".err"), Contains("jobs: continued from the checkpoint of step "));
    CHECK(files("jobs") == files("alone"));
    CHECK(in_place(job) == 0);
    CHECK_THAT(text_of(path() / ".out"), Contains("jobs: complete, 200 of 200 steps"));
}

TEST_CASE_METHOD(Launched, "all ranks end with the exit code of a mistake, told once", "[app][ranks]") {
    if (!has_ranks()) return;
    const Outcome unknown = launch(2, "run nothing.toml --quiet");
    CHECK(unknown.code == 1);
    CHECK_THAT(unknown.err, Contains("nothing.toml"));
    const Outcome many = launch(5, "run stand.toml --quiet --output many");
    CHECK(many.code == 1);
    CHECK_THAT(many.err, Contains("there are 5 ranks but only 4 blocks with plants"));
    CHECK(many.err.find("there are 5 ranks") == many.err.rfind("there are 5 ranks"));
    REQUIRE(launch(2, "run stand.toml --quiet --output whole").code == 0);
    CHECK(launch(2, "run stand.toml --output whole --continue --steps 3").code == 1);
    for (const std::string command : {"resume whole", "run stand.toml --output whole --continue"}) {
        CAPTURE(command);
        const Outcome whole = launch(2, command);
        CHECK(whole.code == 0);
        CHECK(whole.out.find("there is nothing left to do") != std::string::npos);
        CHECK(whole.out.find("there is nothing left to do") == whole.out.rfind("there is nothing left to do"));
    }
}

// As a launcher of another MPI would: its variables are set, and the library that was built with knows none of them.
TEST_CASE_METHOD(Launched, "the launcher of another MPI is refused, and both are named", "[app][ranks]") {
    if (!has_ranks()) return;
    for (const std::string variable : {"PMI_SIZE=3", "PMIX_RANK=2", "SLURM_STEP_NUM_TASKS=3"}) {
        const Outcome outcome = run("run stand.toml --quiet --output single", variable);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains("3 processes or more (" + variable + ")"));
        CHECK_THAT(outcome.err, Contains("MPI") && Contains("sees one") && Contains("mpiexec -n 3 espalier"));
        CHECK_THAT(outcome.err, Contains("srun --mpi=pm"));
        // Tasks of plain srun may each grow a run of their own.
        CHECK((outcome.err.find("env -u SLURM_STEP_NUM_TASKS") != std::string::npos) == variable.starts_with("SLURM"));
        CHECK_FALSE(fs::exists(path() / "single"));
    }
    CHECK(run("run stand.toml --quiet --steps 2 --output single", "PMI_SIZE=1 PMIX_RANK=0").code == 0);
    CHECK(run("run stand.toml --quiet --steps 2 --output one", "SLURM_STEP_NUM_TASKS=1").code == 0);
    // A launcher that is itself a step of Slurm, and starts one process.
    CHECK(run("run stand.toml --quiet --steps 2 --output two", "SLURM_STEP_NUM_TASKS=2 PMI_SIZE=1").code == 0);
}

TEST_CASE_METHOD(Launched, "SIGUSR1 to mpiexec ends all ranks after their step, with a checkpoint", "[app][ranks]") {
    if (!has_ranks()) return;
    write("patient.l", models::patient);
    write("two.toml", "[[plant]]\nmodel = \"patient.l\"\ngrid = { columns = 2, rows = 1, spacing = 1 }\n");
    const std::string script = "cd '" + path().string() + "' && { " + mpiexec +
                               "-n 2 '" ESPALIER_PROGRAM
                               "' run two.toml --threads 1 --output out & launcher=$!; "
                               "while [ ! -e out/plants/0002.vtp ] && kill -0 $launcher; do sleep 0.05; done; "
                               "kill -USR1 $launcher; wait $launcher; } >.out 2>.err";
    const int code = code_of(std::system(script.c_str()));
    INFO(text_of(path() / ".err"));
    CHECK(code == 130);
    CHECK_THAT(text_of(path() / "out/run.json"), Contains("\"exit\": \"interrupted\""));
    CHECK(fs::exists(path() / "out/checkpoint"));
}

TEST_CASE_METHOD(Launched, "ranks that read different files are refused", "[app][ranks]") {
    if (!has_ranks()) return;
    write("rank.sh",
          "[ \"$OMPI_COMM_WORLD_RANK\" = 1 ] && more='--seed 5'\nexec '" ESPALIER_PROGRAM "' \"$@\" $more\n");
    const std::string command = "cd '" + path().string() + "' && " + mpiexec +
                                "-n 2 sh rank.sh run stand.toml --quiet --output odd >.out 2>.err";
    CHECK(code_of(std::system(command.c_str())) == 1);
    CHECK_THAT(text_of(path() / ".err"), Contains("rank 1 runs another version of the program, other files"));
}
