#include "espalier/base/error.h"

#include "catch.h"
#include "environment/exchange/exchange_plants.h"

#include <cmath>
#include <istream>
#include <limits>
#include <ostream>
#include <sstream>

using namespace espalier;
using namespace espalier::environment;

namespace {

/// What the processes of these tests saw, in the order in which they saw it.
std::vector<std::string>& log_of_calls() {
    static std::vector<std::string> calls;
    return calls;
}

/// Sends back what it was asked, multiplied, and counts its steps.
class Echo final : public EnvironmentProcess {
public:
    Echo(Settings& settings, const EnvironmentContext& context, Fields&)
        : name_(context.name), factor_(settings.number_or("factor", 1)) {}

    void advance(const WorldView&, Queries queries, Fields&) override {
        ++steps_;
        log_of_calls().push_back(name_ + " advances");
        seen.clear();
        for (const Query& query : queries) seen.push_back(query.parameters[0]);
    }
    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        log_of_calls().push_back(name_ + " answers");
        for (std::size_t i = 0; i < queries.size(); ++i) answers[i][0] *= factor_;
    }
    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        return {{"steps", double(steps_)}, {"plant", double(plant)}};
    }
    std::pair<int, int> query_arity() const override { return {1, 3}; }
    void save(std::ostream& out) const override { out << steps_; }
    void restore(std::istream& in) override { in >> steps_; }

    static inline std::vector<double> seen;

private:
    std::string name_;
    double factor_;
    int steps_ = 0;
};

/// Fails in the way its parameter says.
class Faulty final : public EnvironmentProcess {
public:
    Faulty(Settings& settings, const EnvironmentContext&, Fields&) : fault_(settings.text("fault")) {}
    void advance(const WorldView&, Queries, Fields&) override {
        if (fault_ == "throws") throw std::out_of_range("beyond the grid");
    }
    void answer(const WorldView&, Queries, std::span<Answer> answers, Fields&) override {
        for (const Answer& answer : answers) answer[0] = fault_ == "nan" ? std::nan("") : HUGE_VAL;
    }
    std::vector<Quantity> statistics(std::uint32_t) const override { return {}; }
    std::pair<int, int> query_arity() const override { return {1, 1}; }

private:
    std::string fault_;
};

const Registered<ProcessType> echo{{"test-echo", "sends back what it was asked", "factor (1)", construct<Echo>}};
const Registered<ProcessType> faulty{{"test-faulty", "fails", "fault", construct<Faulty>}};

}  // namespace

TEST_CASE("a loop-back process returns what was sent, 100,000 queries in plant and string order", "[environment]") {
    Environment environment = environment_of("[light]\nprocess = \"test-echo\"");
    std::vector<Asked> first, second;
    for (int i = 0; i < 50000; ++i) first.push_back({{0, 0, 0}, {double(i)}});
    for (int i = 50000; i < 100000; ++i) second.push_back({{0, 0, 0}, {double(i), 7}});
    AskingPlants plants;
    plants.add(first).add(second);
    plants.exchange(environment);

    REQUIRE(Echo::seen.size() == 100000);
    bool in_order = true;
    for (std::size_t i = 0; i < Echo::seen.size(); ++i) in_order = in_order && Echo::seen[i] == double(i);
    CHECK(in_order);
    CHECK(plants.parameters(0)[49999] == 49999);
    CHECK(plants.parameters(1)[0] == 50000);
    CHECK(plants.parameters(1)[1] == 7);  // what a process leaves alone keeps its value
}

TEST_CASE("each name's queries reach its own process, and ?E the default", "[environment]") {
    Environment environment = environment_of(
        "[light]\nprocess = \"test-echo\"\nfactor = 2\n"
        "[water]\nprocess = \"test-echo\"\nfactor = 3");
    environment.set_default("water");
    AskingPlants plants({"water", "light"});
    plants.add({{{0, 0, 0}, {1}, "light"}, {{0, 0, 0}, {1}, "water"}, {{0, 0, 0}, {10}, ""}});
    plants.exchange(environment);
    CHECK(plants.parameters() == std::vector<double>{2, 3, 30});
}

TEST_CASE("queries without a process are answered the model's default, beside those of processes", "[environment]") {
    Environment environment = environment_of("[light]\nprocess = \"test-echo\"\nfactor = 2\n");
    AskingPlants plants({"light", "nitrate", "wind"});
    plants.model().default_answers = {{"light", {99}}, {"nitrate", {10}}, {"wind", {1, 2, 3}}};
    plants.add({{{0, 0, 0}, {1}, "light"}, {{0, 0, 0}, {1, 5}, "nitrate"}, {{0, 0, 0}, {0, 0}, "wind"}});
    plants.add({{{0, 0, 0}, {7}, "nitrate"}});
    plants.exchange(environment, 0);
    CHECK(plants.parameters(0) == std::vector<double>{2, 10, 5, 1, 2});
    CHECK(plants.parameters(1) == std::vector<double>{10});
    plants.ask_again_with(4);
    plants.exchange(environment, 1);
    CHECK(plants.parameters(0) == std::vector<double>{8, 10, 4, 1, 2});
    CHECK(plants.parameters(1) == std::vector<double>{10});
}

TEST_CASE("plants that are not in memory get the answers and the failures of those that are", "[environment]") {
    const std::string shade = "[light]\nprocess = \"voxel-shade\"\n";
    for (const std::string& scene : {shade, shade + "[wind]\nprocess = \"test-echo\"\nfactor = 2\n"}) {
        Environment environment = environment_of(scene), other = environment_of(scene);
        CHECK(environment.takes_parts() == (scene == shade));
        AskingPlants plants({"light", "nitrate"}), waiting({"light", "nitrate"});
        for (AskingPlants* some : {&plants, &waiting}) {
            some->model().default_answers = {{"nitrate", {10}}};
            some->add({{{0, 1, 0}, {1}}, {{0, 0, 0}, {0}}, {{0, 0, 0}, {3, 4}, "nitrate"}}).add({});
            some->add({{{0, 0, 0}, {0, 0, 0, 0}}});
        }
        plants.exchange(environment);
        waiting.exchange_waiting(other);
        for (std::size_t plant = 0; plant < 3; ++plant) CHECK(plants.parameters(plant) == waiting.parameters(plant));
        CHECK(waiting.parameters(0)[1] < 1);
        CHECK(waiting.parameters(0)[2] == 10);
        plants.ask_again_with(std::nan(""));
        waiting.ask_again_with(std::nan(""));
        const std::string told = message_of([&] { plants.exchange(environment, 1); });
        CHECK(told == message_of([&] { waiting.exchange_waiting(other, 1); }));
        CHECK(lacks(told, {"step 1: plant 0", "'light' (voxel-shade) with the parameter nan"}) == "");
    }
}

TEST_CASE("what a process throws over parts of the queries names the process", "[environment]") {
    EnvironmentContext context;
    context.memory = std::size_t(4) << 20;
    Environment environment = environment_of("[light]\nprocess = \"voxel-shade\"\n", context);
    AskingPlants plants;
    plants.add(std::vector<Asked>(200'000, Asked{glm::dvec3(0), {1}}));
    const std::string message = message_of([&] { plants.exchange_waiting(environment, 3); });
    CHECK(lacks(message, {"step 3: process 'light' (voxel-shade): the shade of this step needs"}) == "");
    CHECK(environment.consultation().process == nullptr);
}

TEST_CASE("every process advances once before it answers, asked or not, in the scene's order", "[environment]") {
    Environment environment = environment_of("[b]\nprocess = \"test-echo\"\n[a]\nprocess = \"test-echo\"");
    log_of_calls().clear();
    AskingPlants plants({"a"});
    plants.add({{{0, 0, 0}, {1}, "a"}});
    plants.exchange(environment);
    CHECK(log_of_calls() == std::vector<std::string>{"b advances", "b answers", "a advances", "a answers"});
}

TEST_CASE("a turtle's own queries are answered by the turtle, between those of processes", "[environment]") {
    Environment environment = environment_of("[light]\nprocess = \"test-echo\"\nfactor = 5");
    AskingPlants plants;
    plants.add({{{0, 0, 0}, {1}}, {{1, 2, 3}, {0, 0, 0}}, {{0, 0, 0}, {2}}});
    Interpretation& asked = plants.interpretation(0);
    asked.answers.push_back({1, 3, asked.queries[1].parameters_at, {1, 2, 3}, 0});
    asked.queries.erase(asked.queries.begin() + 1);
    plants.exchange(environment);
    CHECK(plants.parameters() == std::vector<double>{5, 1, 2, 3, 10});
    CHECK(Echo::seen.size() == 2);
}

TEST_CASE("a plant that asks nothing keeps its string", "[environment]") {
    Environment environment = environment_of("[light]\nprocess = \"test-echo\"");
    AskingPlants plants;
    plants.add({}).add({{{0, 0, 0}, {4}}}).add({});
    plants.exchange(environment);
    CHECK(plants.parameters(0).empty());
    CHECK(plants.parameters(1) == std::vector<double>{4});
}

TEST_CASE("an answer that is not finite stops the run, naming process and plant", "[environment]") {
    for (const std::string fault : {"nan", "infinity"}) {
        Environment environment = environment_of("[light]\nprocess = \"test-faulty\"\nfault = \"" + fault + "\"");
        AskingPlants plants;
        plants.add({}).add({{{0, 0, 0}, {3}}});
        CHECK_THROWS_AS(plants.exchange(environment, 4), RunError);
        const std::string message = message_of([&] { plants.exchange(environment, 4); });
        CHECK(lacks(message, {"step 4", "plant 1", "'light'"}) == "");
        CHECK(plants.parameters(1) == std::vector<double>{3});
    }
}

TEST_CASE("a question that is not a number stops the run, naming model and process", "[environment]") {
    Environment environment = environment_of("[light]\nprocess = \"test-echo\"");
    AskingPlants plants;
    plants.add({{{0, 0, 0}, {0, std::nan("")}}});
    CHECK_THROWS_AS(plants.exchange(environment), RunError);
    CHECK(lacks(message_of([&] { plants.exchange(environment); }), {"asking.l", "'light'"}) == "");
}

TEST_CASE("a question with too few or too many parameters names plant, process and model", "[environment]") {
    Environment environment = environment_of("[light]\nprocess = \"test-echo\"");
    for (const std::vector<double>& parameters : {std::vector<double>{}, {1, 2, 3, 4}}) {
        AskingPlants plants;
        plants.add({{{0, 0, 0}, parameters}});
        CHECK_THROWS_AS(plants.exchange(environment), UserError);
        CHECK(lacks(message_of([&] { plants.exchange(environment); }), {"plant 0", "'light'", "asking.l", "1 to 3"}) ==
              "");
    }
}

TEST_CASE("what a process throws becomes a failure of the run that names the process", "[environment]") {
    Environment environment = environment_of("[light]\nprocess = \"test-faulty\"\nfault = \"throws\"");
    AskingPlants plants;
    CHECK_THROWS_AS(plants.exchange(environment), RunError);
    CHECK(lacks(message_of([&] { plants.exchange(environment); }), {"'light'", "test-faulty", "beyond the grid"}) ==
          "");
}

TEST_CASE("a saved environment goes on where it was", "[environment]") {
    const std::string scene = "[light]\nprocess = \"test-echo\"\n[water]\nprocess = \"test-echo\"";
    Environment one = environment_of(scene);
    AskingPlants plants;
    for (int step = 0; step < 3; ++step) plants.exchange(one, step);
    std::stringstream checkpoint;
    one.save(checkpoint);
    const std::string bytes = checkpoint.str();

    Environment other = environment_of(scene);
    other.restore(checkpoint);
    CHECK(other.statistics(0)[0].value == 3);

    std::istringstream cut(bytes.substr(0, bytes.size() - 1));
    CHECK_THROWS_AS(other.restore(cut), UserError);
    std::istringstream foreign(bytes);
    Environment renamed = environment_of("[lamp]\nprocess = \"test-echo\"");
    CHECK_THROWS_AS(renamed.restore(foreign), UserError);
}
