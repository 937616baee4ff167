// models/cells: published strings, and programs of their own for what has none.
#include "catch.h"
#include "experiments/growth.h"
#include "models/measure.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <string>
#include <vector>

using namespace espalier;

namespace {

std::string cell_model(const std::string& name) {
    return "models/cells/" + name + ".l";
}

struct AnabaenaCell {
    double size;
    int type;
    double c;
};

/// One step of the filament: division of long cells, diffusion and growth of inner ones, starving ones become sources.
std::vector<AnabaenaCell> next_filament(const std::vector<AnabaenaCell>& old) {
    std::vector<AnabaenaCell> cells;
    for (std::size_t i = 0; i < old.size(); ++i) {
        const AnabaenaCell& cell = old[i];
        if (cell.size >= 6 && cell.type == 1) {
            cells.push_back({cell.size / 3 * 2, 2, cell.c});
            cells.push_back({cell.size / 3, 1, cell.c});
        } else if (cell.size >= 6 && cell.type == 2) {
            cells.push_back({cell.size / 3, 2, cell.c});
            cells.push_back({cell.size / 3 * 2, 1, cell.c});
        } else if (cell.type == 0) {
            cells.push_back(cell);
        } else if (cell.size > 3.9 || cell.c > 0.4) {
            cells.push_back({cell.size + 0.1, cell.type, cell.c + 0.25 * (old[i - 1].c + old[i + 1].c - 3 * cell.c)});
        } else {
            cells.push_back({0, 0, 900});
        }
    }
    return cells;
}

}  // namespace

TEST_CASE("Fibonacci: the printed strings, each the two before it joined", "[cells]") {
    LonePlant cells(cell_model("fibonacci"));
    std::vector<std::string> strings{cells.text()};
    for (int step = 1; step <= 12; ++step) {
        cells.grow(1);
        strings.push_back(cells.text());
    }
    CHECK(std::vector<std::string>(strings.begin(), strings.begin() + 6) ==
          std::vector<std::string>{"b", "a", "ab", "aba", "abaab", "abaababa"});
    for (std::size_t n = 2; n < strings.size(); ++n) CHECK(strings[n] == strings[n - 1] + strings[n - 2]);
    CHECK(strings.back().size() == 233);
}

TEST_CASE("Anabaena catenula: the printed filaments", "[cells]") {
    LonePlant filament(cell_model("anabaena"));
    for (const char* expected : {"Ar", "AlBr", "BlArAr", "AlAlBrAlBr", "BlArBlArArBlArAr"}) {
        CHECK(filament.text() == expected);
        filament.grow(1);
    }
}

TEST_CASE("Heterocysts: every cell of every step is that of a program of its own; sources keep their distance",
          "[cells]") {
    LonePlant filament(cell_model("heterocysts"));
    std::vector<AnabaenaCell> expected{{0, 0, 900}, {4, 1, 900}, {0, 0, 900}};
    for (int step = 1; step <= 360; ++step) {
        expected = next_filament(expected);
        filament.grow(1);
        if (step % 20 != 0) continue;
        const auto cells = parameters_of(filament.string, filament.model->alphabet, "Cell");
        REQUIRE(cells.size() == expected.size());
        for (std::size_t i = 0; i < cells.size(); ++i) {
            CHECK(cells[i][0] == Approx(expected[i].size));
            CHECK(cells[i][1] == expected[i].type);
            CHECK(cells[i][2] == Approx(expected[i].c));
        }
    }
    std::vector<std::size_t> sources;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (expected[i].type == 0) sources.push_back(i);
    }
    REQUIRE(sources.size() > 50);
    CHECK(filament.counts()["Heterocyst"] == static_cast<int>(sources.size()) - 2);
    for (std::size_t i = 1; i < sources.size(); ++i) {
        CHECK(sources[i] - sources[i - 1] > 1);
        CHECK(sources[i] - sources[i - 1] < 40);
    }
    const double apart = static_cast<double>(expected.size() - 1) / static_cast<double>(sources.size() - 1);
    CHECK(apart > 15);
    CHECK(apart < 25);
}

TEST_CASE("Ring: the pattern goes round and comes back", "[cells]") {
    LonePlant ring(cell_model("ring"));
    std::vector<double> states(ring.string.parameters.begin(), ring.string.parameters.end());
    const std::vector<double> start = states;
    REQUIRE(states.size() == 12);
    for (int step = 1; step <= 12; ++step) {
        std::rotate(states.begin(), states.end() - 1, states.end());
        ring.grow(1);
        CHECK(std::vector<double>(ring.string.parameters.begin(), ring.string.parameters.end()) == states);
    }
    CHECK(states == start);
}

TEST_CASE("Cantor: a third is drawn if its number has no 1 in base 3", "[cells]") {
    LonePlant dust(cell_model("cantor"));
    dust.grow(6);
    const std::string text = dust.text();
    REQUIRE(text.size() == 729);
    CHECK(dust.counts()["F"] == 64);
    for (std::size_t k = 0; k < text.size(); ++k) {
        bool gap = false;
        for (std::size_t rest = k; rest > 0; rest /= 3) gap |= rest % 3 == 1;
        CHECK(text[k] == (gap ? 'f' : 'F'));
    }
}

TEST_CASE("Thue and Morse: parities of the ones, and nothing three times in a row", "[cells]") {
    LonePlant sequence(cell_model("thue-morse"));
    sequence.grow(9);
    const std::string text = sequence.text();
    REQUIRE(text.size() == 512);
    for (unsigned k = 0; k < 512; ++k) CHECK(text[k] == (std::popcount(k) % 2 == 0 ? '0' : '1'));
    for (std::size_t length = 1; length <= 512 / 3; ++length) {
        std::size_t run = 0;
        for (std::size_t i = 0; i + length < text.size(); ++i) {
            run = text[i] == text[i + length] ? run + 1 : 0;
            if (run >= 2 * length) FAIL("a block of " << length << " stands three times at " << i);
        }
    }
}

TEST_CASE("Pascal: binomial coefficients, as many odd ones as powers of 2 say", "[cells]") {
    LonePlant triangle(cell_model("pascal"));
    for (unsigned n = 1; n <= 31; ++n) {
        triangle.grow(1);
        const auto cells = parameters_of(triangle.string, triangle.model->alphabet, "Cell");
        REQUIRE(cells.size() == n + 1);
        double choose = 1;
        int odd = 0;
        for (unsigned k = 0; k <= n; ++k) {
            CHECK(cells[k][0] == choose);
            odd += std::fmod(cells[k][0], 2) == 1;
            choose = choose * (n - k) / (k + 1);
        }
        CHECK(odd == 1 << std::popcount(n));
    }
    // The past of cell k is one state shorter than that of cell k - 1.
    CHECK(triangle.counts()["Odd"] == 31 * 32 / 2);
}

TEST_CASE("Elementary automata: rules 30, 90 and 110 on a ring, with their whole past", "[cells]") {
    for (int rule : {30, 90, 110}) {
        INFO(rule);
        LonePlant ring(cell_model("elementary-automaton"), {{"RULE", std::to_string(rule)}, {"WIDTH", "41"}});
        ring.grow(1);
        std::vector<int> row(41, 0);
        row[20] = 1;
        std::string centre, past;
        for (int step = 0; step < 40; ++step) {
            const auto cells = parameters_of(ring.string, ring.model->alphabet, "Cell");
            REQUIRE(cells.size() == 41);
            for (std::size_t i = 0; i < 41; ++i) REQUIRE(cells[i][0] == row[i]);
            centre += row[20] == 1 ? '1' : '0';
            std::vector<int> next(41);
            for (std::size_t i = 0; i < 41; ++i) {
                next[i] = rule >> (4 * row[(i + 40) % 41] + 2 * row[i] + row[(i + 1) % 41]) & 1;
            }
            row = next;
            ring.grow(1);
        }
        if (rule == 30) CHECK(centre.substr(0, 20) == "11011100110001011001");
        // The middle column, newest state first.
        const auto states = parameters_of(ring.string, ring.model->alphabet, "State");
        REQUIRE(states.size() == 41 * 40);
        for (std::size_t i = 0; i < 40; ++i) past += states[20 * 40 + i][0] == 1 ? '1' : '0';
        CHECK(past == std::string(centre.rbegin(), centre.rend()));
    }
}

TEST_CASE("anabaena-timed: at whole times it is the discrete filament, whatever the step", "[cells]") {
    for (const auto& [step, at_once] : {std::pair{"1", 1}, {"0.1", 10}, {"0.3", 10}, {"0.125", 8}, {"7", 1}}) {
        LonePlant timed(cell_model("anabaena-timed"), {{"DT", step}});
        LonePlant discrete(cell_model("anabaena"));
        const int whole = static_cast<int>(std::lround(std::stod(step) * at_once));
        for (int time = whole; time <= 7; time += whole) {
            timed.grow(at_once);
            discrete.grow(whole);
            CHECK(symbols_of(timed.string, timed.model->alphabet) ==
                  symbols_of(discrete.string, discrete.model->alphabet));
            for (const double age : timed.string.parameters) CHECK(age == Approx(0).margin(1e-12));
        }
    }
}

TEST_CASE("anabaena-timed: the filament grows by the golden section at every time", "[cells]") {
    const double golden = (std::sqrt(5) + 1) / 2;
    for (const double step : {0.1, 0.37, 2.6}) {
        LonePlant filament(cell_model("anabaena-timed"), {{"DT", std::to_string(step)}});
        for (double time = step; time < 8; time += step) {
            filament.grow(1);
            CHECK(total_length(filament.interpretation.geometry) == Approx(std::pow(golden, time - 1)).epsilon(1e-9));
        }
    }
}

TEST_CASE("anabaena-timed: the ages of a time are the same whatever steps led to it", "[cells]") {
    LonePlant coarse(cell_model("anabaena-timed"), {{"DT", "5.4"}}),
        fine(cell_model("anabaena-timed"), {{"DT", "0.2"}});
    coarse.grow(1);
    fine.grow(27);
    REQUIRE(coarse.string.letters == fine.string.letters);
    for (std::size_t i = 0; i < coarse.string.parameters.size(); ++i) {
        CHECK(coarse.string.parameters[i] == Approx(fine.string.parameters[i]).epsilon(1e-9));
    }
}
