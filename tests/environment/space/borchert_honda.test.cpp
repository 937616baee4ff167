#include "espalier/language/reader.h"
#include "espalier/lsystem/derivation.h"

#include "catch.h"
#include "environment/exchange/exchange_plants.h"

#include <fmt/format.h>

#include <numeric>

using namespace espalier;

namespace {

/// A parameter of all ?bh in string order, after one exchange of the axiom.
std::vector<double> answers(const std::string& axiom, double lambda, std::size_t parameter = 1) {
    const auto model = read_model_text(
        "environment bh;\nlsystem: 1\nderivation length: 1\naxiom: " + axiom + "\nendlsystem\n", "plant.l");
    ModuleString string;
    Derivation(compile(model), {}).start(string);
    const Interpretation interpretation = interpret(*model, string);
    Environment environment =
        environment_of(fmt::format("[bh]\nprocess = 'borchert-honda'\nalpha = 2\nlambda = {}\n", lambda));
    const PlantView plant{0, model.get(), &string, &interpretation};
    ModuleString* strings[] = {&string};
    environment.exchange({0, 0, 1, {&plant, 1}}, strings);
    const auto offsets = parameter_offsets(string, model->alphabet);
    std::vector<double> values;
    for (std::size_t i = 0; i < string.size(); ++i) {
        if (model->alphabet.name(string.letters[i]) != "?bh") continue;
        values.push_back(string.parameters[offsets[i] + parameter]);
    }
    return values;
}

const char* const two_buds = "F[+F?bh(3,0)]F?bh(1,0)";

}  // namespace

TEST_CASE("resource is shared at a fork by lambda Qm / (lambda Qm + (1 - lambda) Ql)", "[borchert-honda]") {
    const double lambda = 0.54;
    const double main = 8 * lambda * 1 / (lambda * 1 + (1 - lambda) * 3);
    const std::vector<double> v = answers(two_buds, lambda);
    REQUIRE(v.size() == 2);
    CHECK(v[0] == Approx(8 - main));
    CHECK(v[1] == Approx(main));
}

TEST_CASE("resource is conserved: the buds of a plant get alpha times what they have gathered", "[borchert-honda]") {
    for (const double lambda : {0.0, 0.3, 0.5, 0.7, 1.0}) {
        const auto v =
            answers("F[+F[-F?bh(1,0)]F?bh(0.5,0)][-?bh(0,0)]F?bh(2,0)[F?bh(0.25,0)]F[+?bh(1,0)]?bh(0,0)", lambda);
        REQUIRE(v.size() == 7);
        CHECK(std::accumulate(v.begin(), v.end(), 0.0) == Approx(2 * 4.75));
        if (lambda > 0 && lambda < 1) CHECK(v[2] == 0);
    }
}

TEST_CASE("the larger lambda, the more the main axis gets", "[borchert-honda]") {
    double before = -1;
    for (const double lambda : {0.1, 0.4, 0.46, 0.5, 0.54, 0.9}) {
        const double main = answers(two_buds, lambda)[1];
        CHECK(main > before);
        before = main;
    }
    CHECK(answers(two_buds, 0.5)[1] == Approx(2));
}

TEST_CASE("a gauge tells what its branch has gathered, and its internodes", "[borchert-honda]") {
    const char* const tree = "?bh(-1,0,0)F[+?bh(-1,0,0)FF[F?bh(1,0,0)]?bh(2,0,0)]F[-?bh(-1,0,0)?bh(4,0,0)]";
    CHECK(answers(tree, 0.5, 1)[0] == 7);
    CHECK(answers(tree, 0.5, 1)[1] == 3);
    CHECK(answers(tree, 0.5, 1)[4] == 4);
    CHECK(answers(tree, 0.5, 2)[0] == 5);
    CHECK(answers(tree, 0.5, 2)[1] == 3);
    CHECK(answers(tree, 0.5, 2)[4] == 0);
}
