// The tree of instances of a p-graph: multiplicity, recursion, links, ranges.
#include "catch.h"
#include "language/pgraph/graphs.h"

#include <fmt/format.h>

#include <cmath>
#include <random>

using namespace espalier;
using namespace espalier::test;

namespace {

std::size_t count_of(const std::string& lines, const std::string& symbol) {
    return instances_of(lines)[symbol].size();
}

}  // namespace

TEST_CASE("The worked example: A, B, C three times over D, and D three times in a row", "[pgraph]") {
    // Lintermann & Deussen 1997, figure 2: prototype D has nine instances.
    const std::string graph = R"(
Simple aa
Simple bb
Hydra cc
  count 3
Simple dd
  recursion 3
camera -> aa -> bb -> cc -> dd -> dd
)";
    auto instances = instances_of(graph);
    CHECK(instances["Aa"].size() == 1);
    CHECK(instances["Bb"].size() == 1);
    CHECK(instances["Cc"].size() == 1);
    CHECK(instances["Dd"].size() == 9);
}

TEST_CASE("A multiplier has as many children as it says", "[pgraph]") {
    for (const std::size_t n : {0, 1, 18, 400}) {
        for (const char* type : {"Hydra", "Ring", "Phiball"}) {
            CHECK(count_of(fmt::format("{} many\n  count {}\nSimple one\ncamera -> many -> one\n", type, n), "One") ==
                  n);
        }
    }
}

TEST_CASE("A child link gives one instance, a branch link as many as there are branches", "[pgraph]") {
    const std::string graph = "Tree stem\n  branches 7\nHorn twig\nHorn tip\ncamera -> stem -B-> twig\nstem -> tip\n";
    CHECK(count_of(graph, "Twig") == 7);
    CHECK(count_of(graph, "Tip") == 1);
    CHECK(graph_mistakes("Horn stem\nHorn twig\ncamera -> stem -B-> twig\n") ==
          "4:11: a branch link begins at a Tree, and 'stem' is a Horn");
}

TEST_CASE("A leaf link is followed where a recursion ends, and nowhere else", "[pgraph]") {
    const std::string tree = "Tree stem\n  branches 3\n  recursion 4\nLeaf leaf\ncamera -> stem -B-> stem -L-> leaf\n";
    CHECK(count_of(tree, "Stem") == 1 + 3 + 9 + 27);
    CHECK(count_of(tree, "Leaf") == 81);
    const std::string star = "Hydra star\n  count 2\n  recursion 5\nLeaf leaf\ncamera -> star -> star -L-> leaf\n";
    CHECK(count_of(star, "Leaf") == 32);
    CHECK_THAT(graph_mistakes("Horn stem\nLeaf leaf\ncamera -> stem -L-> leaf\n"),
               Catch::StartsWith("4:11: a leaf link stands in for a link that leads back, and 'stem' has none"));
}

TEST_CASE("Recursions nest: the inner one runs anew in every round of the outer", "[pgraph]") {
    const std::string nested = R"(
Simple outer
  recursion 2
Simple inner
  recursion 3
camera -> outer -> inner -> inner -L-> outer
)";
    CHECK(count_of(nested, "Outer") == 2);
    CHECK(count_of(nested, "Inner") == 6);
}

TEST_CASE("Recursions that overlap, or have no limit, are refused", "[pgraph]") {
    CHECK(graph_mistakes("Simple aa\n recursion 2\nSimple bb\n recursion 2\nSimple cc\n"
                         "camera -> aa -> bb -> cc -> bb -> aa\n") ==
          "4:8: the recursions of 'aa' (aa, bb) and 'bb' (bb, cc) overlap; one must lie within the other, or they must "
          "have no component in common");
    CHECK(graph_mistakes("Simple aa\n recursion 2\nSimple bb\ncamera -> aa -> bb -> aa\ncamera -> bb\n") ==
          "6:1: this link enters the recursion of 'aa' at 'bb': it overlaps with what leads there; link to 'aa' "
          "instead");
    CHECK(graph_mistakes("Simple aa\ncamera -> aa -> aa\n") ==
          "2:8: a link leads back to 'aa': say how often, with 'recursion 3' or so");
    CHECK_THAT(graph_mistakes("Simple aa\n recursion 2\ncamera -> aa\n"),
               Catch::StartsWith("3:12: no link leads back to 'aa'"));
    CHECK_THAT(graph_mistakes("Simple aa\nSimple bb\ncamera -> aa\n"),
               Catch::StartsWith("3:8: no link leads from the camera to 'bb'"));
}

namespace {

/// A random graph made of chains, recursions around chains and branches, with the numbers of its instances computed
/// from that plan alone.
class RandomGraph {
public:
    explicit RandomGraph(unsigned seed) : random_(seed) { chain("camera", "->", 1, 0, 1 + pick(3)); }

    std::string text() const { return components_ + links_; }
    const std::map<std::string, double>& expected() const { return expected_; }
    double total() const {
        double sum = 0;
        for (const auto& [name, count] : expected_) sum += count;
        return sum;
    }

private:
    struct End {
        std::string name, arrow;
        double copies;  ///< copies of what the arrow leads to, for each of what led to the first
    };
    using Counts = std::vector<std::pair<std::string, double>>;

    int pick(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }

    void chain(const std::string& from, const std::string& arrow, double copies, int level, int length) {
        Counts counts;
        parts(from, arrow, level, length, counts);
        for (const auto& [name, count] : counts) expected_[name] += copies * count;
    }

    /// Adds what one instance of `from` leads to. The last part is never a recursion.
    End parts(const std::string& from, const std::string& arrow, int level, int length, Counts& counts) {
        End end{from, arrow, 1};
        for (int k = 0; k < length; ++k) {
            const bool repeats = level < 2 && k + 1 < length && pick(3) == 0;
            Counts part;
            const End next = repeats ? recursion(end, level, part) : single(end, "", part);
            for (const auto& [name, count] : part) counts.emplace_back(name, count * end.copies);
            end = {next.name, next.arrow, end.copies * next.copies};
        }
        return end;
    }

    End single(const End& before, const std::string& keys, Counts& counts) {
        const std::string name = fmt::format("n{}", ++names_);
        links_ += fmt::format("{} {} {}\n", before.name, before.arrow, name);
        counts.emplace_back(fmt::format("N{}", name.substr(1)), 1);
        const int copies = pick(4);
        switch (pick(4)) {
            case 0: {
                const char* types[] = {"Hydra", "Ring", "Phiball"};
                components_ += fmt::format("{} {}\n  count {}\n{}", types[pick(3)], name, copies, keys);
                return {name, "->", double(copies)};
            }
            case 1:
                components_ += fmt::format("Tree {}\n  branches {}\n{}", name, copies, keys);
                return pick(2) ? End{name, "->", 1} : End{name, "-B->", double(copies)};
            default:
                components_ += fmt::format("Simple {}\n{}", name, keys);
                return {name, "->", 1};
        }
    }

    End recursion(const End& before, int level, Counts& counts) {
        const int rounds = 1 + pick(3);
        Counts body;
        const End head = single(before, fmt::format("  recursion {}\n", rounds), body);
        Counts rest;
        const End last = parts(head.name, head.arrow, level + 1, 1 + pick(2), rest);
        for (const auto& [name, count] : rest) body.emplace_back(name, count * head.copies);
        links_ += fmt::format("{} {} {}\n", last.name, last.arrow, head_name(body));
        const double factor = head.copies * last.copies;
        for (int round = 0; round < rounds; ++round) {
            for (const auto& [name, count] : body) counts.emplace_back(name, count * std::pow(factor, round));
        }
        return {last.name, "-L->", std::pow(factor, rounds)};
    }

    static std::string head_name(const Counts& body) { return fmt::format("n{}", body.front().first.substr(1)); }

    std::mt19937 random_;
    int names_ = 9;
    std::string components_, links_;
    std::map<std::string, double> expected_;
};

}  // namespace

TEST_CASE("The derived string has the modules of the tree of instances, for 200 random graphs", "[pgraph]") {
    int compared = 0, with_recursion = 0;
    for (unsigned seed = 1; compared < 200; ++seed) {
        const RandomGraph graph(seed);
        if (graph.total() > 3000) continue;
        INFO(graph.text());
        REQUIRE(graph_mistakes(graph.text()).empty());
        auto instances = instances_of(graph.text());
        for (const auto& [symbol, count] : graph.expected()) {
            INFO(symbol);
            CHECK(double(instances[symbol].size()) == count);
            CHECK(instances.count(fmt::format("n{}", symbol.substr(1))) == 0);  // no bud is left
        }
        ++compared;
        with_recursion += graph.text().find("-L->") != std::string::npos;
    }
    CHECK(with_recursion > 50);
}

TEST_CASE("A range is spread over the instances from end to end", "[pgraph]") {
    const auto lengths = [](int n, const std::string& value) {
        return first_values(
            fmt::format("Hydra star\n  count {}\nHorn ray\n  length {}\ncamera -> star -> ray\n", n, value), "Ray");
    };
    CHECK(lengths(5, "2 .. 4") == std::vector<double>{2, 2.5, 3, 3.5, 4});
    CHECK(lengths(1, "2 .. 4") == std::vector<double>{2});
    CHECK(lengths(3, "1 .. 3 then x ^ 2") == std::vector<double>{1, 4, 9});
    CHECK(lengths(3, "i + 10 * n") == std::vector<double>{30, 31, 32});
    CHECK(lengths(3, "u") == std::vector<double>{0, 0.5, 1});
}

TEST_CASE("Noise comes last, stays within its bounds and repeats", "[pgraph]") {
    const std::string graph = "Hydra star\n  count 300\nHorn ray\n  length 5 .. 6 noise 0.5\ncamera -> star -> ray\n";
    const std::vector<double> lengths = first_values(graph, "Ray");
    CHECK(lengths == first_values(graph, "Ray"));
    double sum = 0, largest = 0;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const double deviation = lengths[i] - (5 + double(i) / 299);
        CHECK(std::abs(deviation) <= 0.5);
        sum += deviation;
        largest = std::max(largest, std::abs(deviation));
    }
    CHECK(std::abs(sum / 300) < 0.06);
    CHECK(largest > 0.45);
}

TEST_CASE("The depth of a recursion counts from 1", "[pgraph]") {
    CHECK(first_values("Horn stem\n  length 2 ^ depth\n  recursion 4\ncamera -> stem -> stem\n", "Stem") ==
          std::vector<double>{2, 4, 8, 16});
}

TEST_CASE("Children and branches keep their random numbers when there are more or fewer of them", "[pgraph]") {
    const auto lengths = [](int count) {
        const std::string number = std::to_string(count);
        auto instances = instances_of("Tree stem\n  branches " + number + "\nHydra star\n  count " + number +
                                      "\nLeaf petal\n  length 1 noise 0.5\nLeaf blade\n  length 1 noise 0.5\n" +
                                      "camera -> stem -B-> blade\nstem -> star -> petal\n");
        std::vector<double> all;
        for (const char* symbol : {"Petal", "Blade"}) {
            CHECK(instances[symbol].size() == std::size_t(count));
            for (std::size_t i = 0; i < 5; ++i) all.push_back(instances[symbol].at(i).front());
        }
        return all;
    };
    const std::vector<double> five = lengths(5);
    for (const int count : {6, 7, 8, 9, 100}) CHECK(lengths(count) == five);
}

TEST_CASE("A multiplier may have 900000 children", "[pgraph]") {
    CHECK(instances_of("Hydra star\n  count 900000\nSimple dot\ncamera -> star -> dot\n")["Dot"].size() == 900000);
    CHECK_THAT(graph_mistakes("Hydra star\n  count 900001\nSimple dot\ncamera -> star -> dot\n"),
               Catch::Contains("'count' must be from 0 to 900000"));
}
