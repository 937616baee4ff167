// Any bytes as a file of a run's folder: the first byte says which, and the others are as a run left them. Whatever the
// file holds, those who read runs must end in a result or in words.
#include "espalier/archive/recorded_run.h"
#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "environment/light/sky/scene_sky.h"
#include "seeds_on_request.h"
#include "simulation/run/recorded_command.h"
#include "simulation/run/written_files.h"
#include "small_run.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>

namespace {

using namespace espalier;
namespace fs = std::filesystem;

constexpr std::size_t longest = 1 << 16;
constexpr std::array names{"run.json",   "plants.pvd",      "statistics.csv",  "lifespans.vtp",
                           "fields.pvd", "plants/0001.vtp", "plants/0003.vtp", "fields/light/0002.vti"};

void attempt(const std::function<void()>& read) {
    try {
        read();
    } catch (const UserError&) {
    } catch (const RunError&) {
    }
}

void read_all(const fs::path& folder) {
    attempt([&] { read_command(folder); });
    attempt([&] { simulation::files_before_run(folder); });
    attempt([&] { exit_of_run(folder); });
    attempt([&] { environment::sky_of_run(folder); });
    attempt([&] {
        const RecordedRun run(folder);
        attempt([&] { run.statistics().last_rows(); });
        attempt([&] { run.lifespans(); });
        for (const RecordedFrame& frame : run.frames()) {
            attempt([&] { run.geometry(frame); });
            attempt([&] { run.field(frame, "light"); });
        }
    });
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    write_seeds_if_asked([](const auto& write) {
        const fuzz::SmallScene small;
        small.record();
        for (std::size_t i = 0; i < names.size(); ++i) {
            write(fs::path(names.at(i)).filename().string(),
                  std::string(1, static_cast<char>(i)) + read_text(small.run_folder() / names.at(i)));
        }
    });
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::SmallScene small;
    static const bool is_recorded = (small.record(), true);
    if (!is_recorded || size < 1 || size > longest) return 0;
    const fs::path file = small.run_folder() / names.at(data[0] % names.size());
    const std::string whole = read_text(file);
    write_text(file, std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
    read_all(small.run_folder());
    write_text(file, whole);
    return 0;
}
