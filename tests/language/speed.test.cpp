#include "catch.h"
#include "reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <unistd.h>

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

namespace {

std::string repeated(const std::string& part, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += part;
    return text;
}

// Time of the processor, which others on the machine lengthen less than the clock's; the quickest of three.
template <class Work>
double seconds(const Work& work) {
    double least = 1e9;
    for (int run = 0; run < 3; ++run) {
        const std::clock_t begin = std::clock();
        work();
        least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    }
    return least;
}

// Eight times the text may take eight times as long, and on a busy machine more; sixty-four times is quadratic.
void check_linear(const std::function<std::string(int)>& text) {
    const std::string small = text(2000);
    const std::string large = text(16000);
    CHECK(seconds([&] { read(large); }) < 30 * seconds([&] { read(small); }));
}

}  // namespace

TEST_CASE("reading takes time in proportion to the length of axiom, successors, lines and names", "[language]") {
    check_linear([](int n) { return lsystem_of("", repeated("F(1.5)[+(30)A]", n), "A --> B\n"); });
    check_linear([](int n) { return lsystem_of("", repeated("[A", n) + repeated("]", n), "A --> B\n"); });
    check_linear([](int n) { return lsystem_of("", "A", "A --> " + repeated("F(1.5)[+(30)A]", n) + "\n"); });
    check_linear([](int n) { return lsystem_of("", "A", "A --> B\n" + repeated("\tF(1.5)[+(30)A]\n", n)); });
    check_linear(
        [](int n) { return "#define W 0.5\n" + lsystem_of("", repeated("F(W)@L(\"%d\",1)", n), "A --> B\n"); });
    check_linear([](int n) { return lsystem_of("", "A", repeated("A(x) : x > 1 {y = x;} --> F(x)A(x - 1)\n", n)); });
    check_linear([](int n) {
        std::string declared;
        for (int i = 0; i < n / 4; ++i) declared += fmt::format("module Bud{}(a);\n", i);
        return declared + lsystem_of("", repeated("Bud7(1)", n), "A --> B\n");
    });
    check_linear([](int n) {
        std::string systems;
        for (int i = 0; i < n / 4; ++i) {
            systems += fmt::format("lsystem: {}\nStart: {{x = 1;}}\naxiom: A\nA --> B\n", i);
        }
        return systems;
    });
    check_linear([](int n) {
        std::string names;
        for (int i = 0; i < n / 4; ++i) names += fmt::format("v{0} = u{0} + a{0}[1];\n", i);
        std::string arrays;
        for (int i = 0; i < n / 4; ++i) arrays += fmt::format("array a{}[2];\n", i);
        return lsystem_of("define: {\n" + arrays + "}\nStart: {" + names + "}\n", "A", "A --> B\n");
    });
}

TEST_CASE("reading takes time in proportion to the length of included files", "[language]") {
    const auto folder = std::filesystem::temp_directory_path() / fmt::format("espalier-speed-{}", ::getpid());
    std::filesystem::create_directories(folder);
    const auto including = [&](int lines) {
        std::ofstream(folder / "part.h") << repeated("\tF(1.5)[+(30)A]\n", lines);
        std::ofstream(folder / "model.l") << lsystem_of("", "A", "A --> B\n#include \"part.h\"\n");
        return seconds([&] { read_model(folder / "model.l"); });
    };
    const double small = including(2000);
    CHECK(including(16000) < 30 * small);
    std::filesystem::remove_all(folder);
}
