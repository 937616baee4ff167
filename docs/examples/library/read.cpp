#include <espalier/archive/recorded_run.h>

#include <cstdio>

int main(int, char** arguments) {
    const espalier::RecordedRun run(arguments[1]);
    for (const espalier::RecordedFrame& frame : run.frames()) {
        const auto internodes = internodes_of(run.geometry(frame));
        std::printf("step %d: %zu internodes\n", frame.step, internodes.size());
    }
}
