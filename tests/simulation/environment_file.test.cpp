#include "simulation/object/environment_file.h"

#include "catch.h"
#include "temporary_folder.h"

using namespace espalier;
using namespace espalier::simulation;
using Catch::Contains;

namespace {

class EnvironmentFolder {
public:
    EnvironmentFolder() { folder_.write("plant.spec", "verbose: on\n"); }
    EnvironmentFile read(const std::string& text) const {
        return read_environment_file(folder_.write("plant.e", text));
    }
    std::string message(const std::string& text) const {
        try {
            read(text);
        } catch (const UserError& error) {
            return error.what();
        }
        return "no error";
    }
    const TemporaryFolder& folder() const { return folder_; }

private:
    TemporaryFolder folder_;
};

}  // namespace

TEST_CASE_METHOD(EnvironmentFolder, "the executable names the process, its plain argument the parameters",
                 "[simulation]") {
    for (const char* command : {"shape -e plant.e plant.spec", " shape plant.spec",
                                "/usr/local/bin/shape.exe plant.spec", "shape -k 17 plant.spec -e other.e"}) {
        INFO(command);
        const EnvironmentFile file = read(std::string("executable:") + command + "\n");
        REQUIRE(file.processes.size() == 1);
        CHECK(file.processes[0].first == "shape");
        CHECK(file.processes[0].second.text("process") == "shape");
        CHECK(file.processes[0].second.path("parameters") == folder().path() / "plant.spec");
        CHECK(file.processes[0].second.place("parameters").line == 1);
        CHECK(file.diagnostics.empty());
        CHECK_FALSE(file.routed);
    }
    CHECK_FALSE(read("executable: shape\n").processes[0].second.has("parameters"));
    CHECK(read("\xEF\xBB\xBF"
               "executable: shape\n")
              .diagnostics.empty());
    CHECK(read("executable: shape plant.spec more -x\n").diagnostics.size() == 2);
}

TEST_CASE_METHOD(EnvironmentFolder, "formats keep their blanks, and questions travel with six digits", "[simulation]") {
    const EnvironmentFile file = read(
        "executable: shape\ncommunication type: memory\n\nturtle position:P: %.4f %.0f %.4f\nturtle heading: %f %f %f\n"
        "turtle line width: %g\nfollowing module: no\nverbose: on\r\n");
    const Settings& table = file.processes[0].second;
    CHECK(table.table("turtle").text("position") == "P: %.4f %.0f %.4f");
    CHECK(table.table("turtle").text("heading") == " %f %f %f");
    CHECK(table.table("turtle").text("line_width") == " %g");
    CHECK(table.integer("digits") == 6);
    CHECK_FALSE(table.flag_or("following_module", true));
    CHECK(file.diagnostics.empty());
    CHECK(file.unused == std::vector<std::string>{"communication type", "verbose"});
}

TEST_CASE_METHOD(EnvironmentFolder, "binary data is not rounded, and the following module is sent unless forbidden",
                 "[simulation]") {
    const Settings table = read("executable: shape\nbinary data: on\n").processes[0].second;
    CHECK_FALSE(table.has("digits"));
    CHECK(table.flag_or("following_module", true));
}

TEST_CASE_METHOD(EnvironmentFolder, "a keyword that is not exact is ignored with a warning", "[simulation]") {
    const EnvironmentFile file = read("Executable: x\nexecutable: shape\nturtle position : %f %f %f\n");
    CHECK_FALSE(file.processes[0].second.has("turtle"));
    REQUIRE(file.diagnostics.size() == 2);
    CHECK_THAT(to_string(file.diagnostics[0]), Contains("plant.e:1:1") && Contains("did you mean 'executable'?"));
    CHECK(file.processes[0].second.place("process").line == 2);
}

TEST_CASE_METHOD(EnvironmentFolder, "a process nobody provides is an error that names those there are",
                 "[simulation]") {
    const std::string text = message("executable: shap plant.spec\n");
    CHECK_THAT(text, Contains("plant.e:1:1") && Contains("did you mean 'shape'?") && Contains("voxel-shade") &&
                         Contains("--without-environment"));
    CHECK_THAT(message(""), Contains("plant.e") && Contains("executable"));
    CHECK_THAT(message("executable:\n"), Contains("executable"));
    CHECK_THAT(message("executable: shape lost.spec\n"), Contains("plant.e:1:1") && Contains("lost.spec"));
    CHECK_THAT(message("executable: shape\nturtle position: %s\n"), Contains("plant.e:2:1"));
    CHECK(message(std::string("\0\xff:\t::\t\n", 8)) != "no error");
}

TEST_CASE_METHOD(EnvironmentFolder, "a program of cpfg that is missing is an error that names what is near to it",
                 "[simulation]") {
    const std::string text = message("turtle position: %f %f %f\nexecutable: soil a.spec\n");
    CHECK_THAT(text, Contains("plant.e:2") && Contains("in purpose is 'soil-water'"));
    CHECK_THAT(message("executable: shap plant.spec\n"), !Contains("in purpose"));
}

TEST_CASE_METHOD(EnvironmentFolder, "programs of cpfg that follow rays are ray-light, which reads their parameters",
                 "[simulation]") {
    for (const std::string program : {"QuasiMC", "MonteCarlo", "radiosity"}) {
        const EnvironmentFile file = read("executable: " + program + " -e plant.e plant.spec -no_xserver\n");
        REQUIRE(file.processes.size() == 1);
        CHECK(file.processes[0].first == program);
        const Settings& table = file.processes[0].second;
        CHECK(table.text("process") == "ray-light");
        CHECK(table.text("program") == program);
        CHECK(table.path("parameters") == folder().path() / "plant.spec");
        CHECK(file.diagnostics.empty());
        CHECK_THAT(message("executable: " + program + "\n"), Contains("plant.e:1") && Contains("FILE.spec"));
    }
}

TEST_CASE_METHOD(EnvironmentFolder, "a program of one's own is named with its folder", "[simulation]") {
    folder().write("mine", "");
    const EnvironmentFile file = read(
        "turtle position: P:%.2f %g %g\nexecutable: ./mine -v plant.spec\ncommunication type: pipes 10\ntimeout: "
        "2.5\n");
    REQUIRE(file.processes.size() == 1);
    CHECK(file.processes[0].first == "mine");
    const Settings& table = file.processes[0].second;
    CHECK(table.text("process") == "external");
    CHECK(table.texts_or("command", {}) ==
          std::vector<std::string>{(folder().path() / "mine").string(), "-e", "plant.e", "-v", "plant.spec"});
    CHECK(table.path("folder") == folder().path());
    CHECK(table.number("timeout") == 2.5);
    CHECK(table.integer("digits") == 6);
    CHECK(table.table("turtle").text("position") == " P:%.2f %g %g");
    CHECK(table.place("command").line == 2);
    CHECK(file.diagnostics.empty());

    folder().write("a.e", "executable: ./mine\n");
    folder().write("fields", "field communication file: a.e\n");
    CHECK(read("executable: multiple fields\n").processes.at(0).first == "mine-0");
    CHECK(read("executable: ./mine\ninterpreted modules: all\n").diagnostics.size() == 1);
    CHECK_THAT(message("executable: ./lost\n"), Contains("plant.e:1:1") && Contains("there is no file './lost'"));
    CHECK_THAT(message("executable: mine\n"), Contains("named with its folder, as ./mine"));
    CHECK_THAT(message("executable: ./mine\ntimeout: 2, x = 1\n"), Contains("plant.e:2:1") && Contains("seconds"));
}

TEST_CASE_METHOD(EnvironmentFolder, "programs of cpfg answer as there, with and without a file of parameters",
                 "[simulation]") {
    CHECK(read("executable: clover\n").processes[0].second.text("numbers") == "cpfg");
    CHECK(read("executable: density plant.spec\n").processes[0].second.text("numbers") == "cpfg");
    folder().write("ours.toml", "numbers = \"exact\"\n");
    CHECK(read("executable: density ours.toml\n").processes[0].second.text("numbers") == "exact");
    CHECK_FALSE(read("executable: voxel-shade\n").processes[0].second.has("numbers"));
}

TEST_CASE_METHOD(EnvironmentFolder, "several environment files stand behind one process", "[simulation]") {
    folder().write("a.e", "executable: shape plant.spec\n");
    folder().write("b.e", "executable: voxel-shade\nturtle position: %.0f %.0f %.0f\n");
    folder().write("fields", "field communication file: a.e\nverbose: on\nfield communication file: b.e\nnonsense\n");
    const EnvironmentFile file = read("executable: multiple -e plant.e fields\n");
    CHECK(file.routed);
    REQUIRE(file.processes.size() == 2);
    CHECK(file.processes[0].first == "shape-0");
    CHECK(file.processes[1].first == "voxel-shade-1");
    CHECK(file.processes[1].second.table("turtle").text("position") == " %.0f %.0f %.0f");
    CHECK(file.files.size() == 5);
    CHECK(file.diagnostics.size() == 1);

    folder().write("fields", "field communication file: plant.e\n");
    CHECK_THAT(message("executable: multiple fields\n"), Contains("cannot be one of several"));
    CHECK_THAT(message("executable: multiple\n"), Contains("environment files"));
    folder().write("fields", "verbose: on\n");
    CHECK_THAT(message("executable: multiple fields\n"), Contains("field communication file"));
    folder().write("fields", "field communication file: lost.e\n");
    CHECK_THAT(message("executable: multiple fields\n"), Contains("fields:1:1") && Contains("lost.e"));
}
