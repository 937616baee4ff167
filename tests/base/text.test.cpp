#include "base/text.h"

#include "base/excerpt.h"
#include "catch.h"
#include "temporary_folder.h"

using namespace espalier;

TEST_CASE("the nearest name is a slip of the pen away, or none", "[base]") {
    const std::vector<std::string> names = {"voxel", "strength", "depth"};
    CHECK(nearest_name("voxle", names) == "voxel");
    CHECK(nearest_name("strenght", names) == "strength");
    CHECK(nearest_name("gravity", names).empty());
    CHECK(nearest_name("sni", std::vector<std::string>{"sun", "sin"}) == "sin");
    CHECK(nearest_name("x", std::vector<std::string>{"y", "Q"}).empty());
    CHECK(nearest_name("thicknesss", std::vector<std::string>{"thick", "thickness"}) == "thickness");
    CHECK(nearest_name(std::string(1 << 26, 'x'), names).empty());  // in no time
    CHECK(did_you_mean("dept", names) == " (did you mean 'depth'?)");
}

TEST_CASE("numbers print as cpfg prints them, or exactly", "[base]") {
    CHECK(format_general(0.1) == "0.1");
    CHECK(format_general(1e6) == "1e+06");
    CHECK(format_general(123456.7) == "123457");
    CHECK(format_exact(0.1) == "0.1");
    CHECK(std::stod(format_exact(1.0 / 3)) == 1.0 / 3);
}

TEST_CASE("text splits into code points, and invalid bytes stand for themselves", "[base]") {
    CHECK(code_points("aé") == std::vector<std::string>{"a", "é"});
    CHECK(code_points("\xC3(") == std::vector<std::string>{"\xC3", "("});
    CHECK(code_points("\xE2\x82").size() == 2);
}

TEST_CASE("carets line up behind tabs and characters of several bytes, and long lines are cut about them", "[base]") {
    CHECK(excerpt("\tA(\u03b1x)", 6) == "\n    \tA(\u03b1x)\n    \t   ^");
    const std::string half(5000, 'F');
    const std::string cut = excerpt(half + "!" + half, 5001);
    CHECK(cut.size() < 400);
    const std::size_t second = cut.find('\n', 1);
    CHECK(cut.find('!') - 1 == cut.find('^') - second - 1);
}

TEST_CASE("a mistake without its line shows the line of its file", "[base]") {
    const TemporaryFolder folder;
    const std::string file = folder.write("model.l", "lsystem: 1\r\naxiom: A(\r\n").string();
    CHECK(std::string(UserError(Place{file, 2, 9}, "')' is missing").what()) ==
          file + ":2:9: ')' is missing\n    axiom: A(\n            ^");
    CHECK(std::string(UserError(Place{file, 7, 1}, "beyond").what()) == file + ":7:1: beyond");
    CHECK(excerpt(Place{folder.path().string(), 1, 1}).empty());
}

TEST_CASE("a message shows place, source line and caret", "[base]") {
    Diagnostic diagnostic;
    diagnostic.place = {"m.l", 12, 3};
    diagnostic.message = "'lenght' is unknown";
    diagnostic.source = "A(lenght)";
    CHECK(to_string(diagnostic) == "m.l:12:3: 'lenght' is unknown\n    A(lenght)\n      ^");
}

TEST_CASE("words lie between any of the separators, none of them empty", "[base]") {
    using Words = std::vector<std::string>;
    CHECK(words_of("32x32, 7\t", " ,\tx") == Words{"32", "32", "7"});
    CHECK(words_of("", " ").empty());
    CHECK(words_of(" ,, ", " ,").empty());
    CHECK(words_of("one", " ") == Words{"one"});
}
