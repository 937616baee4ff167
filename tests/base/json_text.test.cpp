#include "base/json_text.h"

#include "catch.h"

#include <nlohmann/json.hpp>

using namespace espalier;
using Json = nlohmann::ordered_json;

TEST_CASE("JSON of others may be nested 64 deep, whatever its texts hold", "[base]") {
    const auto nested = [](int depth) {
        std::string text;
        for (int i = 0; i < depth; ++i) text += i % 2 == 0 ? "[" : R"({"[[{\"[": )";
        text += "1";
        for (int i = depth; i-- > 0;) text += i % 2 == 0 ? "]" : "}";
        return text;
    };
    CHECK(read_json<Json>(nested(64)).is_array());
    CHECK(read_json<Json>(nested(65)).is_discarded());
    CHECK(read_json<Json>("[[1], [2], {}]").size() == 3);
    CHECK(read_json<Json>("{").is_discarded());
}

TEST_CASE("half a character becomes the sign for a lost one, and whole ones stay", "[base]") {
    CHECK(with_whole_surrogates(R"({"a": "\ud83c\udf33 \ud83c x"})") == R"({"a": "\ud83c\udf33 \ufffd x"})");
    CHECK(with_whole_surrogates(R"("\udf33\ud83c")") == R"("\ufffd\ufffd")");
    CHECK(with_whole_surrogates(R"("\ud83c\ud83c\udf33")") == R"("\ufffd\ud83c\udf33")");
    CHECK(with_whole_surrogates(R"("\\ud83c")") == R"("\\ud83c")");  // a backslash, and four letters
    CHECK(with_whole_surrogates(R"("\uD83C)") == R"("\ufffd)");
    CHECK(with_whole_surrogates(R"("\u12)") == R"("\u12)");
    CHECK(with_whole_surrogates("\"\\") == "\"\\");
}
