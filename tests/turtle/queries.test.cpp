#include "espalier/base/random.h"
#include "espalier/turtle/symbol.h"

#include "catch.h"
#include "turtle/drawing.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <array>
#include <cmath>
#include <numbers>

using namespace espalier;

namespace {

std::vector<double> answer_to(const Query& query) {
    std::vector<double> answer(query.parameters.begin(), query.parameters.end());
    answer_from_turtle(query, answer);
    return answer;
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
        RandomDraws draws(RandomKey(3, 0, Stream::placement), trial, 0);
        std::string text;
        std::vector<MatrixTurtle> stack;
        std::vector<std::array<glm::dvec3, 4>> expected;
        MatrixTurtle turtle;
        for (int i = 0; i < 200; ++i) {
            const double pick = draws.uniform();
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
                const char command = "+-&^/\\FfGg"[int(draws.uniform() * 10)];
                const int value = int(draws.uniform() * 180);
                text += fmt::format("{}({})", command, value);
                turtle.obey(command, value);
            }
        }
        Drawing drawing(text);
        const QueryColumn& queries = drawing.draw().queries;
        REQUIRE(queries.size() == 4 * expected.size());
        double error = 0;
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const std::vector<double> answer = answer_to(queries[i]);
            const glm::dvec3 difference = expected[i / 4][i % 4] - glm::dvec3(answer[0], answer[1], answer[2]);
            error = std::max(error, glm::length(difference));
        }
        CHECK(error < 1e-9);
    }
}

TEST_CASE("a query names the module that carries its parameters", "[turtle]") {
    Drawing drawing("A(1)?E(7,8)B(9)");
    const QueryColumn& queries = drawing.draw().queries;
    REQUIRE(queries.size() == 1);
    const Query& query = queries[0];
    CHECK(query.kind == QueryKind::communication);
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
    Drawing drawing("?E(1)[?P(1,2)]?E(1)");
    const QueryColumn& queries = drawing.draw().queries;
    REQUIRE(queries.size() == 3);
    CHECK(queries[0].following == Alphabet::open_bracket);
    CHECK(queries[1].following == Alphabet::close_bracket);
    CHECK(queries[2].following == no_letter);
    CHECK(queries[2].following_parameters.empty());
}

TEST_CASE("a query carries identities where the string keeps them", "[turtle]") {
    Drawing drawing("F?E(1)F");
    for (Identity identity : {11, 12, 13, 14}) drawing.string.identities.push_back(identity);
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
        CHECK(Drawing(text).draw().queries.empty());
    }
}

TEST_CASE("the turtle fills two or three parameters and leaves a communication alone", "[turtle]") {
    Drawing drawing("F(2)?P(9,9)?P(9,9,9)s(9,9)?E(5,6)");
    const QueryColumn& queries = drawing.draw().queries;
    REQUIRE(queries.size() == 4);
    CHECK(answer_to(queries[0]) == std::vector<double>{0, 2});
    CHECK(answer_to(queries[1]) == std::vector<double>{0, 2, 0});
    CHECK(answer_to(queries[2]) == std::vector<double>{0, 2});
    CHECK(answer_to(queries[3]) == std::vector<double>{5, 6});
}

TEST_CASE("?Q is the rotation of the initial frame to the turtle's", "[turtle]") {
    Drawing drawing("?Q(0,0,0,0)+(20)&(35)/(150)F?Q(0,0,0,0)");
    const QueryColumn& queries = drawing.draw().queries;
    CHECK(answer_to(queries.at(0)) == std::vector<double>{1, 0, 0, 0});
    const std::vector<double> q = answer_to(queries.at(1));
    const glm::dquat rotation(q[0], q[1], q[2], q[3]);
    const Pose& pose = queries[1].pose;
    CHECK(glm::length(rotation * glm::dvec3(0, 1, 0) - pose.heading) < 1e-14);
    CHECK(glm::length(rotation * glm::dvec3(-1, 0, 0) - pose.left) < 1e-14);
    CHECK(glm::length(rotation * glm::dvec3(0, 0, -1) - pose.up) < 1e-14);
}
