// Any bytes as a checkpoint that bears the right seal: the first byte says whether it is that of a world or of a
// timeline. A world that was restored must bear two more steps.
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/simulation/world_checkpoint.h"
#include "espalier/timeline/timeline.h"

#include "seeds_on_request.h"
#include "small_run.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>

namespace {

using namespace espalier;
namespace fs = std::filesystem;

constexpr std::size_t longest = 1 << 16;
constexpr std::size_t memory = std::size_t{1} << 26;

std::shared_ptr<Printout> silence() {
    return std::make_shared<Printout>([](const std::string&) {});
}

void restore_world(const fuzz::SmallScene& small, const std::string& bytes) {
    World world(small.scene(), {.memory = memory, .files = small.folder() / "files", .printout = silence()});
    std::istringstream in(bytes);
    WorldCheckpoint(world).restore(in);
    for (int step = 0; step < 2 && !world.at_end(); ++step) world.step();
}

std::string saved_world(const fuzz::SmallScene& small) {
    World world(small.scene(), {.memory = memory, .files = small.folder() / "files", .printout = silence()});
    world.start();
    world.step();
    std::ostringstream out;
    WorldCheckpoint(world).save(out);
    return out.str();
}

std::string saved_timeline(const fuzz::SmallScene& small) {
    World world(small.scene(), {.memory = memory, .files = small.folder() / "files", .printout = silence()});
    Timeline timeline(small.run_folder(), small.scene().timeline, 4, /*overwrite=*/true);
    world.attach(timeline);
    world.start();
    world.step();
    std::ostringstream out;
    timeline.save(out);
    return out.str();
}

// On the files that it was saved with, which a restored one may cut.
void restore_timeline(const fuzz::SmallScene& small, const std::string& bytes) {
    static const std::string rows = (saved_timeline(small), read_text(small.run_folder() / "statistics.csv"));
    write_text(small.run_folder() / "statistics.csv", rows);
    World world(small.scene(), {.memory = memory, .files = small.folder() / "files", .printout = silence()});
    Timeline timeline(small.run_folder(), small.scene().timeline, 4, bytes);
    world.attach(timeline);
    world.start();
    timeline.finish();
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    write_seeds_if_asked([](const auto& write) {
        const fuzz::SmallScene small;
        write("world", std::string(1, '\0') + saved_world(small));
        write("timeline", std::string(1, '\1') + saved_timeline(small));
    });
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::SmallScene small;
    if (size < 1 || size > longest) return 0;
    const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        data[0] % 2 == 0 ? restore_world(small, bytes) : restore_timeline(small, bytes);
    } catch (const UserError&) {
    } catch (const RunError&) {
    }
    return 0;
}
