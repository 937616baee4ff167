// Requests as no page makes them: each key in turn is taken out or has another value. Built with sanitizers, this finds
// what reads outside memory.
#include "session_fixture.h"
#include "studio/session/request.h"

#include <algorithm>
#include <set>

using namespace studio_test;

namespace {

const char* const long_stem = R"(#define LENGTH 2  /* of internodes; 0..10 */
lsystem: 1
derivation length: 3
axiom: A
A --> F(LENGTH) A
endlsystem
)";

const char* const horn_graph = R"(pgraph 1

Horn stem
  length 2

Leaf petal

camera -> stem -> petal
)";

/// Requests as a page makes them, one of each kind or more. The last ones open another document.
std::vector<Json> requests(const OpenStudio& studio, std::uint32_t growth) {
    const std::string file = studio.file.string();
    return {
        {{"do", "hello"}},
        {{"do", "help"}},
        {{"do", "library"}},
        {{"do", "change"}, {"settings", {{"LENGTH", "3"}}}, {"seed", 7}, {"steps", 4}},
        {{"do", "graph"}, {"path", file}, {"edit", "set"}, {"component", "stem"}, {"key", "bend"}, {"text", "3"}},
        {{"do", "graph"}, {"path", file}, {"edit", "add"}, {"type", "Leaf"}, {"name", "a"}, {"from", "petal"}},
        {{"do", "graph"}, {"path", file}, {"edit", "unlink"}, {"from", "stem"}, {"to", "petal"}, {"kind", "child"}},
        {{"do", "graph"}, {"path", file}, {"edit", "link"}, {"from", "stem"}, {"to", "petal"}, {"kind", "child"}},
        {{"do", "graph"}, {"path", file}, {"edit", "remove"}, {"component", "petal"}},
        {{"do", "points"}, {"path", file}, {"number", 0}, {"points", {{{"x", 0}, {"y", 0}, {"z", 0}, {"times", 1}}}}},
        {{"do", "view-value"}, {"path", file}, {"name", "light:"}, {"number", 0}, {"letter", "A"}, {"values", "1"}},
        {{"do", "change"}, {"texts", {{file, long_stem}}}, {"label", "text"}, {"transient", true}},
        {{"do", "undo"}},
        {{"do", "redo"}},
        {{"do", "grow"}, {"to", 4}},
        {{"do", "stop"}},
        {{"do", "go-on"}},
        {{"do", "sweep"}, {"name", "LENGTH"}, {"values", Json::array({"1", "2"})}},
        {{"do", "stop-sweep"}},
        {{"do", "measure"}, {"name", "course.csv"}, {"content", "aGVpZ2h0CjEK"}},
        {{"do", "forget-measured"}, {"number", 1}},
        {{"do", "fit"}, {"settings", {{{"name", "LENGTH"}, {"lowest", 1}, {"highest", 2}}}}},
        {{"do", "stop-fit"}},
        {{"do", "look"}, {"step", 2}, {"held", growth}},
        {{"do", "frame"}, {"growth", growth}, {"step", 2}},
        {{"do", "column"}, {"growth", growth}, {"step", 2}, {"name", "age"}},
        {{"do", "pick"}, {"growth", growth}, {"step", 2}, {"module", 1}},
        {{"do", "field"}, {"growth", growth}, {"step", 2}, {"name", "light"}},
        {{"do", "limbs"}, {"growth", growth}, {"step", 2}, {"skin", "tubes"}},
        {{"do", "export"}, {"format", "none"}, {"step", 2}, {"film", true}},
        {{"do", "dismiss"}, {"message", 1}},
        {{"do", "new-file"}, {"name", "bark.bark"}, {"content", "stripes = 3\n"}},
        {{"do", "settle"}, {"path", file}, {"take", "mine"}},
        {{"do", "save"}, {"path", "kept.l"}},
        {{"do", "open"}, {"path", file}},
        {{"do", "share"}},
        {{"do", "read-link"},
         {"main", "other.l"},
         {"files", Json::array({{{"path", "other.l"}, {"content", long_stem}}})}},
        {{"do", "open-text"},
         {"main", "other.l"},
         {"files", Json::array({{{"path", "other.l"}, {"content", long_stem}}})},
         {"steps", 2},
         {"seed", 1}}};
}

/// What a key may wrongly have; the first stands for its absence.
const std::vector<Json>& wrong_values() {
    static const std::vector<Json> values{Json::value_t::discarded,
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
    return values;
}

/// Sends the request; true if it was answered.
bool is_answered(OpenStudio& studio, Json request) {
    studio.page.texts.clear();
    studio.page.packets.clear();
    constexpr int number = 4711;
    request["id"] = number;
    studio.session->receive(studio.page, request.dump(-1, ' ', false, Json::error_handler_t::replace));
    const bool answered = std::any_of(studio.page.texts.begin(), studio.page.texts.end(),
                                      [](const Json& text) { return text.value("reply", Json()) == number; });
    studio.session->tick();
    while (studio.mailbox.work_once(std::chrono::milliseconds(0))) {
    }
    return answered;
}

/// Every request with every key wrong, and as it should be. Returns how many.
std::size_t ask_wrongly(OpenStudio& studio) {
    std::size_t asked = 0;
    std::uint32_t growth = 1;
    for (std::size_t kind = 0; kind < requests(studio, growth).size(); ++kind) {
        const Json plain = requests(studio, growth)[kind];
        for (const auto& [key, value] : plain.items()) {
            for (const Json& wrong : wrong_values()) {
                if (const Json last = studio.page.last("growth"); !last.is_null()) growth = last["growth"];
                Json request = requests(studio, growth)[kind];
                if (wrong.is_discarded()) {
                    request.erase(key);
                } else {
                    request[key] = wrong;
                }
                INFO(request.dump(-1, ' ', false, Json::error_handler_t::replace));
                CHECK(is_answered(studio, request));
                ++asked;
            }
        }
        CHECK(is_answered(studio, plain));
    }
    return asked;
}

}  // namespace

TEST_CASE("a request with any key missing or wrong is answered, and the studio goes on", "[studio]") {
    const bool is_graph = GENERATE(false, true);
    OpenStudio studio(is_graph ? horn_graph : long_stem, is_graph ? "plant.pgraph" : "plant.l");
    studio.begin();
    studio.wait_until_grown();
    CHECK(ask_wrongly(studio) > 1000);

    const std::filesystem::path whole = studio.folder.write("whole.l", long_stem);
    CHECK(!studio.ask({{"do", "open"}, {"path", whole.string()}}).contains("error"));
    studio.wait_until_grown();
    CHECK(studio.page.last("growth")["step"] == 3);
}

TEST_CASE("every request of the protocol is asked wrongly", "[studio]") {
    OpenStudio studio(long_stem);
    std::set<std::string> known, named;
    for (const Json& request : requests(studio, 1)) known.insert(request["do"]);
    for (const auto& [name, request] : espalier::registered<espalier::studio::RequestType>()) named.insert(name);
    CHECK(known == named);
}
