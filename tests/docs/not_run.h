// Commands of the pages that a test cannot run, each with its reason. An entry that no page has any more is an error.
#pragma once

#include <string>
#include <vector>

namespace pages {

struct NotRun {
    std::string page;
    std::string command;
    std::string reason;
    std::string needs;  ///< a program: the command is run where this program is installed
};

inline const std::vector<NotRun>& not_run() {
    static const std::vector<NotRun> list = {
        {"README.md", "./dev run environments/two-trees.toml", ".ci/run runs it with fewer steps", ""},
        {"README.md", "./dev test", ".ci/run runs it, and it runs this test", ""},
        {"README.md", "espalier view output/two-trees",
         "opens a window that stays until the user closes it; tests/app/view.test.cpp drives one", ""},
        {"README.md", "sudo apt install ./build/packages/*.deb",
         "./dev packages --check installs them into a Debian of its own", ""},
        {"docs/installing.md", "./dev packages", "builds everything once more", ""},
        {"docs/installing.md", "sudo apt install ./build/packages/*.deb",
         "./dev packages --check installs them into a Debian of its own", ""},
        {"packaging/README.md", "python3 -m venv --system-site-packages venv", "belongs to the next command", ""},
        {"packaging/README.md", "venv/bin/pip install --no-build-isolation .", "builds everything once more", ""},
        {"docs/studio.md", "espalier studio", "serves until the user ends it; ./dev page --check uses it", ""},
        {"docs/studio.md", "espalier studio models/trees/honda.l",
         "serves until the user ends it; ./dev page --check uses it", ""},
        {"docs/studio.md", "espalier studio output/two-trees",
         "serves until the user ends it; ./dev page --check uses one", ""},
        {"docs/studio.md", "espalier studio environments/two-trees.toml",
         "serves until the user ends it; ./dev page --check uses it", ""},
        {"docs/studio.md", "espalier studio --no-browser --port 8700",
         "serves until the user ends it; tests/app/studio.test.cpp starts one", ""},
        {"docs/studio.md", "ssh -L 8700:127.0.0.1:8700 HOST espalier studio --no-browser --port 8700",
         "needs another machine", ""},
        {"docs/program.md", "espalier studio models/trees/honda.l",
         "serves until the user ends it; ./dev page --check uses it", ""},
        {"README.md", "espalier studio models/trees/honda.l",
         "serves until the user ends it; ./dev page --check uses it", ""},
        {"CONTRIBUTING.md", "./dev page", "needs node, and builds the page that the program has", ""},
        {"CONTRIBUTING.md", "./dev protocol",
         "builds the program that this test belongs to; a test of it fails on drift", ""},
        {"CONTRIBUTING.md", "./dev build", "builds the program that this test belongs to", ""},
        {"CONTRIBUTING.md", "./dev test", "builds the program that this test belongs to", ""},
        {"CONTRIBUTING.md", "./dev check", "builds the program that this test belongs to", ""},
        {"CONTRIBUTING.md", "./dev check --threads", "builds all of what grows a second time", ""},
        {"CONTRIBUTING.md", "./dev format --check", "builds the program that this test belongs to", ""},
        {"CONTRIBUTING.md", "./dev bench --row context", "builds the program that this test belongs to", ""},
        {"CONTRIBUTING.md", "./dev fuzz model 60", "builds the program that this test belongs to", ""},
        {"CONTRIBUTING.md", "cmake --build --preset release --target test_turtle",
         "builds the program that this test belongs to", ""},
        {"CONTRIBUTING.md", "build/release/tests/test_turtle \"[turtle]\"", "ctest runs these tests", ""},
        {"docs/installing.md", "cmake --preset release -DESPALIER_LOOK=OFF -DESPALIER_TESTS=OFF",
         "configures the build of this test anew", ""},
        {"docs/installing.md", "cmake --build --preset release --target espalier_program",
         "builds the program that this test belongs to", ""},
        {"docs/installing.md", "docker run -it -v \"$PWD\":/espalier -w /espalier debian:12 ./dev build",
         "builds everything in a container", ""},
        {"docs/installing.md",
         "docker run -it -v \"$PWD\":/espalier -w /espalier debian:12 ./dev run environments/two-trees.toml",
         "builds what grows in a container", ""},
        {"CONTRIBUTING.md", "./dev site", "tests/docs/site.test.cpp builds the site where Sphinx is installed", ""},
        {"docs/clusters.md", "mpiexec -n 2 espalier run environments/forest.toml --output output/forest-on-two",
         "mpiexec must be told about root; tests/app/ranks.test.cpp does", ""},
        {"docs/clusters.md",
         "mpiexec -n 4 espalier run environments/forest.toml --output output/forest-on-four --checkpoint-every 10",
         "mpiexec must be told about root; tests/app/ranks.test.cpp does", ""},
        {"docs/clusters.md", "mpiexec -n 3 espalier resume output/forest-on-four",
         "needs a run that was interrupted; tests/app/ranks.test.cpp kills a rank", ""},
        {"docs/clusters.md", "sbatch --nodes=4 docs/run.slurm environments/forest.toml output/forest-on-nodes",
         "needs a cluster; tests/app/ranks.test.cpp runs docs/run.slurm", "sbatch"},
        {"docs/clusters.md",
         "mpiexec -n 4 apptainer exec espalier.sif espalier run environments/forest.toml --output "
         "output/forest-on-four",
         "needs a container", ""},
        {"docs/clusters.md", "mpiexec -n 8 pvserver", "serves until the user ends it", ""},
        {"docs/experiments.md", "./dev test -R experiments", "builds the program that this test belongs to", ""},
        {"docs/experiments.md", "build/release/tests/test_experiments \"[two-trees]\" -s", "ctest runs these tests",
         ""},
        {"docs/experiments/forest.md", "build/release/tests/test_experiments \"[forest],[forest-patch]\" -s",
         "ctest runs these tests", ""},
        {"docs/experiments/several-processes.md", "build/release/tests/test_experiments \"[processes]\" -s",
         "ctest runs these tests", ""},
        {"docs/experiments/topiary.md", "build/release/tests/test_experiments \"[topiary]\" -s",
         "ctest runs these tests", ""},
        {"docs/timeline.md", "pvpython docs/paraview/espalier.py output/two-trees trees.png birth",
         "ParaView's Python is not installed beside VTK's", "pvpython"},
        {"docs/library.md", "cmake -S . -B build && cmake --build build && build/grow",
         "tests/library builds and runs the examples of this page", ""},
        {"docs/library.md", "espalier run models/course/02-branching.l --steps 3 --output run && build/read run",
         "tests/library builds and runs the examples of this page", ""},
        {"docs/performance.md", "./dev bench", "builds the benchmarks, and measures for minutes", ""},
        {"docs/performance.md", "./dev bench --list", "builds the benchmarks, and measures for minutes", ""},
        {"docs/performance.md", "./dev bench --row context --row forest",
         "builds the benchmarks, and measures for minutes", ""},
        {"docs/program.md", "espalier resume output/two-trees",
         "needs a run that was interrupted; tests/app/resume.test.cpp interrupts some", ""},
        {"docs/program.md", "espalier view output/two-trees",
         "opens a window that stays until the user closes it; tests/app/view.test.cpp drives one", ""},
        {"docs/render.md", "espalier render output/two-trees --output growth.mp4", "ffmpeg writes this format",
         "ffmpeg"},
        {"docs/sweeps.md", "sbatch --array=1-$(wc -l < commands) docs/sweep.slurm",
         "needs a cluster; tests/app/repeat.test.cpp runs docs/sweep.slurm", "sbatch"},
        {"docs/view.md", "espalier view output/two-trees",
         "opens a window that stays until the user closes it; tests/app/view.test.cpp drives one", ""},
        {"docs/view.md", "espalier view environments/two-trees.toml",
         "opens a window that stays until the user closes it; tests/app/view.test.cpp drives one", ""},
        {"docs/view.md", "espalier view models/course/02-branching.l --steps 6",
         "opens a window that stays until the user closes it; tests/app/view.test.cpp drives one", ""},
    };
    return list;
}

}  // namespace pages
