// The declared requests and messages, and the three files that are made from them. `./dev protocol` writes these anew.
#include "espalier/base/file.h"

#include "catch.h"
#include "protocol_texts.h"

#include <cstdlib>
#include <filesystem>

using namespace studio_test;

namespace {

namespace fs = std::filesystem;

const fs::path root = ESPALIER_SOURCE_DIR;
const std::string begin_mark = "made by `./dev protocol`", end_mark = "end of what is made";

/// The file with `made` between the lines that hold the marks; the whole file if it has none.
std::string with_made(const std::string& file, const std::string& made) {
    const std::size_t mark = file.find(begin_mark);
    if (mark == std::string::npos) return made;
    const std::size_t begin = file.find('\n', mark) + 1;
    const std::size_t end = file.rfind('\n', file.find(end_mark, begin)) + 1;
    return file.substr(0, begin) + made + file.substr(end);
}

void check_made(const char* name, const std::string& made) {
    const fs::path path = root / name;
    const std::string file = espalier::read_text(path), wanted = with_made(file, made);
    if (std::getenv("ESPALIER_WRITE_PROTOCOL")) {
        espalier::write_text(path, wanted);
        return;
    }
    INFO(name << " is not what src/studio declares: run ./dev protocol");
    CHECK(file == wanted);
}

struct Leaf {
    static constexpr TypeName type{"Leaf", "a leaf"};
    double area = 0;
    Nullable<int> order;
    std::optional<std::string> shape;
    std::vector<std::map<std::string, Nullable<double>>> rows;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("area", self.area, "of its upper side", at_least(0));
        field("order", self.order, "of branching", between(0, 9));
        field("shape", self.shape, "of its outline", one_of("round lobed"));
        field("rows", self.rows, "numbers");
    }
};

std::string refusal(const char* json) {
    try {
        from_json<Leaf>(Json::parse(json));
    } catch (const espalier::UserError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("the page's types, the manual's tables and the fuzzer's words are what the program declares", "[protocol]") {
    const Protocol protocol = whole_protocol();
    CHECK(protocol.requests.size() > 20);
    CHECK(protocol.messages.size() > 8);
    check_made("studio/source/protocol.ts", typescript(protocol));
    check_made("docs/developer/studio-protocol.md", manual(protocol));
    check_made("tests/fuzz/requests.dict", dictionary(protocol));
}

TEST_CASE("a declared struct comes back from its JSON", "[protocol]") {
    Leaf leaf{0.5, {}, "round", {{{"a", 1.5}, {"b", {}}}}};
    const Json json = json_of(leaf);
    CHECK(json == Json::parse(R"({"area":0.5,"order":null,"shape":"round","rows":[{"a":1.5,"b":null}]})"));
    const Leaf read = from_json<Leaf>(json);
    CHECK(json_of(read) == json);
    leaf.shape.reset();
    CHECK_FALSE(json_of(leaf).contains("shape"));
}

TEST_CASE("what was not declared is refused by name", "[protocol]") {
    CHECK(refusal(R"({"order":1,"rows":[]})") == "'area' is missing");
    CHECK(refusal(R"({"area":"1","order":1,"rows":[]})") == "'area' is no number");
    CHECK(refusal(R"({"area":-1,"order":1,"rows":[]})") == "'area' is -1, but must be at least 0");
    CHECK(refusal(R"({"area":1,"order":10,"rows":[]})") == "'order' is no whole number from 0 to 9");
    CHECK(refusal(R"({"area":1,"order":1.5,"rows":[]})") == "'order' is no whole number from 0 to 9");
    CHECK(refusal(R"({"area":1,"order":1,"shape":"square","rows":[]})") ==
          "'shape' is 'square', but must be one of: round, lobed");
    CHECK(refusal(R"({"area":1,"order":1,"rows":{}})") == "'rows' is no list");
    CHECK(refusal(R"({"area":1,"order":null,"rows":[{"a":null}]})").empty());
    CHECK_THROWS_AS(json_of(Leaf{1, {}, "square", {}}), std::logic_error);
}

TEST_CASE("types are written as the page reads them", "[protocol]") {
    TypeDescriptions all;
    CHECK(describe<Leaf>(all) == "Leaf");
    REQUIRE(all.size() == 1);
    CHECK(all[0].fields[1].type == "number | null");
    CHECK(all[0].fields[2].type == "\"round\" | \"lobed\"");
    CHECK(all[0].fields[2].is_optional);
    CHECK(all[0].fields[3].type == "Record<string, number | null>[]");
}
