// Requests as no page makes them: each key in turn is taken out or has another value. Built with sanitizers, this finds
// what reads outside memory.
#include "session_fixture.h"

using namespace studio_test;

namespace {

const char* const stem = R"(#define LENGTH 2  /* of internodes; 0..10 */
lsystem: 1
derivation length: 3
axiom: A
A --> F(LENGTH) A
endlsystem
)";

/// One request of each kind, as a page makes it.
std::vector<Json> requests(const OpenStudio& studio, std::uint32_t growth) {
    const std::string file = studio.file.string();
    return {{{"do", "hello"}},
            {{"do", "help"}},
            {{"do", "library"}},
            {{"do", "open"}, {"path", file}},
            {{"do", "open-text"}, {"name", "other.l"}, {"content", stem}, {"steps", 2}, {"seed", 1}},
            {{"do", "change"}, {"texts", {{file, stem}}}, {"label", "text"}, {"transient", true}},
            {{"do", "change"}, {"settings", {{"LENGTH", 3}}}, {"seed", 7}, {"steps", 4}},
            {{"do", "graph"}, {"path", file}, {"what", "value"}, {"component", "a"}, {"key", "b"}, {"value", "1"}},
            {{"do", "undo"}},
            {{"do", "redo"}},
            {{"do", "grow"}, {"to", 4}},
            {{"do", "stop"}},
            {{"do", "look"}, {"step", 2}, {"held", growth}},
            {{"do", "frame"}, {"growth", growth}, {"step", 2}},
            {{"do", "column"}, {"growth", growth}, {"step", 2}, {"name", "age"}},
            {{"do", "pick"}, {"growth", growth}, {"step", 2}, {"module", 1}},
            {{"do", "field"}, {"growth", growth}, {"name", "light"}},
            {{"do", "save"}, {"path", "kept.l"}},
            {{"do", "export"}, {"format", "none"}, {"step", 2}, {"film", true}},
            {{"do", "dismiss"}, {"message", 1}}};
}

/// What a key may wrongly have; the first stands for its absence.
std::vector<Json> values() {
    return {Json::value_t::discarded,
            nullptr,
            true,
            -1,
            0,
            3.5,
            1e300,
            -1e300,
            4000000000,
            18446744073709551615u,
            "",
            "../x",
            "1e9",
            "\xff",
            std::string(5000, 'a'),
            Json::array(),
            Json::array({1, Json::array()}),
            Json::object(),
            {{"a", {{"b", nullptr}}}}};
}

}  // namespace

TEST_CASE("a request with any key missing or wrong is answered, and the studio goes on", "[studio]") {
    OpenStudio studio(stem);
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    const std::size_t kinds = requests(studio, 1).size();
    std::size_t asked = 0;
    std::uint32_t growth = 1;
    for (std::size_t kind = 0; kind < kinds; ++kind) {
        const Json plain = requests(studio, 1)[kind];
        for (const auto& [key, value] : plain.items()) {
            if (key == "do") continue;
            for (const Json& wrong : values()) {
                if (const Json last = page.last("growth"); !last.is_null()) growth = last["growth"];
                Json request = requests(studio, growth)[kind];
                wrong.is_discarded() ? static_cast<void>(request.erase(key)) : static_cast<void>(request[key] = wrong);
                INFO(request.dump(-1, ' ', false, Json::error_handler_t::replace));
                page.texts.clear();
                page.packets.clear();
                request["id"] = "asked";
                studio.session->receive(page, request.dump(-1, ' ', false, Json::error_handler_t::replace));
                CHECK(std::any_of(page.texts.begin(), page.texts.end(),
                                  [](const Json& text) { return text.value("reply", Json()) == "asked"; }));
                studio.session->tick();
                while (studio.mailbox.work_once(std::chrono::milliseconds(0))) {
                }
                ++asked;
            }
        }
    }
    CHECK(asked > 600);
    CHECK(!studio.ask({{"do", "open"}, {"path", studio.file.string()}}).contains("error"));
    studio.change({{"steps", 3}, {"seed", nullptr}, {"texts", {{studio.file.string(), stem}}}});
    studio.wait_until_grown();
    CHECK(page.last("growth")["step"] == 3);
}
