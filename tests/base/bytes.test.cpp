#include "base/bytes.h"

#include "catch.h"

#include <sstream>
#include <vector>

using namespace espalier;

TEST_CASE("texts and columns come back as they were put", "[base]") {
    std::stringstream bytes;
    const std::string long_text(std::size_t{40} << 20, 'x');  // of several pieces
    const std::vector<double> column{1, 2.5, -3};
    put_text(bytes, "short");
    put_text(bytes, long_text);
    put_column(bytes, column);
    CHECK(get_text(bytes, 100) == "short");
    CHECK(get_text(bytes, long_text.size()) == long_text);
    std::vector<double> read(7, 9.0);
    get_column(bytes, read);
    CHECK(read == column);
}

// No machine has so much memory: it was asked for all at once before.
TEST_CASE("what is claimed and not there takes no memory", "[base]") {
    constexpr std::uint64_t claimed = std::uint64_t{1} << 50;
    std::stringstream text, column;
    put(text, claimed);
    put(column, claimed);
    text << "a few bytes";
    column << "a few bytes";
    CHECK_THROWS_AS(get_text(text, claimed), RunError);
    std::vector<double> values;
    CHECK_THROWS_AS(get_column(column, values), RunError);
}
