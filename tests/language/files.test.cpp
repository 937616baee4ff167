#include "espalier/base/file.h"

#include "catch.h"
#include "language/growing.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// A folder for one test, with an input and an output folder in it.
struct Folders {
    fs::path root = fs::temp_directory_path() / ("espalier-files-" + std::to_string(getpid()));
    fs::path input = root / "in", output = root / "out";

    Folders() { fs::create_directories(input); }
    ~Folders() { fs::remove_all(root); }

    DerivationSettings settings() const {
        DerivationSettings made;
        made.input_folder = input;
        made.output_folder = output;
        return made;
    }
    void give(const std::string& name, const std::string& text) const { std::ofstream(input / name) << text; }
    std::string written(const std::string& name) const { return read_text(output / name); }
};

std::string with_start(const std::string& statements, const std::string& axiom, const std::string& header = "") {
    return "lsystem: 1\n" + header + "Start: {\n" + statements + "}\naxiom: " + axiom + "\nX --> X\nendlsystem\n";
}

}  // namespace

// "printf (to stderr), fopen fclose fprintf fscanf fflush"
TEST_CASE("a model reads numbers with fscanf, as C does", "[language]") {
    const Folders folders;
    folders.give("data.txt", "3 4.5\n-7e1, 0x1F end");
    const Grown plant(with_start("f = fopen(\"data.txt\", \"r\");\n"
                                 "n = fscanf(f, \"%d %lf\", &i, &a[1]);\n"
                                 "m = fscanf(f, \"%f , %i\", &x, &y);\n"
                                 "none = fscanf(f, \"%d\", &z);\n"
                                 "fscanf(f, \"%*s\");\n"
                                 "eof = fscanf(f, \"%d\", &z);\n"
                                 "c = fclose(f);\n",
                                 "A(n,i,a[1])B(m,x,y)C(none,eof,c)", "define: { array a[2]; }\n"),
                      folders.settings());
    CHECK(plant.text() == "A(2,3,4.5)B(2,-70,31)C(0,-1,0)");
}

TEST_CASE("what was not read keeps its value, and subscripts are those before the call", "[language]") {
    const Folders folders;
    folders.give("data.txt", "2 9");
    const Grown plant(with_start("i = 1; x = 5;\nf = fopen(\"data.txt\", \"r\");\n"
                                 "n = fscanf(f, \"%lf%lf%lf\", &i, &a[i], &x);\n",
                                 "A(n,i,a[1],a[2],x)", "define: { array a[3]; }\n"),
                      folders.settings());
    CHECK(plant.text() == "A(2,2,9,0,5)");
}

TEST_CASE("opening a file that is missing gives 0, as C does", "[language]") {
    const Folders folders;
    CHECK(Grown(with_start("f = fopen(\"nothing.txt\", \"r\");\n", "A(f)"), folders.settings()).text() == "A(0)");
    CHECK(Grown(with_start("f = fopen(\"nothing.txt\", \"r\");\n", "A(f)")).text() == "A(0)");
}

TEST_CASE("what a model writes lands in its own folder and can be read again", "[language]") {
    const Folders folders;
    folders.give("log.txt", "from the input\n");
    Grown plant(
        "lsystem: 1\nStart: { f = fopen(\"log.txt\", \"w\"); n = fprintf(f, \"%s %d\\n\", \"begin\", 12); }\n"
        "StartEach: { fprintf(f, \"step %g\\n\", Q); }\n"
        "axiom: A(n)\nA(x) : Q == 2 {fclose(f); g = fopen(\"log.txt\", \"r\"); fscanf(g, \"%*s %d step %d\", &a, &b);}"
        " --> A(a+b)\nendlsystem\n",
        folders.settings());
    CHECK(plant.text() == "A(9)");
    CHECK(folders.written("log.txt") == "begin 12\n");
    plant.steps(1);
    CHECK(folders.written("log.txt") == "begin 12\nstep 1\n");
    CHECK(plant.steps(1).text() == "A(13)");
    CHECK(folders.written("log.txt") == "begin 12\nstep 1\nstep 2\n");
    CHECK(read_text(folders.input / "log.txt") == "from the input\n");
    CHECK(has_order(*plant.compiled));
}

TEST_CASE("modes append, update and empty", "[language]") {
    const Folders folders;
    folders.give("old.txt", "abc");
    const Grown plant(with_start("f = fopen(\"old.txt\", \"a\"); fprintf(f, \"d\"); fclose(f);\n"
                                 "g = fopen(\"old.txt\", \"r+\"); fprintf(g, \"X\"); fflush(g);\n"
                                 "h = fopen(\"new.txt\", \"w+\"); fclose(h);\n"
                                 "e = fprintf(fopen(\"old.txt\", \"r\"), \"no\");\n",
                                 "A(e)"),
                      folders.settings());
    CHECK(folders.written("old.txt") == "Xbcd");
    CHECK(folders.written("new.txt").empty());
    CHECK(plant.text() == "A(-1)");
    CHECK(plant.said.find("no file 4 is open for that") != std::string::npos);
}

TEST_CASE("without a folder files stay in memory", "[language]") {
    const Grown plant(
        with_start("f = fopen(\"memory.txt\", \"w\"); fprintf(f, \"42\"); fclose(f);\n"
                   "f = fopen(\"memory.txt\", \"r\"); fscanf(f, \"%d\", &x);\n",
                   "A(x)"));
    CHECK(plant.text() == "A(42)");
    CHECK_FALSE(fs::exists("memory.txt"));
}

TEST_CASE("files outside the model's own folders are refused with their place", "[language]") {
    const Folders folders;
    fs::create_directory_symlink("/etc", folders.input / "way");
    std::ofstream(folders.root / "secret.txt") << "1";
    for (const char* name : {"/etc/passwd", "../secret.txt", "a/../../secret.txt", "way/passwd", ""}) {
        INFO(name);
        try {
            Grown plant(with_start("f = fopen(\"" + std::string(name) + "\", \"r\");\n", "A(f)"), folders.settings());
            FAIL("no error");
        } catch (const RunError& error) {
            CHECK(std::string(error.what()).starts_with("model.l:3:5: fopen: '" + std::string(name) + "'"));
        }
    }
    CHECK_THROWS_AS(Grown(with_start("f = fopen(\"x\", \"q\");\n", "A(f)"), folders.settings()), RunError);
}

TEST_CASE("files that are not open give -1 and one warning, and too many are not opened", "[language]") {
    const Grown plant(
        with_start("for (i = 0; i < 3; i++) { a = fclose(99); b = fscanf(0, \"%d\", &x); }\n"
                   "for (i = 0; i < 1001; i++) { f = fopen(\"many.txt\", \"w\"); }\n",
                   "A(a,b,f)"));
    CHECK(plant.text() == "A(-1,-1,0)");
    CHECK(std::count(plant.said.begin(), plant.said.end(), '\n') == 2);
}

TEST_CASE("formats that would read texts into numbers are refused", "[language]") {
    CHECK(failure(with_start("fscanf(3, \"%s\", &x);\n", "A"), 0).find("gives a text") != std::string::npos);
    CHECK(failure(with_start("fscanf(3, \"%d\");\n", "A"), 0).find("asks for 1 values") != std::string::npos);
    CHECK(failure(with_start("fscanf(3, \"%q\", &x);\n", "A"), 0).find("not a conversion") != std::string::npos);
    CHECK(failure(with_start("fscanf(3, \"%[a\", &x);\n", "A"), 0).find("never closed") != std::string::npos);
}

TEST_CASE("open files and what was written go through a checkpoint", "[language]") {
    const Folders folders;
    folders.give("data.txt", "1 2 3 4 5 6");
    const std::string model =
        "lsystem: 1\nStart: { f = fopen(\"data.txt\", \"r\"); o = fopen(\"log.txt\", \"w\"); }\n"
        "StartEach: { fscanf(f, \"%d\", &x); fprintf(o, \"%g;\", x); }\naxiom: A(0)\nA(y) --> A(x)\nendlsystem\n";
    Grown first(model, folders.settings());
    first.steps(3);
    std::stringstream checkpoint;
    first.derivation.save(checkpoint);
    fs::remove_all(folders.output);
    Grown second(model, folders.settings());
    second.derivation.restore(checkpoint);
    second.string = first.string;
    CHECK(second.steps(2).text() == "A(5)");
    CHECK(folders.written("log.txt") == "1;2;3;4;5;");
}

TEST_CASE("what a model writes follows no link out of its folder, also one that leads to nothing yet", "[language]") {
    const Folders folders;
    const fs::path elsewhere = folders.root / "elsewhere";
    fs::create_directories(elsewhere);
    const std::string writes = with_start("f = fopen(\"log.txt\", \"w\"); fprintf(f, \"1\"); fclose(f);\n", "A");
    fs::create_directory_symlink(elsewhere, folders.output);
    CHECK_THROWS_WITH(Grown(writes, folders.settings()), Contains("out is a link, which is not followed"));
    fs::remove(folders.output);
    fs::create_directories(folders.output);
    fs::create_symlink(elsewhere / "new.txt", folders.output / "log.txt");
    CHECK_THROWS_WITH(Grown(writes, folders.settings()), Contains("a link that leads out of the model's folder"));
    CHECK(fs::is_empty(elsewhere));
    fs::remove(folders.output / "log.txt");
    CHECK_NOTHROW(Grown(writes, folders.settings()));
    CHECK(folders.written("log.txt") == "1");
}

TEST_CASE("a checkpoint names no file outside the model's own folders", "[language]") {
    const Folders folders;
    folders.give("data.txt", "1 2 3 4 5 6");
    for (const std::string& mode : {std::string("w"), std::string("r")}) {
        Grown plant("lsystem: 1\nStart: { f = fopen(\"data.txt\", \"" + mode + "\"); }\naxiom: A\nendlsystem\n",
                    folders.settings());
        std::ostringstream out;
        plant.derivation.save(out);
        for (const std::string& name : {std::string("../a.txt"), std::string("/tmp/a.b")}) {
            std::string bytes = out.str();
            for (std::size_t at = 0; (at = bytes.find("data.txt")) != std::string::npos;) bytes.replace(at, 8, name);
            std::istringstream in(bytes);
            CHECK_THROWS_WITH(plant.derivation.restore(in), Contains("the checkpoint is damaged: fopen: '" + name));
        }
    }
}
