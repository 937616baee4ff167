// Any bytes as what a client sends: each line is a request to a studio that has a small model open. Each must be
// answered, whatever it holds; so links (read-link, open-text) are tried as well.
#include "../studio/listening_page.h"
#include "../temporary_folder.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>

namespace {

using namespace studio_test;
namespace fs = std::filesystem;

constexpr int inputs_of_one_studio = 500;
const char* const stalk = "lsystem: 1\nderivation length: 2\naxiom: A\nA --> F(1)A\nendlsystem\n";

/// A studio without a network, on folders of its own.
class Studio {
public:
    Studio() {
        options_.folder = folder_.path();
        options_.scratch = scratch_.path();
        options_.state = scratch_.path() / "state.json";
        options_.library_folder = library_.path();
        options_.opened.path = folder_.write("stalk.l", stalk);
        options_.read = read_as_run;
        options_.library = [] { return std::vector<espalier::studio::LibraryEntry>(); };
        session_ = std::make_unique<espalier::studio::Session>(
            options_, [this](std::function<void()> work) { mailbox_.post(std::move(work)); });
        session_->join(page_);
        receive(R"({"do": "hello", "id": 1})");
    }
    ~Studio() { session_.reset(); }

    void receive(const std::string& request) {
        page_.texts.clear();
        page_.packets.clear();
        session_->receive(page_, request);
        const auto is_reply = [](const Json& text) { return text.contains("reply"); };
        if (std::none_of(page_.texts.begin(), page_.texts.end(), is_reply)) std::abort();
    }
    void work() {
        session_->tick();
        while (mailbox_.work_once(std::chrono::milliseconds(0))) {
        }
    }
    /// Nothing beside its folders, and in them no name that it does not write.
    bool is_clean() const {
        for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with('.') && name != ".came-by-a-link") return false;
        }
        return true;
    }

private:
    TemporaryFolder folder_, scratch_, library_;
    espalier::StudioOptions options_;
    Mailbox mailbox_;
    ListeningPage page_;
    std::unique_ptr<espalier::studio::Session> session_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static std::unique_ptr<Studio> studio;
    static int inputs = 0;
    if (!studio || ++inputs % inputs_of_one_studio == 0) {
        if (studio && !studio->is_clean()) std::abort();
        studio.reset();
        studio = std::make_unique<Studio>();
    }
    std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
    for (std::string line; std::getline(lines, line);) studio->receive(line);
    studio->work();
    return 0;
}
