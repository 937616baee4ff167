#include "catch.h"
#include "environment/exchange/exchange_plants.h"
#include "temporary_folder.h"

using namespace espalier;
using namespace espalier::environment;

namespace {

/// The table of a soil that gets warm from above, and others.
class Tables {
public:
    Tables() { write("warmth.csv", "# degrees\ntime, 0, -0.5, -2\n0, 10, 8, 5\n10, 20, 12, 7\n"); }
    Environment environment(const std::string& table) const {
        const std::string text = "[light]\nprocess = 'profile'\nfile = '" + table + "'\n";
        const Settings file = Settings::parse_toml(text, "scene.toml", folder_.path());
        return Environment({{"light", file.table("light")}}, {});
    }
    void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
    std::string refusal(const std::string& text) const {
        write("wrong.csv", text);
        return message_of([&] { environment("wrong.csv"); });
    }

private:
    TemporaryFolder folder_;
};

std::vector<double> answers(Environment& environment, const std::vector<Asked>& questions, int step) {
    AskingPlants plants;
    plants.add(questions).exchange(environment, step);
    return plants.parameters();
}

}  // namespace

TEST_CASE_METHOD(Tables, "profile is linear in height and in time, with its slope upwards", "[profile]") {
    Environment soil = environment("warmth.csv");
    CHECK(answers(soil, {{{3, 0, 1}, {0}}, {{0, -0.25, 0}, {0, 0}}, {{0, -1.25, 0}, {0, 0}}}, 0) ==
          std::vector<double>{10, 9, 4, 6.5, 2});
    CHECK(answers(soil, {{{0, -0.25, 0}, {0, 0}}, {{0, -2, 0}, {0}}}, 4) == std::vector<double>{11.8, 8.8, 5.8});
    CHECK(answers(soil, {{{0, -0.25, 0}, {0, 0}}}, 10) == std::vector<double>{16, 16});
}

TEST_CASE_METHOD(Tables, "beyond its ends a profile goes on with their values, without slope", "[profile]") {
    Environment soil = environment("warmth.csv");
    CHECK(answers(soil, {{{0, 1, 0}, {7, 7}}, {{0, -9, 0}, {7, 7}}}, 0) == std::vector<double>{10, 0, 5, 0});
    write("constant.csv", "time, -1\n3, 4.5\n");
    Environment constant = environment("constant.csv");
    CHECK(answers(constant, {{{0, -1, 0}, {0, 7}}, {{0, -9, 0}, {0, 7}}}, 50) == std::vector<double>{4.5, 0, 4.5, 0});
}

TEST_CASE_METHOD(Tables, "a table that runs upwards answers as the one that runs downwards", "[profile]") {
    write("upwards.csv", "time, -2, -0.5, 0\n0, 5, 8, 10\n10, 7, 12, 20\n");
    Environment up = environment("upwards.csv"), down = environment("warmth.csv");
    for (int step = 0; step <= 10; ++step) {
        for (double y = 0.4; y > -2.5; y -= 0.13) {
            const std::vector<Asked> asked = {{{0, y, 0}, {0, 0}}};
            CHECK(answers(up, asked, step) == answers(down, asked, step));
        }
    }
}

TEST_CASE_METHOD(Tables, "a run that outlasts its profile ends with both times", "[profile]") {
    Environment soil = environment("warmth.csv");
    CHECK(lacks(message_of([&] {
                    answers(soil, {{{0, 0, 0}, {0}}}, 11);
                }),
                {"warmth.csv goes from time 0 to 10, but the run is at 11"}) == "");
}

TEST_CASE_METHOD(Tables, "profile refuses a wrong table with its line and column", "[profile]") {
    CHECK(lacks(message_of([&] { environment("none.csv"); }), {"none.csv"}) == "");
    CHECK(lacks(refusal("time, 0\n"), {"wrong.csv:1", "at least one line of values"}) == "");
    CHECK(lacks(refusal("time, 0, -1, -0.5\n0, 1, 2, 3\n"), {"wrong.csv:1", "rise or fall"}) == "");
    CHECK(lacks(refusal("time, 0, 0\n0, 1, 2\n"), {"wrong.csv:1", "rise or fall"}) == "");
    CHECK(lacks(refusal("time, 0, deep\n0, 1, 2\n"), {"wrong.csv:1:3", "'deep' is not a number"}) == "");
    CHECK(lacks(refusal("time, 0, -1\n0, 1, nan\n"), {"wrong.csv:2:3", "'nan' is not a number"}) == "");
    CHECK(lacks(refusal("time, 0, -1\n0, 1, -9999\n"),
                {"wrong.csv:2:3", "'-9999' stands for", "not measured", "write -9999.01"}) == "");
    write("dry.csv", "time, -1\n0, -9999.01\n");  // as it says
    Environment dry = environment("dry.csv");
    CHECK(answers(dry, {{{0, -1, 0}, {0}}}, 0) == std::vector<double>{-9999.01});
    CHECK(lacks(refusal("time, 0, -1\n9999, 1, NA\n"), {"wrong.csv:2:3", "'NA' is not a number"}) == "");
    CHECK(lacks(refusal("time; 0; -1\n0; 1,5; x\n"), {"wrong.csv:2:3", "'x' is not a number"}) == "");
    CHECK(lacks(refusal("time, 0, -1\n0, 1\n"), {"wrong.csv:2", "this line has 2 cells, and the first 3"}) == "");
    CHECK(lacks(refusal("time, 0\n5, 1\n5, 2\n"), {"wrong.csv:3", "time 5 is not behind time 5"}) == "");
}
