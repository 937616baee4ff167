// The table of siblings: strings share it, steps add to it, and rows that nobody needs are dropped.
#include "espalier/base/stop.h"

#include "catch.h"
#include "lsystem/model_builder.h"

#include <set>
#include <sstream>
#include <type_traits>

using namespace espalier;
using namespace espalier::lsystem;
using namespace espalier::test;

namespace {

/// Every module dies in every step, and another is born in its place.
ModelBuilder flipping_cells(int cells) {
    ModelBuilder model;
    for (int k = 0; k < cells; ++k) model.system().axiom.push_back(model.module("A", {}));
    model.rule("A", "B");
    model.rule("B", "A");
    return model;
}

}  // namespace

TEST_CASE("a lineage takes eight bytes a module, and a row for each set of siblings", "[lsystem]") {
    static_assert(sizeof(Birth) == 8);
    ModelBuilder model;
    model.system().axiom = model.word("X");
    model.rule("X", "F-[[X]+X]+F[+FX]-X");
    Derivation derivation(model.compiled(), with_lineage());
    const ModuleString string = grow(derivation, 4);
    CHECK(string.siblings.size() == 1 + 1 + 4 + 16 + 64);
}

TEST_CASE("rows of siblings that no module belongs to are dropped", "[lsystem]") {
    constexpr int cells = 100;
    ModelBuilder model = flipping_cells(cells);
    Derivation derivation(model.compiled(), with_lineage());
    ModuleString string, next;
    derivation.start(string);
    for (std::uint32_t step = 1; step <= 60; ++step) {
        derivation.step(string, next);
        std::swap(string, next);
        REQUIRE(string.siblings.size() <= 2 * cells);
        REQUIRE(string.step_of_birth(0) == step);
    }
    const std::vector<Identity> all = identities_of(string);
    CHECK(std::set<Identity>(all.begin(), all.end()).size() == cells);
}

TEST_CASE("two strings made from one share no rows, and the one they were made from stays as it was", "[lsystem]") {
    ModelBuilder model = flipping_cells(20);
    const auto compiled = model.compiled();
    Derivation one(compiled, with_lineage(1, 0)), other(compiled, with_lineage(1, 0));
    ModuleString string, first, second, third;
    one.start(string);
    const std::vector<Identity> before = identities_of(string);
    one.step(string, first);
    const std::vector<Identity> of_first = identities_of(first);
    other.start(second);
    other.step(string, second);
    one.step(first, third);
    CHECK(identities_of(first) == of_first);
    CHECK(identities_of(second) == of_first);
    CHECK(identities_of(string) == before);
    CHECK(third.step_of_birth(0) == 2);
    CHECK(third.parent(0) == of_first[0]);
}

TEST_CASE("a table of siblings grows behind what it has", "[lsystem]") {
    SiblingTable table;
    std::vector<SiblingTable> older;
    for (std::uint32_t row = 0; row < 1000; ++row) {
        older.push_back(table);
        table = table.grown(1);
        table.added(row) = {row, row, 0};
    }
    for (std::size_t size = 0; size < older.size(); ++size) {
        CHECK(older[size].size() == size);
        if (size > 0) CHECK(older[size][size - 1].parent == size - 1);
    }
    SiblingTable fork = older[500].grown(1);
    fork.added(500) = {7, 7, 7};
    CHECK(table[500].parent == 500);
    CHECK(fork[499].parent == 499);
}

TEST_CASE("a module that its production replaces by itself lives on, as one that none replaces", "[lsystem]") {
    const auto grown = [](bool replaced) {
        ModelBuilder model;
        model.system().axiom = model.word("ABABCB");
        model.rule("", "C", "", "CB");
        if (replaced) model.rule("A", "B", "", "B");
        Derivation derivation(model.compiled(), with_lineage());
        return grow(derivation, 5);
    };
    const ModuleString string = grown(true);
    CHECK(identities_of(string) == identities_of(grown(false)));
    CHECK(string.step_of_birth(1) == 0);
    CHECK(string.step_of_birth(5) == 5);
}

TEST_CASE("a large table of siblings is copied when it is four times as long, not before", "[lsystem]") {
    constexpr std::size_t rows = 10'000;
    const SiblingTable table = SiblingTable().grown(rows);
    const SiblingTable long_one = table.grown(3 * rows);
    CHECK(&long_one[0] == &table[0]);
    CHECK(&long_one.grown(1)[0] != &table[0]);
}

TEST_CASE("many siblings are copied until it is stopped", "[lsystem]") {
    const SiblingTable many = SiblingTable().grown(2'000'000);
    StopRequest request;
    const StopRequest::Scope scope(&request);
    CHECK(many.grown(2'000'000).size() == 4'000'000);
    request.ask();
    CHECK_THROWS_AS(many.grown(2'000'000), Stopped);
}

// Their memory costs nothing until they are written.
TEST_CASE("rows of siblings have no values of their own", "[lsystem]") {
    CHECK(std::is_trivially_default_constructible_v<Siblings>);
}
