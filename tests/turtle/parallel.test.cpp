// Walks by several threads against the walk in one piece.
#include "espalier/base/error.h"

#include "catch.h"
#include "lineage.h"
#include "turtle/drawing.h"
#include "turtle/walk/parallel_walk.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstring>
#include <random>
#include <string>
#include <thread>
#include <vector>

using namespace espalier;
using namespace espalier::turtle;

namespace {

/// Everything an interpretation holds, byte for byte.
class Bytes {
public:
    explicit Bytes(const Interpretation& result) {
        const PlantGeometry& geometry = result.geometry;
        for (const Internode& row : geometry.internodes) {
            add(row.module, row.axis, row.order, row.colour, row.pixels, row.base, row.tip, row.base_radius,
                row.tip_radius);
        }
        for (const Polygon& row : geometry.polygons) {
            add(row.module, row.first, row.count, row.order, row.colour, row.look.back_colour, row.look.texture);
        }
        for (const glm::dvec3& row : geometry.vertices) add(row);
        for (const Organ& row : geometry.organs) {
            add(row.module, row.shape, row.order, row.colour, row.surface, row.pose, row.size, row.look.back_colour,
                row.look.texture, row.sides);
        }
        for (const SurfaceVertex& row : geometry.mesh.vertices) add(row.position, row.normal);
        for (const std::uint32_t row : geometry.mesh.triangles) add(row);
        for (const MeshPiece& row : geometry.mesh.pieces) add(row.module, row.first, row.count, row.order, row.colour);
        for (const Label& row : geometry.labels) {
            add(row.module, row.order, row.colour, row.position, row.text.size());
            bytes += row.text;
        }
        for (const std::uint16_t row : geometry.textures) add(row);
        add(geometry.internodes.size(), geometry.organs.size(), geometry.axes, geometry.bounds.lower,
            geometry.bounds.upper);
        for (const Query& row : result.queries) {
            add(row.process, row.following, row.module, row.parameters_at, row.parameters.data(), row.parameters.size(),
                row.following_parameters.data(), row.pose, row.width, row.scale, row.plant, row.identity,
                row.following_identity);
        }
        for (const TurtleAnswer& row : result.answers) {
            add(row.module, row.count, row.parameters_at, row.position, row.width);
        }
        for (const TurtleDirection& row : result.directions) add(row.parameters_at, row.count, row.values);
    }

    std::string bytes;

private:
    template <class... Values>
    void add(const Values&... values) {
        (bytes.append(reinterpret_cast<const char*>(&values), sizeof(values)), ...);
    }
};

struct Outcome {
    std::string bytes;    ///< bytes of the result
    std::string failure;  ///< or the message

    bool operator==(const Outcome&) const = default;
};

Outcome walked(const Drawing& drawing, std::size_t chunk) {
    Interpretation result;
    try {
        interpret(drawing.model, *symbol_table(drawing.model), drawing.string, drawing.settings, nullptr,
                  {0, nullptr, chunk}, result);
    } catch (const RunError& error) {
        return {"", error.what()};
    }
    return {Bytes(result).bytes, ""};
}

bool goes_in_parallel(const Drawing& drawing, std::size_t chunk) {
    const SymbolTable symbols(drawing.model);
    Interpretation result;
    return walk_in_parallel({drawing.model, symbols, drawing.string, drawing.settings, nullptr, 0, nullptr}, chunk,
                            result);
}

class RandomString {
public:
    explicit RandomString(unsigned seed) : random_(seed) {}

    /// About `length` symbols drawn from `symbols`, in branches upon branches; a # in one is replaced by a number.
    std::string of(const std::vector<std::string>& symbols, std::size_t length) {
        std::string text;
        for (std::size_t at = 0; at < length; at += branch_length + 2) {
            text += symbol(symbols) + "[" + branch(symbols) + "]";
        }
        return text;
    }

private:
    static constexpr std::size_t branch_length = 40;

    std::string branch(const std::vector<std::string>& symbols) {
        std::string text;
        int depth = 0;
        for (std::size_t i = 0; i < branch_length; ++i) {
            const unsigned turn = random_() % 8;
            if (turn == 0) {
                text += '[';
                ++depth;
            } else if (turn == 1 && depth > 0) {
                text += ']';
                --depth;
            } else {
                text += symbol(symbols);
            }
        }
        return text + std::string(std::size_t(depth), ']');
    }

    std::string symbol(const std::vector<std::string>& symbols) {
        std::string text;
        for (const char c : symbols[random_() % symbols.size()]) {
            text += c == '#' ? fmt::format("{}", double(random_() % 1000) / 100) : std::string(1, c);
        }
        return text;
    }

    std::mt19937 random_;
};

TurtleSettings busy_settings() {
    TurtleSettings settings;
    settings.tropisms.resize(2);
    settings.tropisms[0].elasticity = 0.1;
    settings.tropisms[1].direction = {1, 0, 0};
    settings.tropisms[1].torque = true;
    settings.initial_elasticity = 0.05;
    return settings;
}

const std::vector<std::string> plain = {"F(#)",      "F",     "G(#)",  "f(#)", "+(#)",  "-",         "&(#)",
                                        "^",         "/(#)",  "\\",    "|",    "!(#)",  "#(#)",      ";(#)",
                                        ",",         "@v",    "A",     "B(#)", "@D(#)", "@R(#,#,#)", "@Di(1.01)",
                                        "?P(#,#,#)", "?E(#)", "@O(#)", "@c",   "~l(#)"};

/// Symbols that carry something from one branch to the next, and some that only look like others.
const std::vector<std::string> carrying = {
    "{",          "}",      ".",         "{.f.+f.}",  "@Tx(3)", "@Tx(0)", "@Ts(1,#)", "@Ti(2,0.01)", "_(0.1)",
    "?(1,2)",     "$",      "@M(#,#,#)", "@R(#,1,#)", "@Gs",    "@Gc(2)", "@Ge(2)",   "@!(5)",       "@PS(1)",
    "@PC(1,1,2)", "@PD(1)", "@;(3)",     "@F",        "@",      "?",      "]",        "%",           "@Tf"};

std::vector<std::string> both() {
    std::vector<std::string> all = plain;
    all.insert(all.end(), carrying.begin(), carrying.end());
    return all;
}

}  // namespace

TEST_CASE("a plant walked by several threads is the plant walked in one piece, to the last bit", "[turtle]") {
    int in_parallel = 0;
    for (const int threads : {1, 2, 8}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
        for (unsigned seed = 0; seed < 25; ++seed) {
            RandomString random(seed);
            Drawing drawing(random.of(plain, 800 + 100 * seed));
            if (seed % 2) drawing.settings = busy_settings();
            if (seed % 3 == 0) drawing.settings.tapered_lines = false;
            if (seed % 5 < 2) drawing.model.arithmetic = Arithmetic::cpfg;
            const Outcome whole = walked(drawing, 0);
            for (const std::size_t chunk : {1, 7, 50}) {
                CHECK(walked(drawing, chunk) == whole);
                in_parallel += goes_in_parallel(drawing, chunk);
            }
        }
    }
    CHECK(in_parallel > 50);
}

TEST_CASE("labels, and the lineage of queries, are the same from several threads", "[turtle]") {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 2);
    std::vector<std::string> symbols = plain;
    symbols.insert(symbols.end(), {"@L(0,#,#)", "@L(1)"});
    int in_parallel = 0;
    for (unsigned seed = 0; seed < 25; ++seed) {
        RandomString random(2000 + seed);
        Drawing drawing(random.of(symbols, 1600));
        drawing.model.texts = {"%.2f of %g", "leaf"};
        for (std::size_t i = 0; i < drawing.string.size(); ++i) {
            test::append_lineage(drawing.string, 3 * i + seed, 0, 0);
        }
        const Outcome whole = walked(drawing, 0);
        for (const std::size_t chunk : {1, 50}) {
            CHECK(walked(drawing, chunk) == whole);
            in_parallel += goes_in_parallel(drawing, chunk);
        }
        REQUIRE(drawing.geometry().labels.size() > 20);
        const Query& last = drawing.result.queries.back();
        CHECK(last.identity == 3 * last.module + seed);
    }
    CHECK(in_parallel > 40);
}

TEST_CASE("what a turtle carries across branches is not lost between threads", "[turtle]") {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 8);
    int failed = 0;
    for (unsigned seed = 0; seed < 150; ++seed) {
        RandomString random(1000 + seed);
        // One carrying symbol alone, and all of them together.
        std::vector<std::string> symbols = plain;
        if (seed < 3 * carrying.size()) {
            symbols.push_back(carrying[seed % carrying.size()]);
        } else {
            symbols = both();
        }
        Drawing drawing(random.of(symbols, 600));
        drawing.settings = busy_settings();
        drawing.settings.past_cut = seed % 2 == 0;
        const Outcome whole = walked(drawing, 0);
        failed += !whole.failure.empty();
        INFO(seed);
        for (const std::size_t chunk : {1, 20}) CHECK(walked(drawing, chunk) == whole);
    }
    CHECK(failed < 75);
}

TEST_CASE("axes that reach over many stretches keep their number, whoever walks which", "[turtle]") {
    constexpr std::size_t laterals = 2000;
    const std::string lateral = "[+(20)F(1)-F(1)-F(1)+F(1)+F(1)-F(1)-F(1)+F(1)]";
    std::string text = "F[";
    for (std::size_t i = 0; i < laterals; ++i) text += "F" + lateral;
    const Drawing drawing(text + "]F");
    const auto wrong_axes = [&] {
        const SymbolTable symbols(drawing.model);
        Interpretation result;
        REQUIRE(walk_in_parallel({drawing.model, symbols, drawing.string, drawing.settings, nullptr, 0, nullptr}, 50,
                                 result));
        const auto& rows = result.geometry.internodes;
        REQUIRE(rows.size() == 2 + 9 * laterals);
        int wrong = (rows.front().axis != 0) + (rows.back().axis != 0) + (result.geometry.axes != laterals + 2);
        for (std::size_t i = 0; i < laterals; ++i) {
            const Internode* const row = &rows[1 + 9 * i];
            wrong += row[0].axis != 1 || row[1].axis != i + 2 || row[8].axis != i + 2;
        }
        return wrong;
    };
    for (const int threads : {2, 3, 8}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
        for (int round = 0; round < 10; ++round) CHECK(wrong_axes() == 0);
        tbb::task_arena alone(1);  // one thread for all stretches
        alone.execute([&] { CHECK(wrong_axes() == 0); });
    }
}

TEST_CASE("a model that carries more than was foreseen is walked in one piece from then on", "[turtle]") {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 2);
    std::string text;
    for (int i = 0; i < 100; ++i) text += "F[+F-F-F+F+F-F-F+F]";
    const Drawing plain_branches(text);
    CHECK(goes_in_parallel(plain_branches, 50));

    const Drawing drawing(text + "[@!(5)F@O(1)]" + text);
    const SymbolTable symbols(drawing.model);
    const WalkInput input{drawing.model, symbols, drawing.string, drawing.settings, nullptr, 0, nullptr};
    Interpretation result;
    CHECK(!walk_in_parallel(input, 50, result));
    CHECK(symbols.unpredictable);
    CHECK(Bytes(result).bytes == Bytes(Interpretation()).bytes);
    CHECK(walked(drawing, 50) == walked(drawing, 0));
}

TEST_CASE("the first of several mistakes is told, whichever thread met one", "[turtle]") {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 8);
    std::string text;
    for (int i = 0; i < 400; ++i) text += i == 200 || i == 300 ? "[+F(1)!(1e999)F(2)]" : "[+F(1)!(0.1)F(2)]F";
    const Drawing drawing(text);
    const Outcome outcome = walked(drawing, 10);
    CHECK(outcome == walked(drawing, 0));
    CHECK(outcome.failure.find("the line width is not a number, at module 1403 of plant 0") != std::string::npos);
}

TEST_CASE("branches that end before they began, and that never end, are walked alike by several threads", "[turtle]") {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 8);
    const auto repeated = [](const std::string& text) {
        std::string all;
        for (int i = 0; i < 200; ++i) all += text;
        return all;
    };
    for (const std::string text : {"F[+F", "F]+F", "[F]]F[", "F[+F]", "[F(0.1)", "+F", "[]", "]"}) {
        const Drawing drawing(repeated(text));
        INFO(text);
        for (const std::size_t chunk : {1, 30}) CHECK(walked(drawing, chunk) == walked(drawing, 0));
    }
}

TEST_CASE("a walk finds nothing of the one before it in the same thread", "[turtle]") {
    RandomString random(11);
    const auto left_open = [&] { return random.of(both(), 200) + "[{F@Gs+F@PS(1)@Tx(3)_(0.1)[!(3)"; };
    int failed = 0, compared = 0;
    for (int round = 0; round < 40; ++round) {
        Drawing drawing(left_open() + (round % 4 == 0 ? "!(1e999)" : ""));
        if (round % 2 == 0) drawing.settings = busy_settings();
        drawing.settings.angle = 0.1 * (round % 3);
        Outcome fresh;
        std::thread([&] { fresh = walked(drawing, 0); }).join();
        CHECK(walked(drawing, 0) == fresh);
        failed += !fresh.failure.empty();
        compared += fresh.failure.empty() && fresh.bytes.size() > 1000;
    }
    CHECK(failed >= 1);
    CHECK(compared >= 20);
}
