// `espalier studio` as a program: its address, its end, its mistakes.
#include "catch.h"
#include "program.h"

using Catch::Matchers::Contains;

TEST_CASE("studio prints an address with a token, and ends when it is asked to", "[app]") {
    for (const int signal : {SIGINT, SIGTERM}) {
        const Workplace place;
        place.write("stalk.l", "lsystem: 1\nderivation length: 3\naxiom: A\nA --> F(1)A\nendlsystem\n");
        const auto printed = [&] { return text_of(place.path() / ".out").find("/#token=") != std::string::npos; };
        const Outcome outcome =
            place.run_until({"studio", "--no-browser", "stalk.l"}, printed, [&](pid_t child) { kill(child, signal); });
        CHECK(outcome.code == 0);
        CHECK_THAT(outcome.out, Contains("http://127.0.0.1:"));
    }
}

TEST_CASE("studio says what it cannot open", "[app]") {
    const Workplace place;
    CHECK_THAT(place.run("studio --no-browser nothing.l").err, Contains("nothing.l does not exist"));
    CHECK_THAT(place.run("studio --no-browser --folder nowhere").err, Contains("nowhere does not exist"));
    CHECK(place.run("studio --no-browser --port 99999").code == 1);
}
