#include "espalier/base/random.h"
#include "espalier/turtle/symbol.h"

#include "catch.h"
#include "lineage.h"
#include "turtle/drawing.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <array>
#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::turtle;

namespace {

/// The parameters of a string after the turtle has answered.
std::vector<double> answered(Drawing drawing) {
    write_turtle_answers(drawing.draw(), drawing.string);
    return {drawing.string.parameters.begin(), drawing.string.parameters.end()};
}

/// A turtle of textbook matrices: the frame as columns heading, left, up; rotations multiply from the right.
struct MatrixTurtle {
    glm::dmat3 frame{glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, -1)};
    glm::dvec3 position{0};

    /// Column `from` turns towards column `to`.
    void rotate(int from, int to, double degrees) {
        const double angle = degrees * std::numbers::pi / 180;
        glm::dmat3 rotation(1);
        rotation[from][from] = rotation[to][to] = std::cos(angle);
        rotation[from][to] = std::sin(angle);
        rotation[to][from] = -std::sin(angle);
        frame = frame * rotation;
    }
    void obey(char command, double value) {
        switch (command) {
            case '+':
                return rotate(0, 1, value);
            case '-':
                return rotate(0, 1, -value);
            case '&':
                return rotate(0, 2, value);
            case '^':
                return rotate(0, 2, -value);
            case '/':
                return rotate(1, 2, value);
            case '\\':
                return rotate(1, 2, -value);
            default:
                position += frame[0] * value;
        }
    }
};

}  // namespace

TEST_CASE("?P ?H ?L ?U equal an independent replay on 100 random strings", "[turtle]") {
    for (std::uint64_t trial = 0; trial < 100; ++trial) {
        RandomSamples samples(RandomKey(3, 0, Stream::placement), trial, 0);
        std::string text;
        std::vector<MatrixTurtle> stack;
        std::vector<std::array<glm::dvec3, 4>> expected;
        MatrixTurtle turtle;
        for (int i = 0; i < 200; ++i) {
            const double pick = samples.uniform();
            if (pick < 0.1) {
                text += '[';
                stack.push_back(turtle);
            } else if (pick < 0.2 && !stack.empty()) {
                text += ']';
                turtle = stack.back();
                stack.pop_back();
            } else if (pick < 0.3) {
                text += "?P(0,0,0)?H(0,0,0)?L(0,0,0)?U(0,0,0)";
                expected.push_back({turtle.position, turtle.frame[0], turtle.frame[1], turtle.frame[2]});
            } else {
                const char command = "+-&^/\\FfGg"[int(samples.uniform() * 10)];
                const int value = int(samples.uniform() * 180);
                text += fmt::format("{}({})", command, value);
                turtle.obey(command, value);
            }
        }
        Drawing drawing(text);
        const Interpretation& drawn = drawing.draw();
        CHECK(drawn.queries.empty());
        REQUIRE(drawn.answers.size() == 4 * expected.size());
        double error = 0;
        for (std::size_t i = 0; i < drawn.answers.size(); ++i) {
            const TurtleAnswer& answer = drawn.answers[i];
            error = std::max(error, glm::distance(expected[i / 4][0], answer.position));
            double* const said = drawing.string.parameters.data() + answer.parameters_at;
            std::fill_n(said, 3, 1e9);
            write_turtle_answers(drawn, drawing.string);
            error = std::max(error, glm::distance(expected[i / 4][i % 4], glm::dvec3(said[0], said[1], said[2])));
        }
        CHECK(error < 1e-9);
    }
}

TEST_CASE("a query names the module that carries its parameters", "[turtle]") {
    Drawing drawing("A(1)?E(7,8)B(9)");
    const QueryColumn& queries = drawing.draw().queries;
    REQUIRE(queries.size() == 1);
    const Query& query = queries[0];
    CHECK(query.process == -1);
    CHECK(query.module == 2);
    CHECK(query.parameters_at == 1);
    REQUIRE(query.parameters.size() == 2);
    CHECK(query.parameters[1] == 8);
    CHECK(query.parameters.data() == drawing.string.parameters.data() + 1);
    CHECK(drawing.model.alphabet.name(query.following) == "B");
    REQUIRE(query.following_parameters.size() == 1);
    CHECK(query.following_parameters[0] == 9);
    CHECK(query.identity == 0);
}

TEST_CASE("the following module is the next one, a bracket too, and none at the end", "[turtle]") {
    Drawing drawing("?E(1)[?E(1,2)]?E(1)");
    const QueryColumn& queries = drawing.draw().queries;
    REQUIRE(queries.size() == 3);
    CHECK(queries[0].following == Alphabet::open_bracket);
    CHECK(queries[1].following == Alphabet::close_bracket);
    CHECK(queries[2].following == no_letter);
    CHECK(queries[2].following_parameters.empty());
}

TEST_CASE("a query carries identities where the string keeps them", "[turtle]") {
    Drawing drawing("F?E(1)F");
    for (Identity identity : {11, 12, 13, 14}) test::append_lineage(drawing.string, identity, 0, 0);
    const Query query = drawing.draw().queries.at(0);
    CHECK(query.identity == 13);
    CHECK(query.following_identity == 14);
}

TEST_CASE("a query carries the turtle's pose, width and scale", "[turtle]") {
    Drawing drawing("@D(2)!(0.25)F(3)+(90)?E(1)");
    drawing.settings.pose.position = {1, 0, 0};
    const Query query = drawing.draw().queries.at(0);
    CHECK(query.pose.position == glm::dvec3(1, 6, 0));
    CHECK(query.pose.heading == glm::dvec3(-1, 0, 0));
    CHECK(query.width == 0.5);
    CHECK(query.scale == 2);
}

TEST_CASE("declared processes are asked under their own names", "[turtle]") {
    Drawing drawing("<?water>(1,2)<?light>(3)?E(4)<?wind>(5)");
    drawing.model.processes = {"light", "water"};
    const QueryColumn& queries = drawing.draw().queries;
    REQUIRE(queries.size() == 3);
    CHECK(queries[0].process == 1);
    CHECK(queries[0].parameters.size() == 2);
    CHECK(queries[1].process == 0);
    CHECK(queries[2].process == -1);
    CHECK(queries[2].parameters_at == 3);
}

TEST_CASE("queries with a wrong number of parameters ask nothing", "[turtle]") {
    for (const char* text : {"?E", "?P", "?P(1)", "?P(1,2,3,4)", "?Q(1,2,3)", "?X(1)", "E(1)", "P(1,2)", "?(1)E(2)"}) {
        INFO(text);
        Drawing drawing(text);
        CHECK(drawing.draw().queries.empty());
        CHECK(drawing.result.answers.empty());
    }
}

TEST_CASE("the turtle fills two or three parameters and leaves a communication alone", "[turtle]") {
    const Drawing drawing("F(2)?P(9,9)?P(9,9,9)s(9,9)?E(5,6)");
    CHECK(answered(drawing) == std::vector<double>{2, 0, 2, 0, 2, 0, 0, 2, 5, 6});
}

TEST_CASE("an answer names the module that carries its parameters, and tells place and width", "[turtle]") {
    Drawing drawing("A(1)!(0.5)F(2)?H(8,9)B(9)");
    const Interpretation& drawn = drawing.draw();
    REQUIRE(drawn.answers.size() == 1);
    const TurtleAnswer& answer = drawn.answers[0];
    CHECK(answer.module == 4);
    CHECK(answer.count == 0);
    REQUIRE(drawn.directions.size() == 1);
    CHECK(drawn.directions[0].count == 2);
    CHECK(drawn.directions[0].parameters_at == 3);
    CHECK(answer.parameters_at == 3);
    CHECK(answer.position == glm::dvec3(0, 2, 0));
    CHECK(answer.width == 0.5);
    CHECK(answered(drawing) == std::vector<double>{1, 0.5, 2, 0, 1, 9});
}

TEST_CASE("?Q is the rotation of the initial frame to the turtle's", "[turtle]") {
    Drawing drawing("?Q(0,0,0,0)+(20)&(35)/(150)F?Q(0,0,0,0)");
    const std::vector<TurtleDirection>& answers = drawing.draw().directions;
    REQUIRE(answers.size() == 2);
    CHECK(answers[0].values == std::array<double, 4>{1, 0, 0, 0});
    CHECK(answers[1].count == 4);
    const std::array<double, 4>& q = answers[1].values;
    const glm::dquat rotation(q[0], q[1], q[2], q[3]);
    const Pose pose = drawing.pose();
    CHECK(glm::length(rotation * glm::dvec3(0, 1, 0) - pose.heading) < 1e-14);
    CHECK(glm::length(rotation * glm::dvec3(-1, 0, 0) - pose.left) < 1e-14);
    CHECK(glm::length(rotation * glm::dvec3(0, 0, -1) - pose.up) < 1e-14);
}
