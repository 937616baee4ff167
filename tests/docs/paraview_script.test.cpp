// The script of docs/paraview, with the VTK of plain Python: what it does within ParaView needs ParaView.
#include "app/program.h"
#include "catch.h"

using Catch::Contains;

namespace {

const char* const script = ESPALIER_SOURCE_DIR "/docs/paraview/espalier.py";

bool python_has_vtk() {
    return std::system("/usr/bin/python3 -c 'import vtk' 2>/dev/null && command -v xvfb-run >/dev/null") == 0;
}

/// Runs the script behind a command that succeeds.
Outcome draw(const Workplace& place, const std::string& words) {
    const std::string python = " && xvfb-run -a /usr/bin/python3 '" + std::string(script) + "' ";
    return place.run("--version > version" + python + words);
}

}  // namespace

TEST_CASE_METHOD(Workplace, "the script for ParaView draws a run with the VTK of plain Python, too", "[docs]") {
    if (!python_has_vtk()) {
        WARN("skipped: no VTK for Python, or no xvfb-run");
        return;
    }
    write("bush.l", models::bush);
    REQUIRE(run("run bush.l --quiet --output bush").code == 0);
    const Outcome drawn = draw(*this, "bush bush.png birth");
    INFO(drawn.err);
    CHECK(drawn.code == 0);
    CHECK(text_of(path() / "bush.png").starts_with("\x89PNG"));
    const Outcome no_array = draw(*this, "bush bush.png brith");
    CHECK(no_array.code == 1);
    CHECK_THAT(no_array.err, Contains("the run has no array 'brith'; it has") && Contains("birth"));
    CHECK_THAT(draw(*this, "nowhere x.png").err, Contains("nowhere is not the folder of a run"));
}
