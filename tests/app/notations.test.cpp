// Graphs and skeletons as users have them: whatever the bytes of their files, however large what they stand for.
#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>

using Catch::Contains;

namespace {

namespace fs = std::filesystem;

const std::string graph = "pgraph 1\nHorn stem\n  length 2\nHydra star\n  count 3\ncamera -> stem -> star\n";
const std::string skeleton = "// a straw\ndefine{\n  a[0,1,0,0];\n}\nrules{\n  a -> (a);\n}\n";

std::string with_line_ends(std::string text, const std::string& end) {
    for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + end.size())) {
        text.replace(at, 1, end);
    }
    return text;
}

}  // namespace

TEST_CASE_METHOD(Workplace, "files of other notations that are no text exit with 1 and say so once", "[app]") {
    for (const std::string name : {"noise.pgraph", "noise.sdl"}) {
        write(name, std::string("\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR", 16));
        for (const char* command : {"check ", "derive ", "translate ", "run "}) {
            const Outcome outcome = run(command + name);
            INFO(command << name << ": " << outcome.err);
            CHECK(outcome.code == 1);
            CHECK(outcome.out + outcome.err == name + " is a binary file, not the text of a model\n");
        }
    }
    for (const std::string name : {"folder.pgraph", "folder.sdl"}) {
        fs::create_directories(path() / name);
        CHECK_THAT(run("run " + name).err, Contains(name + " holds no model"));
        CHECK_THAT(run("translate " + name).err, Contains("cannot read " + name + ": it is a folder"));
        CHECK_THAT(run("run lost_" + name).err, Contains("No such file"));
    }
    CHECK_FALSE(fs::exists(path() / "output"));
}

TEST_CASE_METHOD(Workplace, "graphs and skeletons are read however their lines end, with the mark of UTF-8 or not",
                 "[app]") {
    for (const auto& [name, text] : {std::pair{"plant.pgraph", graph}, {"plant.sdl", skeleton}}) {
        write(name, text);
        const std::string derived = run(std::string("derive ") + name).out;
        CHECK(derived.size() > 20);
        for (const std::string& other :
             {with_line_ends(text, "\r\n"), with_line_ends(text, "\r"), "\xEF\xBB\xBF" + text}) {
            write(name, other);
            CHECK(run(std::string("derive ") + name).out == derived);
        }
    }
}

TEST_CASE_METHOD(Workplace, "graphs and skeletons that outgrow --memory stop with what was recorded before", "[app]") {
    write("flood.pgraph", "pgraph 1\nHydra star\n  count 100\n  recursion 9\ncamera -> star -> star\n");
    write("flood.sdl", "define{ a[0,1,0,0]; } rules{ a -> (a*100); } generations 9;");
    for (const std::string name : {"flood.pgraph", "flood.sdl"}) {
        const Outcome outcome = run("run " + name + " --quiet --memory 64M --overwrite --output out");
        INFO(outcome.err);
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err, Contains("step 3") && Contains("modules") && Contains("of memory"));
        const auto record = nlohmann::json::parse(text_of(path() / "out/run.json"));
        CHECK_THAT(record["exit"].get<std::string>(), Contains("failed: "));
        CHECK(record["steps_done"] == 2);
        CHECK(fs::exists(path() / "out/statistics.csv"));
    }
}

TEST_CASE_METHOD(Workplace, "a folder with a graph or a skeleton is an object", "[app]") {
    fs::create_directories(path() / "straw");
    write("straw/straw.sdl", skeleton);
    CHECK(run("derive straw --steps 2").out == run("derive straw/straw.sdl --steps 2").out);
    CHECK(run("check straw").code == 0);
    CHECK(run("run straw --steps 2 --quiet --output out").code == 0);
    write("straw/stem.pgraph", graph);
    const Outcome outcome = run("run straw");
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.err, Contains("stem.pgraph, straw.sdl"));
}
