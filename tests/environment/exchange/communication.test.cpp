// How questions reach a process: rounded as text would carry them, routed, or left alone.
#include "environment/exchange/communication.h"

#include "espalier/base/error.h"

#include "catch.h"
#include "environment/exchange/exchange_plants.h"

using namespace espalier;
using namespace espalier::environment;

namespace {

/// Answers with the place where it was asked and whether it was told of a following module.
class Where final : public EnvironmentProcess {
public:
    Where(Settings& settings, const EnvironmentContext&, Fields&) : mark_(settings.number_or("mark", 0)) {}
    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            seen.assign(queries[i].parameters.begin(), queries[i].parameters.end());
            following = queries[i].following;
            if (answers[i].size() < 4) continue;
            answers[i][0] = queries[i].pose.position.x;
            answers[i][1] = queries[i].pose.position.y;
            answers[i][2] = queries[i].pose.position.z;
            if (mark_ != 0) answers[i][3] = mark_;
        }
    }
    std::vector<Quantity> statistics(std::uint32_t) const override { return {}; }
    std::pair<int, int> query_arity() const override { return {0, 9}; }

    static inline std::vector<double> seen;
    static inline LetterId following = no_letter;

private:
    double mark_;
};

const Registered<ProcessType> where{{"test-where", "answers with the place", "mark", construct<Where>}};

std::vector<double> rounded(const std::string& format, std::vector<double> numbers) {
    TurtleFormat::read(format, {"plant.e", 3, 1}).round(numbers);
    return numbers;
}

std::vector<double> answer_to(const std::string& table, const Asked& asked) {
    Environment environment = environment_of("[light]\nprocess = 'test-where'\n" + table);
    AskingPlants plants;
    plants.add({asked});
    plants.exchange(environment);
    return plants.parameters();
}

}  // namespace

TEST_CASE("coordinates are rounded as the format prints them", "[environment]") {
    using Numbers = std::vector<double>;
    CHECK(rounded("P: %.1f %.0f %.4f", {1.26, 2.5, -0.00001}) == Numbers{1.3, 2, 0});
    CHECK(rounded(" %f %f %f", {1.23456789, 0, 1e-9}) == Numbers{1.234568, 0, 0});
    CHECK(rounded("%.3g,%e,%lf", {1234.5, 1.0 / 3, 1}) == Numbers{1230, 0.3333333, 1});
    CHECK(rounded("100%% %+8.2f", {1.239, 5, 6}) == Numbers{1.24, 0, 0});
}

TEST_CASE("a format that prints anything but three numbers is refused with its line", "[environment]") {
    for (const char* format : {"%s %f %f", "%d %d %d", "%", "%n", "%f %f %f %f", "%*f", "%.200f", "%1000f", "%.4"}) {
        INFO(format);
        const std::string message = message_of([&] { TurtleFormat::read(format, {"plant.e", 3, 1}); });
        CHECK(lacks(message, {"plant.e:3"}) == "");
    }
    // The widest there is fits.
    CHECK(rounded("%99.99f", {1e308})[0] == 1e308);
}

TEST_CASE("a process is asked at the rounded place, and the plant stays where it is", "[environment]") {
    const Asked asked{{1.26, 0.6, -3.75}, {0, 0, 0, 8}};
    CHECK(answer_to("turtle = { position = '%.1f %.0f %.1f' }", asked) == std::vector<double>{1.3, 1, -3.8, 8});
    CHECK(answer_to("", asked) == std::vector<double>{1.26, 0.6, -3.75, 8});
}

TEST_CASE("with digits, questions and answers have that many; what is left alone keeps all", "[environment]") {
    const double third = 1.0 / 3;
    const std::vector<double> answer = answer_to("digits = 6", {{2.0 / 3, 0, 0}, {third, third, third, third}});
    CHECK(Where::seen == std::vector<double>(4, 0.333333));
    CHECK(answer[0] == 0.666667);
    CHECK(answer[3] == third);
}

TEST_CASE("a process may be told nothing of the module that follows", "[environment]") {
    const std::string tables[] = {"", "following_module = false"};
    for (const std::string& table : tables) {
        Environment environment = environment_of("[light]\nprocess = 'test-where'\n" + table);
        AskingPlants plants;
        plants.add({{{0, 0, 0}, {1}}});
        plants.interpretation(0).queries[0].following = 3;
        plants.exchange(environment);
        CHECK(Where::following == (table.empty() ? 3 : no_letter));
    }
}

TEST_CASE("several processes behind one ?E are told apart by its first parameter, which they do not see",
          "[environment]") {
    Environment environment =
        environment_of("[a]\nprocess = 'test-where'\nmark = 5\n[b]\nprocess = 'test-where'\nmark = 6");
    environment.route_by_first_parameter();
    AskingPlants plants(std::vector<std::string>{});
    plants.add({{{7, 8, 9}, {1, 0, 0, 0, 0}, ""}, {{1, 2, 3}, {0, 0, 0, 0, 0}, ""}});
    plants.exchange(environment);
    CHECK(plants.parameters() == std::vector<double>{1, 7, 8, 9, 6, 0, 1, 2, 3, 5});
    CHECK(Where::seen.size() == 4);

    AskingPlants lost(std::vector<std::string>{});
    lost.add({{{0, 0, 0}, {2, 0}, ""}});
    CHECK_THROWS_AS(lost.exchange(environment), RunError);
    CHECK(lacks(message_of([&] { lost.exchange(environment); }), {"?E(2", "0 to 1"}) == "");
}

TEST_CASE("where queries may stay unanswered they keep their parameters", "[environment]") {
    Environment environment = environment_of("");
    AskingPlants plants(std::vector<std::string>{});
    plants.add({{{0, 0, 0}, {4, 5}, ""}});
    CHECK_THROWS_AS(plants.exchange(environment), UserError);
    environment.keep_unanswered();
    plants.exchange(environment);
    CHECK(plants.parameters() == std::vector<double>{4, 5});
}
