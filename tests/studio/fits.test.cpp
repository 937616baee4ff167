// What was measured, and a fit to it, as pages see them. What compares and searches is of this test: it tries whole
// numbers, and measures the modules of the string that grows.
#include "espalier/base/file.h"
#include "espalier/base/stop.h"
#include "espalier/simulation/world.h"

#include "base/base64.h"
#include "session_fixture.h"

#include <cmath>
#include <thread>

using namespace espalier;
using namespace studio_test;

namespace {

const char* const steps_of_stem = R"(#define UP 2     /* internodes; 0..9 */
#define SIDE 7   /* internodes of the branch; 0..9 */
lsystem: 1
derivation length: 1
axiom: A
A --> X(UP)[X(SIDE)]
decomposition
maximum depth: 20
X(n) : n > 0 --> F X(n-1)
endlsystem
)";

double length_of(const Scene& scene) {
    World world(scene);
    world.start();
    while (!world.at_end()) world.step();
    return static_cast<double>(world.modules());
}

/// The sum of the numbers is found, each as small as can be.
studio::FitOutcome sought(const studio::FitOrder& order) {
    const double measured = *static_cast<const double*>(order.measured.at(0).get());
    studio::FitOutcome outcome;
    double least = 1e9;
    const auto [name, start, lowest, highest, is_whole] = order.sought.at(0);
    for (double value = std::ceil(lowest); value <= highest; ++value) {
        end_if_asked();
        const double grown = length_of(order.scene(std::vector<std::pair<std::string, double>>{{name, value}}));
        if (std::abs(grown - measured) < least) {
            least = std::abs(grown - measured);
            outcome.numbers = {{value, std::nan(""), true}};
            outcome.predicted = {grown};
        }
        order.progress({static_cast<std::size_t>(value), 9, {outcome.numbers[0].value}, least});
    }
    outcome.residual = least;
    return outcome;
}

studio::Measurement measurement_of(const std::filesystem::path& file) {
    const std::string text = read_text(file);
    if (text.find("elsewhere") != text.npos) read_text(text.substr(0, text.find('\n')));
    studio::Measurement measured;
    measured.values = {{"modules", std::stod(text), 1}};
    measured.points = {{0, 0.123456789, 0}};
    measured.notes = {"guessed"};
    measured.read = std::make_shared<const double>(std::stod(text));
    return measured;
}

class FittingStudio : public OpenStudio {
public:
    FittingStudio() : OpenStudio(steps_of_stem) { options.fitting = {measurement_of, sought}; }

    void wait_for(const char* message) {
        wait([this, message] { return !page.last(message).is_null(); });
    }
};

Json range(const std::string& name, double lowest, double highest) {
    return {{"name", name}, {"lowest", lowest}, {"highest", highest}};
}

Json fit_of(const Json& range) {
    return {{"do", "fit"}, {"settings", Json::array({range})}};
}

}  // namespace

TEST_CASE("a fit seeks the numbers of unsaved texts, and leaves the document as it is", "[fits]") {
    FittingStudio studio;
    studio.begin();
    studio.wait_until_grown();
    studio.change({{"settings", {{"UP", "4"}}}});
    studio.wait_until_grown();
    const double grown_first = length_of(studio.options.read(studio.options.opened));  // UP is 2 on disk
    // A branch of 5 instead of 7 beside the two more that UP has now: as many as on disk.
    studio.ask({{"do", "measure"}, {"name", "count.csv"}, {"content", base64(std::to_string(grown_first))}});
    studio.wait_for("measured");
    const Json file = studio.page.last("measured")["files"][0];
    CHECK(file["name"] == "count.csv");
    CHECK(file["points"] == Json::array({0.0, 0.12346, 0.0}));
    CHECK(file["notes"] == Json::array({"guessed"}));
    CHECK_FALSE(studio.ask(fit_of(range("SIDE", 0, 9))).contains("error"));
    studio.wait_for("fitted");
    const Json fitted = studio.page.last("fitted");
    CHECK(fitted["end"] == "done");
    CHECK(fitted["settings"][0]["name"] == "SIDE");
    CHECK(fitted["settings"][0]["value"] == 5);
    CHECK(fitted["settings"][0]["error"].is_null());
    CHECK(fitted["predicted"][0] == grown_first);
    CHECK(studio.page.last("fitting")["best"].contains("SIDE"));
    for (const Json& setting : studio.page.last("document")["settings"]) {
        if (setting["name"] == "SIDE") CHECK(setting["value"] == 7);
    }

    ListeningPage late;  // is told what was measured
    studio.session->join(late);
    studio.session->receive(late, R"({"do": "hello", "id": 1})");
    CHECK(late.last("measured")["files"].size() == 1);
    studio.session->leave(late);
    studio.ask({{"do", "forget-measured"}, {"number", file["number"]}});
    CHECK(studio.page.last("measured")["files"].empty());
}

TEST_CASE("what cannot be fitted is refused with a remedy", "[fits]") {
    FittingStudio studio;
    studio.begin();
    studio.wait_until_grown();
    CHECK_THAT(studio.ask(fit_of(range("UP", 0, 9))).value("error", ""), Catch::Contains("choose a file first"));
    studio.ask({{"do", "measure"}, {"name", "count.csv"}, {"content", base64("12")}});
    studio.wait_for("measured");
    for (const Json& wrong : {range("DOWN", 0, 9), range("UP", 3, 3), range("UP", 0, 10), range("UP", -1, 9)}) {
        INFO(wrong.dump());
        CHECK(studio.ask(fit_of(wrong)).contains("error"));
    }
    CHECK(studio.ask({{"do", "fit"}, {"settings", Json::array()}}).contains("error"));
    const Json twice = Json::array({range("UP", 0, 9), range("UP", 0, 9)});
    CHECK_THAT(studio.ask({{"do", "fit"}, {"settings", twice}}).value("error", ""), Catch::Contains("sought twice"));
    CHECK(studio.ask({{"do", "forget-measured"}, {"number", 77}}).contains("error"));

    // Files of pages read nothing but themselves, and places lie below the folder.
    const std::filesystem::path other = studio.folder.write("other.csv", "12");
    for (const char* name : {"points.toml", "../../.hidden", ""}) {
        CHECK(studio.ask({{"do", "measure"}, {"name", name}, {"content", base64("1")}}).contains("error"));
    }
    CHECK(studio.ask({{"do", "measure"}, {"name", "a.csv"}, {"content", "no base64!"}}).contains("error"));
    CHECK(studio.ask({{"do", "measure"}, {"name", "../outside.csv"}}).contains("error"));
    CHECK_FALSE(studio.ask({{"do", "measure"}, {"name", "other.csv"}}).contains("error"));
    const auto notes = studio.page.texts.size();
    studio.ask({{"do", "measure"}, {"name", "b.csv"}, {"content", base64(other.string() + "\nelsewhere")}});
    studio.wait([&] {
        for (std::size_t i = notes; i < studio.page.texts.size(); ++i) {
            if (studio.page.texts[i].value("say", "") == "message") return true;
        }
        return false;
    });

    studio.options.fitting = {};
    studio.begin();
    CHECK_THAT(studio.ask({{"do", "measure"}, {"name", "other.csv"}}).value("error", ""),
               Catch::Contains("needs the program"));
}

TEST_CASE("a fit ends when it is told to, and when the studio ends", "[fits]") {
    FittingStudio studio;
    studio.options.fitting.fit = [](const studio::FitOrder& order) -> studio::FitOutcome {
        for (std::size_t i = 0;; ++i) {
            end_if_asked();
            order.progress({i, i, {1}, 1});
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    };
    studio.begin();
    studio.wait_until_grown();
    studio.ask({{"do", "measure"}, {"name", "count.csv"}, {"content", base64("12")}});
    studio.wait_for("measured");
    studio.ask(fit_of(range("UP", 0, 9)));
    studio.wait_for("fitting");
    CHECK_THAT(studio.ask(fit_of(range("UP", 0, 9))).value("error", ""), Catch::Contains("another fit"));
    studio.ask({{"do", "stop-fit"}});
    studio.wait_for("fitted");
    CHECK(studio.page.last("fitted")["end"] == "stopped");
    CHECK_FALSE(studio.ask(fit_of(range("UP", 0, 9))).contains("error"));
    studio.session.reset();  // ends what goes on
}
