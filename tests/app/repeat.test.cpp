// Runs that are done again, and runs that are varied.
#include "catch.h"
#include "program.h"
#include "recorded_files.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

using Catch::Contains;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const char* const repeated_scene = R"([simulation]
steps = 4
[[plant]]
model = "shrub.l"
[environment.light]
process = "voxel-shade"
)";

const char* const shrub =
    "#define D 1.1\nLsystem: 1\nderivation length: 4\nAxiom: A(1)?E(1)\n"
    "A(x) --> F(x)[+A(x*0.5)?E(1)]A(x/D)\nF(x) --> F(x*D)\nendlsystem\n";

std::size_t count_lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE_METHOD(Workplace, "a run is repeated from its run.json alone, byte for byte", "[app]") {
    write("shrub.l", shrub);
    write("scene.toml", repeated_scene);
    REQUIRE(run("run scene.toml --quiet --output first").code == 0);
    fs::remove(path() / "shrub.l");
    fs::remove(path() / "scene.toml");
    const Outcome again = run("rerun first --threads 1 --output second --quiet");
    CHECK(again.err == "");
    CHECK(again.code == 0);
    CHECK(fs::exists(path() / "second" / "plants.pvd"));
    CHECK(run("rerun first --threads 16 --quiet").code == 0);
    CHECK_THAT(run("rerun first").out, Contains("all files have the same bytes"));
}

TEST_CASE_METHOD(Workplace, "rerun names the files that differ", "[app]") {
    write("shrub.l", shrub);
    REQUIRE(run("run shrub.l --quiet --output first").code == 0);
    fs::remove(path() / "first" / "plants" / "0002.vtp");
    std::ofstream(path() / "first" / "statistics.csv", std::ios::app) << "x";
    const Outcome again = run("rerun first --quiet");
    CHECK(again.code == 2);
    CHECK_THAT(again.out, Contains("0002.vtp is new") && Contains("statistics.csv differs from byte"));
}

TEST_CASE_METHOD(Workplace, "rerun ignores what other commands left in the folder of the run", "[app]") {
    write("shrub.l", shrub);
    REQUIRE(run("run shrub.l --quiet --output first").code == 0);
    fs::create_directory(path() / "first" / "analysis");
    for (const char* name : {"first/render.png", "first/plot.svg", "first/analysis/orders.csv"}) write(name, "x");
    CHECK(run("rerun first --quiet").code == 0);
    CHECK_THAT(run("rerun first").out, Contains("all files have the same bytes") &&
                                           Contains("not compared, because no run writes it: analysis/, plot.svg, "
                                                    "render.png\n"));
    write("first/plants/9999.vtp", "x");
    const Outcome again = run("rerun first --quiet");
    CHECK(again.code == 2);
    CHECK_THAT(again.out, Contains("9999.vtp is missing"));
}

TEST_CASE_METHOD(Workplace, "what cannot be repeated is refused in words", "[app]") {
    CHECK(run("rerun nowhere").code == 1);
    write("shrub.l", shrub);
    REQUIRE(run("run shrub.l --quiet --output first").code == 0);
    std::string text = text_of(path() / "first" / "run.json");
    const std::string changed = text.replace(text.find("A(x*0.5)"), 8, "A(x*0.6)");
    write("first/run.json", changed);
    const Outcome outcome = run("rerun first");
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.err, Contains("is not what its digest says"));
}

TEST_CASE_METHOD(Workplace, "a run.json that was tampered with makes nothing outside the temporary folder", "[app]") {
    write("shrub.l", shrub);
    REQUIRE(run("run shrub.l --quiet --output first").code == 0);
    const json original = json::parse(text_of(path() / "first" / "run.json"));
    const auto refused = [&](const std::string& pointer, const json& forgery) {
        json forged = original;
        forged[json::json_pointer(pointer)] = forgery;
        write("first/run.json", forged.dump());
        const Outcome outcome = run("rerun first");
        INFO(pointer << " " << forgery << ": " << outcome.err);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, !Contains("filesystem error"));
    };
    refused("/command/folder", "../../../../../../../../../../../../" + (path() / "made").string());
    refused("/command/folder", "relative");
    refused("/command/folder", "/" + std::string(300, 'x'));
    refused("/command/folder", original["inputs"][0]["path"]);  // a file
    refused("/command/arguments", json::array());
    refused("/command/arguments", json::array({std::string(5000, 'x')}));
    refused("/command/arguments", json::array({"--frobnicate"}));
    refused("/inputs/0/path", "shrub.l");
    refused("/inputs/0/path", "/" + std::string(300, 'x') + "/shrub.l");
    refused("/inputs/0/path", "/folder/");
    refused("/inputs", "none");
    refused("/version", 7);
    json twice = original["inputs"];
    twice.push_back(twice[0]);
    twice[1]["path"] = twice[0]["path"].get<std::string>() + "/below";
    refused("/inputs", twice);
    CHECK_FALSE(fs::exists(path() / "made"));
}

TEST_CASE_METHOD(Workplace, "a run is repeated wherever the temporary folder is", "[app]") {
    write("shrub.l", shrub);
    REQUIRE(run("run shrub.l --quiet --output first").code == 0);
    fs::create_directories(path() / "here");
    const Outcome again = run("rerun first --quiet", "TMPDIR=here");
    CHECK(again.err == "");
    CHECK(again.code == 0);
    CHECK(fs::is_empty(path() / "here"));
    const Outcome nowhere = run("rerun first --quiet", "TMPDIR=/no/such/folder");
    CHECK(nowhere.code == 2);
    CHECK_THAT(nowhere.err, Contains("cannot make a temporary folder in /no/such/folder"));
}

TEST_CASE_METHOD(Workplace, "rerun keeps its timeline apart from the one it repeats", "[app]") {
    write("shrub.l", shrub);
    REQUIRE(run("run shrub.l --quiet --output runs/first").code == 0);
    for (const char* output : {"runs/first", "runs/first/again", "runs", "runs/second/../first/x"}) {
        const Outcome outcome = run(std::string("rerun runs/first --output ") + output);
        INFO(output);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains("must be outside the folder of the run"));
    }
    CHECK(run("rerun runs/first --quiet").code == 0);
    CHECK(run("rerun runs/first --quiet --output runs/first-again").code == 0);
}

TEST_CASE_METHOD(Workplace, "a sweep runs every combination once, and makes one table of them", "[app]") {
    write("shrub.l", shrub);
    write("scene.toml", repeated_scene);
    const std::string command = "sweep scene.toml --vary environment.light.voxel=0.5,1 --vary simulation.steps=2..4 ";
    const Outcome first = run(command + "--output s");
    CHECK(first.code == 0);
    CHECK(count_lines(first.err) == 6);
    const std::string table = text_of(path() / "s" / "sweep.csv");
    CHECK_THAT(table, Contains("run,environment.light.voxel,simulation.steps,name,step,time,plant,modules"));
    CHECK_THAT(table, Contains("\"voxel=0.5,steps=2\",0.5,2,shrub,2,2,0,"));
    CHECK(count_lines(table) == 7);

    // What is done stays; what has changed is done again.
    CHECK_THAT(run(command + "--output s").err, Contains("6 of 6 runs are already complete"));
    fs::remove(path() / "s" / "voxel=1,steps=3" / "run.json");
    CHECK_THAT(run(command + "--output s").err, Contains("5 of 6 runs are already complete"));
    write("shrub.l", std::string(shrub) + "\n");
    CHECK(count_lines(run(command + "--output s --list").out) == 6);
}

TEST_CASE_METHOD(Workplace, "a sweep draws any statistic over what was varied, also afterwards", "[app]") {
    write("shrub.l", shrub);
    const std::string sweep = "sweep shrub.l --vary D=1.1,1.2 --vary simulation.seed=1..2 --output s ";
    REQUIRE(run(sweep + "--quiet").code == 0);
    const Outcome mistaken = run(sweep + "--statistic heigt");
    CHECK(mistaken.code == 1);
    CHECK_THAT(mistaken.err, Contains("there is no quantity 'heigt' (did you mean 'height'?)"));
    CHECK_THAT(run(sweep + "--statistic xyzzy").err,
               Contains("there is no quantity 'xyzzy'; there are ") && Contains(", height, ") && Contains("organs"));
    const Outcome drawn = run(sweep + "--statistic height,organs");
    CHECK_THAT(drawn.err, Contains("4 of 4 runs are already complete"));
    if (drawn.code == 2) return;  // nothing can draw here
    CHECK(drawn.code == 0);
    CHECK(drawn.out == "s/sweep.csv\ns/sweep.png\n");
    CHECK(run(sweep + "--quiet --plot all.svg --dark --size 500x300").code == 0);
    CHECK_THAT(text_of(path() / "all.svg"), Contains("width=\"500\" height=\"300\""));
    CHECK(run(sweep + "--plot all.jpg").code == 1);
}

TEST_CASE_METHOD(Workplace, "a sweep knows its statistics before it runs", "[app]") {
    write("shrub.l", shrub);
    write("scene.toml", repeated_scene);
    const Outcome outcome = run("sweep scene.toml --vary simulation.seed=1..3 --statistic light.meen --output s");
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.err, Contains("there is no quantity 'light.meen' (did you mean 'light.mean'?)"));
    CHECK_FALSE(fs::exists(path() / "s"));
}

TEST_CASE_METHOD(Workplace, "the commands a sweep lists are those it would run", "[app]") {
    write("shrub.l", shrub);
    const std::string command = "sweep shrub.l --vary D=1.1,1.2 --output 'a b'";
    const Outcome list = run(command + " --list");
    CHECK(count_lines(list.out) == 2);
    CHECK_THAT(list.out, Contains("--define D=1.2") && Contains("'a b/D=1.2'"));
    write("commands", list.out);
    const auto do_all = [&] {
        return std::system(("cd '" + path().string() + "' && sh commands >.out 2>.err").c_str());
    };
    REQUIRE(do_all() == 0);
    CHECK_THAT(text_of(path() / ".err"), Contains("step 4/4"));  // a log tells how far a run is
    CHECK(run(command + " --list").out == "");
    // A task that starts a second time has nothing to do.
    const auto then = fs::last_write_time(path() / "a b/D=1.2/plants.pvd");
    REQUIRE(do_all() == 0);
    CHECK_THAT(text_of(path() / ".out"), Contains("complete, 4 of 4 steps"));
    CHECK(fs::last_write_time(path() / "a b/D=1.2/plants.pvd") == then);
    CHECK_THAT(run("sweep shrub.l --vary D=1.3 --quiet --list").out, Contains(" --quiet"));
    CHECK(run(command + " --quiet").code == 0);
    CHECK(count_lines(text_of(path() / "a b" / "sweep.csv")) == 3);
}

namespace {

/// Tasks of an array as Slurm starts them.
class Tasks : public Workplace {
public:
    Tasks() {
        write("shrub.l", shrub);
        write("some.commands", run("sweep shrub.l --vary D=1.1,1.2,1.3 --output s --list").out);
    }
    std::string line_of(const std::string& task, const std::string& arguments) const {
        return "cd '" + path().string() + "' && SLURM_ARRAY_TASK_ID=" + task + " SLURM_ARRAY_TASK_MAX=2 exec bash '" +
               ESPALIER_SOURCE_DIR + "/docs/sweep.slurm' " + arguments + " >.out 2>.err";
    }
    int task(const std::string& number, const std::string& arguments = "some.commands") const {
        return code_of(std::system(line_of(number, arguments).c_str()));
    }
    std::string told() const { return text_of(path() / ".err"); }
};

}  // namespace

TEST_CASE_METHOD(Tasks, "the script for Slurm runs the line of its task, and says if there is none", "[app]") {
    CHECK(task("1") == 0);
    CHECK_THAT(told(), !Contains("array"));
    CHECK(fs::exists(path() / "s/D=1.1/complete"));
    CHECK_FALSE(fs::exists(path() / "s/D=1.2"));
    // The last task of an array that is too short, and the next array.
    CHECK(task("2") == 0);
    CHECK_THAT(told(), Contains("this array ends with line 2 of 3") && Contains("docs/sweep.slurm some.commands 2"));
    CHECK(task("1", "some.commands 2") == 0);
    CHECK(fs::exists(path() / "s/D=1.3/complete"));
    CHECK(task("4") == 1);
    CHECK_THAT(told(), Contains("task 4: the file some.commands has only 3 lines"));
    CHECK(task("0") == 1);
    CHECK_THAT(told(), Contains("numbered from 1"));
    CHECK(task("1", "") == 1);
    CHECK_THAT(told(), Contains("usage: sbatch --array=1-N docs/sweep.slurm FILE"));
}

// Slurm sends the signal to the script alone; when that ends, it kills what is left.
TEST_CASE_METHOD(Tasks, "a task that is told that its time is up leaves a checkpoint, and the next one goes on",
                 "[app]") {
    write("patient.l", models::patient);
    write("long.commands",
          run("sweep patient.l --vary simulation.seed=1 --steps 3000 --every 3000 --output s --list").out);
    REQUIRE(run("run patient.l --set simulation.seed=1 --steps 3000 --every 3000 --quiet --output whole").code == 0);
    const std::string start = "( " + line_of("1", "long.commands") + " ) & task=$!; cd '" + path().string() +
                              "'; while [ ! -e s/seed=1/timings.csv ] && kill -0 $task; do sleep 0.01; done; ";
    CHECK(code_of(std::system((start + "kill -TERM $task; wait $task").c_str())) == 130);
    CHECK(fs::exists(path() / "s/seed=1/checkpoint"));
    CHECK(task("1", "long.commands") == 0);
    CHECK_THAT(told(), Contains("s/seed=1: continued from the checkpoint of step "));
    CHECK((recorded_files(path() / "s/seed=1") == recorded_files(path() / "whole")));
}

TEST_CASE_METHOD(Workplace, "a sweep goes on with runs that were interrupted, from their checkpoints", "[app]") {
    write("shrub.l", shrub);
    const std::string sweep = "sweep shrub.l --vary D=1.1,1.2 --every 2 --checkpoint-every 1 --quiet --output ";
    REQUIRE(run(sweep + "whole").code == 0);
    CHECK(json::parse(text_of(path() / "whole/D=1.1/run.json"))["checkpoint_every"] == 1);
    CHECK_FALSE(fs::exists(path() / "whole/D=1.1/plants/0001.vtp"));
    CHECK(fs::exists(path() / "whole/D=1.1/plants/0002.vtp"));
    REQUIRE(run(sweep + "s --disk 1K").code == 2);
    const std::string first_row = text_of(path() / "s/D=1.1/timings.csv").substr(0, 90);
    CHECK(fs::exists(path() / "s/D=1.1/checkpoint"));
    CHECK_THAT(text_of(path() / "s/D=1.1.log"), Contains("--disk allows"));
    REQUIRE(run(sweep + "s").code == 0);
    CHECK(text_of(path() / "s/D=1.1/timings.csv").substr(0, 90) == first_row);  // it did not begin again
    for (const std::string folder : {"D=1.1", "D=1.2"}) {
        CHECK((recorded_files(path() / "s" / folder) == recorded_files(path() / "whole" / folder)));
        CHECK_FALSE(fs::exists(path() / "s" / (folder + ".log")));
    }
}

TEST_CASE_METHOD(Workplace, "the table of a sweep is made of what is there, and what is missing is named", "[app]") {
    write("shrub.l", shrub);
    const std::string sweep = "sweep shrub.l --vary D=1.1,1.2,1.3,1.4 --checkpoint-every 1 --output s ";
    REQUIRE(run("sweep shrub.l --vary D=1.1,1.2 --quiet --output s").code == 0);
    REQUIRE(run("sweep shrub.l --vary D=1.3 --quiet --output s --disk 1K --checkpoint-every 1").code == 2);
    fs::remove(path() / "s/sweep.csv");
    CHECK_THAT(run("sweep shrub.l --vary D=1.1 --output none --table").err, Contains("1 of 1 runs are missing"));
    CHECK_FALSE(fs::exists(path() / "none"));
    const Outcome part = run(sweep + "--table");
    CHECK(part.code == 2);
    CHECK(count_lines(text_of(path() / "s/sweep.csv")) == 3);
    CHECK_THAT(part.err, Contains("missing: D=1.3: failed: ") && Contains(", with a checkpoint of step ") &&
                             Contains("missing: D=1.4: not begun\n2 of 4 runs are missing"));
    CHECK_FALSE(fs::exists(path() / "s/D=1.4"));
    // What becomes complete elsewhere, by a line of --list, takes back what it said when it failed.
    CHECK(fs::exists(path() / "s/D=1.3.log"));
    for (const std::string value : {"1.3", "1.4"}) {
        REQUIRE(run("run shrub.l --define D=" + value + " --output s/D=" + value + " --quiet --continue").code == 0);
    }
    const Outcome all = run(sweep + "--table");
    CHECK(all.code == 0);
    CHECK(all.err == "");
    CHECK(count_lines(text_of(path() / "s/sweep.csv")) == 5);
    CHECK_FALSE(fs::exists(path() / "s/D=1.3.log"));
    CHECK(run(sweep + "--table --list").code == 1);
    write("shrub.l", std::string(shrub) + "\n");
    CHECK_THAT(run(sweep + "--table").err, Contains("missing: D=1.1: another run is in s/D=1.1: ") &&
                                               Contains("shrub.l has changed since it began"));
}

TEST_CASE_METHOD(Workplace, "runs of a sweep at the same time share the memory", "[app]") {
    write("shrub.l", shrub);
    const auto memory_of = [&](const std::string& folder) {
        return json::parse(text_of(path() / folder / "run.json"))["memory"].get<std::size_t>();
    };
    REQUIRE(run("run shrub.l --quiet --output alone").code == 0);
    REQUIRE(run("sweep shrub.l --vary D=1.1,1.2,1.3 --jobs 3 --quiet --output s").code == 0);
    REQUIRE(run("sweep shrub.l --vary D=1.1,1.2,1.3 --jobs 1 --quiet --output one").code == 0);
    REQUIRE(run("sweep shrub.l --vary D=1.1,1.2,1.3 --jobs 3 --memory 300M --quiet --output given").code == 0);
    CHECK(memory_of("s/D=1.1") == memory_of("alone") / 2);  // a third of three quarters, and half of all
    CHECK(memory_of("one/D=1.1") == memory_of("alone"));
    CHECK(memory_of("given/D=1.1") == 300 << 20);
    // A job may have one core of many: there is one run at a time, whatever the machine has.
    const std::string first_core = "taskset --cpu-list $(taskset --pid --cpu-list $$ | sed 's/.*: //; s/[-,].*//')";
    REQUIRE(run("sweep shrub.l --vary D=1.1,1.2,1.3 --quiet --output core", first_core).code == 0);
    CHECK(memory_of("core/D=1.1") == memory_of("alone"));
}

TEST_CASE_METHOD(Workplace, "a run that fails does not keep the others of its sweep", "[app]") {
    write("shrub.l", shrub);
    const Outcome outcome = run("sweep shrub.l --vary D=0,1.1 --output s");
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("D=0: ended with code 2: shrub.l:5") && Contains(", see s/D=0.log") &&
                                Contains("1 runs failed"));
    CHECK_THAT(text_of(path() / "s" / "D=0.log"), Contains("shrub.l:5"));
    CHECK(fs::exists(path() / "s" / "D=1.1" / "plants.pvd"));
}

TEST_CASE_METHOD(Workplace, "sweep.csv tells of no run that failed, nor of what lay there before it", "[app]") {
    write("shrub.l", shrub);
    REQUIRE(run("sweep shrub.l --vary D=1.1,1.2 --quiet --output s").code == 0);
    CHECK(count_lines(text_of(path() / "s" / "sweep.csv")) == 3);
    write("shrub.l", "no model at all");
    CHECK(run("sweep shrub.l --vary D=1.1,1.2 --quiet --output s").code == 2);
    CHECK(fs::exists(path() / "s" / "D=1.1" / "statistics.csv"));
    CHECK(count_lines(text_of(path() / "s" / "sweep.csv")) == 1);
}

TEST_CASE_METHOD(Workplace, "a scene of the same name elsewhere is another sweep", "[app]") {
    for (const std::string folder : {"here", "there"}) {
        fs::create_directories(path() / folder);
        write(folder + "/shrub.l", shrub);
    }
    const std::string sweep = " sweep shrub.l --vary D=1.1,1.2 --quiet --output ../s";
    REQUIRE(run(sweep, "cd here;").code == 0);
    CHECK(count_lines(run(sweep + " --list", "cd here;").out) == 0);
    CHECK(count_lines(run(sweep + " --list", "cd there;").out) == 2);
}

TEST_CASE_METHOD(Workplace, "values that would share a folder, or are no numbers, are refused", "[app]") {
    write("shrub.l", shrub);
    CHECK_THAT(run("sweep shrub.l --vary D=1,2,1").err, Contains("the value 1 is there twice"));
    CHECK_THAT(run("sweep shrub.l --vary D=1:1:3").err, Contains("the value 1 is there twice"));
    CHECK(run("sweep shrub.l --vary D=-1e308:1e308:3").code == 1);
    CHECK(count_lines(run("sweep shrub.l --vary D=../a,b --list").out) == 2);
    write("file", "");
    const Outcome outcome = run("sweep shrub.l --vary D=1.1,1.2 --output file");
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("cannot make the folder file/D=1.1"));
}
