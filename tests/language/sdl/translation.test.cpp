// The model of a skeleton description grows the skeleton that the description means.
#include "catch.h"
#include "language/sdl/reference_skeleton.h"

#include <cmath>
#include <random>

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

namespace {

const std::string straw_of_boxes =
    "define{ start[0,1,0,0]; straw[0.5:0.3,0.8:0.3,0,30:10]; } rules{ start -> (straw); straw -> (straw); }";

std::vector<Node> skeleton_after(const std::string& description, int generations, DerivationSettings settings = {}) {
    Grown grown(model_text(description), std::move(settings));
    grown.steps(generations);
    return nodes_of(grown.string, grown.model->alphabet);
}

/// Descriptions with branches, cycles, NULL components and constant angles, all different.
class RandomDescription {
public:
    explicit RandomDescription(unsigned seed) : random_(seed) {}

    std::string text() {
        std::string text = "define{ a[0,1,0,0];";
        for (const char* name : {"stem", "leaf", "bud", "F"}) {
            const char* prefix = below(4) == 0 ? "#const_ver " : below(4) == 0 ? "#const_hor " : "";
            text += fmt::format(" {}{}[{},{},{},{}];", prefix, name, below(5) / 4.0, below(9) / 4.0 - 1, 30 * below(12),
                                15 * below(7) - 30);
        }
        text += " node[NULL]; } rules{ a -> " + right_side(1) + ";";
        for (const char* name : {"stem", "bud", "node", "F"}) {
            if (below(3) > 0) text += fmt::format(" {} -> {};", name, right_side(0));
        }
        return text + " }";
    }

private:
    int below(int limit) { return int(random_() % unsigned(limit)); }

    std::string right_side(int least) {
        static const char* const names[] = {"stem", "leaf", "bud", "node", "F"};
        std::string text = "(";
        for (int k = least + below(3); k > 0; --k) {
            text += fmt::format("{} ", names[below(5)]);
            if (below(5) == 0) text += fmt::format("*{} ", below(3));
            if (below(4) == 0 && ++nested_ < 6) text += right_side(0);
        }
        return text + ")";
    }

    std::mt19937 random_;
    int nested_ = 0;
};

}  // namespace

TEST_CASE("a component begins on its master and takes its features from it", "[sdl]") {
    const auto nodes = skeleton_after("define{ start[0,1,0,0]; child[0.5,0,30,0]; } rules{ start -> (child); }", 1);
    REQUIRE(nodes.size() == 2);
    CHECK(nodes[1].begin == 0.5);
    CHECK(nodes[1].length == 1);
    CHECK(nodes[1].vertical == 30);
    CHECK(nodes[1].horizontal == 0);
}

TEST_CASE("features accumulate from master to slave", "[sdl]") {
    const auto nodes = skeleton_after("define{ S[0,1,0,0]; A[1,0.25,10,-3]; } rules{ S -> (A); A -> (A); }", 6);
    REQUIRE(nodes.size() == 7);
    for (int i = 0; i < 7; ++i) {
        CHECK(nodes[i].master == i - 1);
        CHECK(nodes[i].length == 1 + 0.25 * i);
        CHECK(nodes[i].vertical == 10 * i);
        CHECK(nodes[i].horizontal == -3 * i);
    }
}

TEST_CASE("in S -> (A B(C D) E), S is the master of A, B and E, and B of C and D", "[sdl]") {
    const std::string text =
        "define{ S[0,1,0,0]; A[0,1,0,0]; B[0,1,0,0]; C[0,1,0,0]; D[0,1,0,0]; E[0,1,0,0]; } rules{ S -> (A B(C D) E); }";
    CHECK(relations(skeleton_after(text, 1)) == "A < S; B < S; C < B; D < B; E < S; ");
    CHECK(relations(skeleton_after(text, 0)) == "");
}

TEST_CASE("components of one letter may follow each other without blanks, as the paper prints (A B(CD)E)", "[sdl]") {
    const auto grown = [](const std::string& names, const std::string& rules) {
        std::string text = "define{ ";
        for (const char name : names) text += std::string(1, name) + "[0,1,0,0]; ";
        return relations(skeleton_after(text + "} rules{ " + rules + " }", 1));
    };
    CHECK(grown("SABCDE", "S -> (A B(CD)E);") == "A < S; B < S; C < B; D < B; E < S; ");
    CHECK(grown("SAB", "S -> (AB(AB));") == "A < S; B < S; A < B; B < B; ");
    CHECK(grown("SAB", "S -> (AB*2);") == "A < S; B < S; B < S; ");
    CHECK_THROWS_WITH(grown("SA", "S -> (AX);"), Catch::Contains("'AX' is not defined"));
}

TEST_CASE("a component that has slaves on a right side still has those of its rule, a step later", "[sdl]") {
    const std::string text =
        "define{ S[0,1,0,0]; B[0,1,0,0]; C[0,1,0,0]; D[0,1,0,0]; } rules{ S -> (B(C(D))); B -> (D); C -> (S); }";
    CHECK(relations(skeleton_after(text, 1)) == "B < S; C < B; D < C; ");
    CHECK(relations(skeleton_after(text, 2)) == "B < S; D < B; C < B; S < C; D < C; ");
}

TEST_CASE("the straw has one component more in each generation", "[sdl]") {
    for (int n = 0; n <= 12; ++n) CHECK(skeleton_after(straw_of_boxes, n).size() == std::size_t(1 + n));
}

TEST_CASE("the components of the straw keep within the intervals that mutation sums up", "[sdl]") {
    for (const Node& node : skeleton_after(straw_of_boxes, 10)) {
        const int i = node.master + 1;  // each is the slave of the one before
        if (i > 0) {
            CHECK(node.begin >= 0.2);
            CHECK(node.begin <= 0.8);
        }
        CHECK(node.length >= 1 + 0.5 * i);
        CHECK(node.length <= 1 + 1.1 * i);
        CHECK(node.horizontal >= 20 * i);
        CHECK(node.horizontal <= 40 * i);
        CHECK(node.vertical == 0);
    }
}

TEST_CASE("mutated features are uniform between middle minus and plus deviation", "[sdl]") {
    std::string slaves;
    for (int k = 0; k < 10; ++k) slaves += " b*1000";
    const auto nodes =
        skeleton_after("define{ a[0,1,0,0]; b[0.5:0.3,0.8:0.3,0,30:10]; } rules{ a -> (" + slaves + "); }", 1);
    REQUIRE(nodes.size() == 10001);
    const auto check_uniform = [&](double Node::*feature, double middle, double deviation) {
        double sum = 0, squares = 0;
        for (std::size_t i = 1; i < nodes.size(); ++i) {
            const double offset = nodes[i].*feature - middle;
            CHECK(std::abs(offset) <= deviation * (1 + 1e-9));
            sum += offset / 1e4;
            squares += offset * offset / 1e4;
        }
        const double variance = deviation * deviation / 3;
        CHECK(std::abs(sum) < 3 * std::sqrt(variance / 1e4));
        CHECK(squares == Approx(variance).epsilon(0.03));
    };
    check_uniform(&Node::begin, 0.5, 0.3);
    check_uniform(&Node::length, 1.8, 0.3);
    check_uniform(&Node::horizontal, 30, 10);
}

TEST_CASE("mutation depends on the seed alone, and what is drawn stays as the plant grows", "[sdl]") {
    const auto grown = [](int generations, std::uint64_t seed) {
        DerivationSettings settings;
        settings.seed = seed;
        return canonical(skeleton_after(straw_of_boxes, generations, std::move(settings)));
    };
    CHECK(grown(5, 1) == grown(5, 1));
    CHECK(grown(5, 1) != grown(5, 2));
    const std::string young = grown(4, 1), old = grown(5, 1);
    CHECK(old.starts_with(young.substr(0, young.find_last_not_of(']') + 1)));
}

TEST_CASE("translation and direct interpretation give the same skeletons", "[sdl]") {
    for (unsigned seed = 1; seed <= 50; ++seed) {
        const std::string text = RandomDescription(seed).text();
        INFO(text);
        const sdl::Skeleton skeleton = sdl::parse(text, "random.sdl");
        ReferenceSkeleton reference(skeleton);
        Grown grown(sdl::model_of(skeleton, "random.sdl").text);
        for (int generation = 0; generation <= 4; ++generation) {
            CHECK(canonical(nodes_of(grown.string, grown.model->alphabet)) == canonical(reference.nodes));
            if (reference.nodes.size() > 2000) break;
            grown.steps(1);
            reference.step();
        }
    }
}

TEST_CASE("a generation is a part of the next one", "[sdl]") {
    const sdl::Skeleton skeleton = sdl::parse(RandomDescription(7).text(), "random.sdl");
    ReferenceSkeleton reference(skeleton);
    for (int generation = 0; generation < 4; ++generation) {
        const std::vector<Node> before = reference.nodes;
        reference.step();
        for (std::size_t i = 0; i < before.size(); ++i) {
            CHECK(reference.nodes[i].name == before[i].name);
            CHECK(reference.nodes[i].master == before[i].master);
        }
    }
}

TEST_CASE("lengths end at 0", "[sdl]") {
    const auto nodes = skeleton_after("define{ S[0,1,0,0]; A[1,-0.4,0,0]; } rules{ S -> (A); A -> (A); }", 4);
    CHECK(nodes[2].length == Approx(0.2));
    CHECK(nodes[3].length == 0);
    CHECK(nodes[4].length == 0);
}

TEST_CASE("#const_ver and #const_hor: the angle is the component's own", "[sdl]") {
    const auto nodes =
        skeleton_after("define{ S[0,1,50,60]; #const_ver A[0,0,7,5]; #const_hor B[0,0,7,5]; } rules{ S -> (A B); }", 1);
    CHECK(nodes[1].vertical == 7);
    CHECK(nodes[1].horizontal == 65);
    CHECK(nodes[2].vertical == 57);
    CHECK(nodes[2].horizontal == 5);
}

TEST_CASE("a NULL component hands its master's features to its slaves", "[sdl]") {
    const auto nodes =
        skeleton_after("define{ S[0,2,50,60]; N[NULL]; A[0.5,1,1,1]; } rules{ S -> (N); N -> (A N); }", 2);
    REQUIRE(nodes.size() == 4);
    CHECK(nodes[2].name == "A");
    CHECK(nodes[2].begin == 0.5);
    CHECK(nodes[2].length == 3);
    CHECK(nodes[2].vertical == 51);
}

TEST_CASE("expressions know the master, the generation and the place in the cycle", "[sdl]") {
    const auto nodes = skeleton_after(
        "define{ S[0,2,0,0]; A[i / 4, -length / 2, 90 * i, 10 * generation + min(i, 2)]; } rules{ S -> (A*4); }", 1);
    REQUIRE(nodes.size() == 5);
    for (int i = 0; i < 4; ++i) {
        CHECK(nodes[i + 1].begin == Approx(i / 4.0));
        CHECK(nodes[i + 1].length == 1);
        CHECK(nodes[i + 1].vertical == 90 * i);
        CHECK(nodes[i + 1].horizontal == 10 + std::min(i, 2));
    }
}

TEST_CASE("several right sides are chosen as often as their weights say", "[sdl]") {
    const auto nodes = skeleton_after(
        "define{ S[0,1,0,0]; A[0,0,0,0]; B[0,0,0,0]; } rules{ S -> (A*1000 A*1000 A*1000); A -> (B) : 3 | () : 1; }",
        2);
    const auto count = std::count_if(nodes.begin(), nodes.end(), [](const Node& node) { return node.name == "B"; });
    CHECK(std::abs(double(count) - 2250) < 3 * std::sqrt(3000 * 0.75 * 0.25));
}

TEST_CASE("components may have the names of symbols, functions and keywords", "[sdl]") {
    const std::string text =
        "define{ f[0,1,0,0]; F[0.5,1,0,0]; Gs[0,1,0,0]; axiom[0,1,0,0]; sin[0,1,0,0]; TURN[0,1,0,0]; ran[0,1,0,0]; "
        "homomorphism[0,1:1,0,0]; Q[0,1,0,0]; waits[0,1,0,0]; generation[i,length,0,generation]; } rules{ f -> (F Gs "
        "axiom sin TURN ran homomorphism Q "
        "waits generation); F -> (f); }";
    CHECK(skeleton_after(text, 2).size() == 12);
}

TEST_CASE("the model of the straw is as short as the straw", "[sdl]") {
    const std::string text = model_text(straw_of_boxes);
    CHECK(text.find("straw(length, vertical, horizontal, waits) : waits == 1 -->\n"
                    "\tstraw(length, vertical, horizontal, 0)\n"
                    "\t[f(length * MUTATED(0.5, 0.3)) straw(length + MUTATED(0.8, 0.3), vertical, "
                    "horizontal + MUTATED(30, 10), 1)]\n") != std::string::npos);
    CHECK(std::count(text.begin(), text.end(), '\n') < 30);
}
