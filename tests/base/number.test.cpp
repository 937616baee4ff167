#include "base/number.h"

#include "catch.h"

#include <cstring>
#include <random>
#include <string>

using namespace espalier;

namespace {

/// What both readers make of a text is the same: the place behind it, the error and every bit of the value.
void check_same(const std::string& text) {
    INFO("'" << text << "'");
    double expected = 7, read = 7;
    const char* const end = text.data() + text.size();
    const auto of_library = std::from_chars(text.data(), end, expected);
    const auto ours = read_real(text.data(), end, read);
    CHECK(ours.ptr == of_library.ptr);
    CHECK(ours.ec == of_library.ec);
    CHECK(std::memcmp(&read, &expected, sizeof read) == 0);
}

}  // namespace

TEST_CASE("Real numbers are read the same where the library reads whole numbers alone", "[base]") {
    for (const char* text : {"",        "-",        ".",    "-.",    "1",     "-0",     ".5",     "5.",  "5.e",
                             "1e",      "1e+",      "1e5x", "1E-7",  "0x10",  "+1",     " 1",     "inf", "-INF",
                             "infinit", "infinity", "nan",  "1.5.5", "1e999", "-1e999", "1e-999", "--1", "1,5"}) {
        check_same(text);
    }
    std::mt19937 random(20261124);
    const std::string letters = "0123456789.e-+";
    for (int i = 0; i < 20000; ++i) {
        std::string text(random() % 12, ' ');
        for (char& c : text) c = letters[random() % letters.size()];
        check_same(text);
    }
    for (int i = 0; i < 20000; ++i) {
        std::string text = std::to_string(random()) + "." + std::to_string(random());
        check_same(text + "e" + std::to_string(static_cast<int>(random() % 500) - 250));
    }
}
