// A setting swept through a range: what pages are told, and that the document stays as it was.
#include "session_fixture.h"

#include <algorithm>

using namespace espalier;
using namespace studio_test;

namespace {

const char* const stem = R"(#define COUNT 2     /* internodes; 0..9 whole */
#define STEPS 1
lsystem: 1
derivation length: STEPS
axiom: A(COUNT)
A(n) : n > 0 --> F(2) A(n-1)
decomposition
maximum depth: 20
A(n) : n > 0 --> F(2) A(n-1)
endlsystem
)";

class SweepingStudio : public OpenStudio {
public:
    SweepingStudio() : OpenStudio(stem) {}

    Json sweep(const std::string& name, const std::vector<std::string>& values) {
        return ask({{"do", "sweep"}, {"name", name}, {"values", values}});
    }
    std::vector<Json> all(const std::string& say) const {
        std::vector<Json> found;
        for (const Json& text : page.texts) {
            if (text.value("say", "") == say) found.push_back(text);
        }
        return found;
    }
    /// The newest value of a column of the statistics of a growth.
    double told(std::uint32_t growth, const std::string& column) const {
        double value = -1;
        for (const Json& table : all("statistics")) {
            if (table["growth"] != growth) continue;
            const auto& names = table["columns"];
            const auto at = std::find(names.begin(), names.end(), column) - names.begin();
            value = table["rows"].back()[static_cast<std::size_t>(at)];
        }
        return value;
    }
};

}  // namespace

TEST_CASE("a sweep grows a plant for each value, and the document stays as it was", "[studio]") {
    SweepingStudio studio;
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    const Json before = page.last("document");
    const Json growth = page.last("growth");
    const Json reply = studio.sweep("COUNT", {"1", "4", "7"});
    const std::uint32_t first = reply["first"];
    CHECK(first > growth["growth"]);
    studio.wait([&] { return studio.all("swept").size() == 3; });
    for (const std::uint32_t i : {0u, 1u, 2u}) {
        const double count = 1 + 3.0 * i;
        CHECK(studio.all("swept")[i]["growth"] == first + i);
        CHECK(studio.all("swept")[i]["reason"] == "");
        CHECK(studio.told(first + i, "internodes") == count);
        CHECK(studio.told(first + i, "height") == Approx(2 * count));
    }
    // The packets name their growths.
    std::vector<std::size_t> drawn;
    for (const std::string& bytes : page.packets) {
        if (bytes.starts_with("ESP1") && number_at<std::uint32_t>(bytes, 4) >= first)
            drawn.push_back(internodes(bytes));
    }
    CHECK(drawn == std::vector<std::size_t>{1, 4, 7});
    CHECK(page.last("document") == before);
    CHECK(page.last("growth") == growth);
}

TEST_CASE("a sweep goes on behind a plant that does not grow, and tells why", "[studio]") {
    SweepingStudio studio;
    studio.begin();
    studio.wait_until_grown();
    studio.sweep("STEPS", {"-1", "1"});
    studio.wait([&] { return studio.all("swept").size() == 2; });
    CHECK(studio.all("swept")[0]["reason"] != "");
    CHECK(studio.all("swept")[1]["reason"] == "");
}

TEST_CASE("a sweep of what is no setting, no value or too many is refused", "[studio]") {
    SweepingStudio studio;
    studio.begin();
    studio.wait_until_grown();
    CHECK(studio.sweep("NONE", {"1"}).contains("error"));
    CHECK(studio.sweep("COUNT", {"many"}).contains("error"));
    CHECK(studio.sweep("COUNT", {}).contains("error"));
    CHECK(studio.sweep("COUNT", std::vector<std::string>(25, "1")).contains("error"));
    CHECK(studio.all("swept").empty());
}

TEST_CASE("a sweep that is stopped tells nothing more, also in the midst of a step without end", "[studio]") {
    OpenStudio studio("#define N 1\nlsystem: 1\nderivation length: N\naxiom: A\nA --> AA\nendlsystem\n");
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    studio.ask({{"do", "sweep"}, {"name", "N"}, {"values", {"1", "60", "2"}}});
    studio.wait([&] { return !page.last("swept").is_null(); });
    CHECK_FALSE(studio.ask({{"do", "stop-sweep"}}).contains("error"));
    const std::size_t told = page.texts.size();
    studio.change({{"settings", {{"N", "3"}}}});
    studio.wait_until_grown();
    CHECK(std::none_of(page.texts.begin() + static_cast<std::ptrdiff_t>(told), page.texts.end(),
                       [](const Json& text) { return text.value("say", "") == "swept"; }));
}
