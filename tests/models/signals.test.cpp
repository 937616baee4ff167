// models/signals: context as published and as other programs find it, times of flowering.
#include "catch.h"
#include "experiments/growth.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

using namespace espalier;

namespace {

std::string signal_model(const std::string& name) {
    return "models/signals/" + name + ".l";
}

/// The step in which each node's bud has become a flower, by the first parameter of the flower.
std::map<int, int> flowering_times(const std::string& name, int steps) {
    LonePlant plant(signal_model(name));
    std::map<int, int> times;
    for (int step = 1; step <= steps; ++step) {
        plant.grow(1);
        const auto offsets = parameter_offsets(plant.string, plant.model->alphabet);
        for (std::size_t i = 0; i < plant.string.size(); ++i) {
            if (plant.model->alphabet.name(plant.string.letters[i]) != "W") continue;
            times.emplace(static_cast<int>(plant.string.parameters[offsets[i]]), step);
        }
    }
    return times;
}

/// An interpreter of Hogeweg and Hesper's rules, for strings of F 0 1 + - [ ] only. `successors` belong to the
/// contexts 000, 001, ... 111.
class HogewegHesper {
public:
    explicit HogewegHesper(std::vector<std::string> successors) : successors_(std::move(successors)) {}

    std::string step(const std::string& old) const {
        std::string result;
        for (std::size_t i = 0; i < old.size(); ++i) {
            const char c = old[i];
            if (c == '+' || c == '-') {
                result += c == '+' ? '-' : '+';
            } else if (c == '0' || c == '1') {
                const char left = left_of(old, i), right = right_of(old, i);
                if (left && right) {
                    result += successors_[static_cast<std::size_t>((left - '0') * 4 + (c - '0') * 2 + (right - '0'))];
                } else {
                    result += c;
                }
            } else {
                result += c;
            }
        }
        return result;
    }

private:
    static char left_of(const std::string& s, std::size_t i) {
        for (int skipped = 0; i-- > 0;) {
            if (s[i] == ']') ++skipped;
            if (s[i] == '[' && skipped > 0) --skipped;
            if (skipped == 0 && (s[i] == '0' || s[i] == '1')) return s[i];
        }
        return 0;
    }
    static char right_of(const std::string& s, std::size_t i) {
        for (int skipped = 0; ++i < s.size();) {
            if (s[i] == ']' && skipped-- == 0) return 0;
            if (s[i] == '[') ++skipped;
            if (skipped == 0 && (s[i] == '0' || s[i] == '1')) return s[i];
        }
        return 0;
    }

    std::vector<std::string> successors_;
};

}  // namespace

TEST_CASE("A signal travels one place a step and leaves the string at its end", "[signals]") {
    LonePlant row(signal_model("travelling-signal"));
    CHECK(row.text() == "baaaaaaaa");
    for (std::size_t k = 1; k <= 8; ++k) {
        row.grow(1);
        std::string expected = "aaaaaaaaa";
        expected[k] = 'b';
        CHECK(row.text() == expected);
    }
    row.grow(1);
    CHECK(row.text() == "aaaaaaaaa");
}

TEST_CASE("Neighbours in AB[C[D[EF]G][HIJ]K]L[MN]O[[PQR]ST[UV]WY]Z: left climbs to the parent, right stays on the axis",
          "[signals]") {
    LonePlant plant(signal_model("neighbours"));
    plant.grow(1);
    std::map<char, char> left, right;
    const double* values = plant.string.parameters.data();
    REQUIRE(plant.string.parameters.size() == 75);
    for (std::size_t i = 0; i < 25; ++i) {
        const auto letter = [](double number) { return number > 0 ? static_cast<char>('A' - 1 + number) : '-'; };
        left[letter(values[3 * i])] = letter(values[3 * i + 1]);
        right[letter(values[3 * i])] = letter(values[3 * i + 2]);
    }
    const auto table = [](const std::map<char, char>& neighbours) {
        std::string text;
        for (const auto& [module, neighbour] : neighbours) text += std::string{module, neighbour, ' '};
        return text;
    };
    CHECK(table(left) == "A- BA CB DC ED FE GD HC IH JI KC LB ML NM OL PO QP RQ SO TS UT VU WT YW ZO ");
    CHECK(table(right) == "AB BL CK DG EF F- G- HI IJ J- K- LO MN N- OZ PQ QR R- ST TW UV V- WY Y- Z- ");
}

TEST_CASE("Acropetal signals enter branches, basipetal ones stay on the axis", "[signals]") {
    LonePlant up(signal_model("acropetal")), down(signal_model("basipetal"));
    const std::vector<std::string> rising{"B[+B]B[-A]A[+A]A", "B[+B]B[-B]B[+A]A", "B[+B]B[-B]B[+B]B",
                                          "B[+B]B[-B]B[+B]B"};
    const std::vector<std::string> falling{"A[+A]A[-A]B[+A]B", "A[+A]B[-A]B[+A]B", "B[+A]B[-A]B[+A]B",
                                           "B[+A]B[-A]B[+A]B"};
    for (std::size_t step = 0; step < 4; ++step) {
        up.grow(1);
        down.grow(1);
        CHECK(up.text() == rising[step]);
        CHECK(down.text() == falling[step]);
    }
}

TEST_CASE("Acropetal flowering: node i flowers at i + c; basipetal flowering: at N - i + c", "[signals]") {
    const std::map<int, int> up = flowering_times("acropetal-flowering", 40);
    const std::map<int, int> down = flowering_times("basipetal-flowering", 40);
    REQUIRE(up.size() == 12);
    REQUIRE(down.size() == 13);  // the apex flowers too
    for (const auto& [node, time] : up) CHECK(time == up.at(0) + node);
    for (const auto& [node, time] : down) {
        if (node < 12) CHECK(time == down.at(11) + 11 - node);
    }
    CHECK(down.at(12) < down.at(11));
}

TEST_CASE("Two signals meet where the ratio of their speeds says, and make one branch", "[signals]") {
    for (int slow = 1; slow <= 7; ++slow) {
        LonePlant plant(signal_model("two-speeds"), {{"SLOW", std::to_string(slow)}});
        plant.grow(24);
        CHECK(plant.counts()["Branch"] == 1);
        const std::string branch = "Branch(" + std::to_string((20 + slow) / (slow + 1)) + ")";
        CHECK(plant.text().find(branch) != std::string::npos);
    }
}

TEST_CASE("Apical dominance: buds break from below, and also from above once the apex is gone", "[signals]") {
    LonePlant plant(signal_model("apical-dominance"));
    std::map<int, int> breaking;
    for (int step = 1; step <= 40; ++step) {
        plant.grow(1);
        const auto offsets = parameter_offsets(plant.string, plant.model->alphabet);
        for (std::size_t i = 0; i < plant.string.size(); ++i) {
            if (plant.model->alphabet.name(plant.string.letters[i]) != "Branch") continue;
            breaking.emplace(static_cast<int>(plant.string.parameters[offsets[i]]), step);
        }
    }
    REQUIRE(breaking.size() == 20);
    const int from_below = breaking.at(0), from_above = breaking.at(19);
    CHECK(from_below < 20);
    CHECK(from_above == 22);
    for (int node = 0; node < 20; ++node) {
        CHECK(breaking.at(node) == std::min(from_below + node, from_above + 19 - node));
    }
    CHECK(plant.counts()["Bud"] + plant.counts()["Apex"] == 0);
}

TEST_CASE("Hogeweg and Hesper's patterns: the strings of all steps are those of an interpreter of their own",
          "[signals]") {
    struct Pattern {
        const char* name;
        int steps;
        std::vector<std::string> successors;
    };
    for (const Pattern& pattern : {Pattern{"a", 30, {"0", "1[+F1F1]", "1", "1", "0", "1F1", "0", "0"}},
                                   Pattern{"b", 30, {"1", "1[-F1F1]", "1", "1", "0", "1F1", "1", "0"}},
                                   Pattern{"c", 26, {"0", "1", "0", "1[+F1F1]", "0", "1F1", "0", "0"}},
                                   Pattern{"d", 24, {"1", "0", "0", "1F1", "1", "1[+F1F1]", "1", "0"}},
                                   Pattern{"e", 26, {"0", "1[-F1F1]", "1", "1", "0", "1F1", "1", "0"}}}) {
        INFO(pattern.name);
        LonePlant plant(signal_model(std::string("hogeweg-hesper-") + pattern.name));
        const HogewegHesper reference(pattern.successors);
        std::string expected = pattern.name == std::string("d") ? "F0F1F1" : "F1F1F1";
        CHECK(plant.text() == expected);
        for (int step = 1; step <= pattern.steps; ++step) {
            expected = reference.step(expected);
            plant.grow(1);
            REQUIRE(plant.text() == expected);
        }
        CHECK(plant.counts()["F"] == std::count(expected.begin(), expected.end(), 'F'));
        CHECK(plant.counts()["F"] > 100);
    }
}
