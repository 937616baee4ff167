// A string without its nonterminals (Lintermann & Deussen 1997).
#include "turtle/terminals.h"

#include "espalier/language/reader.h"
#include "espalier/lsystem/derivation.h"
#include "espalier/turtle/interpretation.h"

#include "catch.h"

#include <string>

using namespace espalier;

namespace {

std::string terminals(const std::string& axiom, const std::string& homomorphism = "") {
    const std::string text = "lsystem: 1\nderivation length: 0\naxiom: " + axiom + "\n" + homomorphism + "endlsystem\n";
    const std::shared_ptr<const Model> model = read_model_text(text, "model.l");
    Derivation derivation(compile(model), {});
    ModuleString string;
    derivation.start(string);
    return to_text(turtle::terminals_of(*model, *symbol_table(*model), string), model->alphabet);
}

}  // namespace

TEST_CASE("what the turtle draws remains, and branches; apices and counters go", "[turtle]") {
    CHECK(terminals("F(1)A[-(30)XF(2)]B(3, 4)%F(5)") == "F(1)[-(30)F(2)]%F(5)");
    CHECK(terminals("AB(1)") == "");
}

TEST_CASE("symbols of several letters remain whole", "[turtle]") {
    CHECK(terminals("A~l(2)@Ts(1, 2)@oT(3)") == "~l(2)@Ts(1,2)@o");
    CHECK(terminals("~A") == "~A");
}

TEST_CASE("what a homomorphism pictures remains", "[turtle]") {
    CHECK(terminals("A(1)B(2)", "homomorphism\nA(x) --> F(x)\n") == "A(1)");
}
