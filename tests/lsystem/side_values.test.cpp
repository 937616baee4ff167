#include "catch.h"
#include "lsystem/model_builder.h"

#include <cmath>

using namespace espalier;
using namespace espalier::lsystem;
using namespace espalier::test;

namespace {

Expression extent(std::uint32_t which) {
    Expression expression = call(Function::view_extent, {});
    expression.index = which;
    return expression;
}

/// y = x on [0, 1].
FunctionCurve diagonal() {
    return {{{0, 0}, {1.0 / 3, 1.0 / 3}, {2.0 / 3, 2.0 / 3}, {1, 1}}, 1};
}

std::shared_ptr<Resources> some_resources() {
    auto resources = std::make_shared<Resources>();
    resources->functions.push_back(diagonal());
    resources->curves.emplace_back(std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 2}, {2, 0, 4}, {3, 0, 6}},
                                   SpaceCurve::Type::bezier);
    resources->z_min = -7;
    resources->view_scale = 0.5;
    return resources;
}

struct Answer {
    double value = 0;
    std::string said;
};

/// The value of an expression in the axiom, evaluated in so many modules.
Answer answer(const Expression& expression, std::shared_ptr<const Resources> resources, int modules = 1) {
    ModelBuilder model;
    model.model().resources = std::move(resources);
    for (int k = 0; k < modules; ++k) model.system().axiom.push_back(model.module("A", {}));
    model.rule({{"A", 0}}, {model.module("B", {expression})});
    Answer found;
    DerivationSettings settings;
    settings.printout = std::make_shared<Printout>([&](const std::string& text) { found.said += text; });
    Derivation derivation(model.compiled(), settings);
    found.value = grow(derivation, 1).parameters[0];
    return found;
}

}  // namespace

// "func(id,x), curveX/Y/Z(id,t), curveGAL(id), vvXmin...vvZmax(dummy) and vvScale (current view extents)"
TEST_CASE("functions, curves and the view's extents are those of the side files", "[lsystem]") {
    const auto resources = some_resources();
    CHECK(answer(call(Function::func, {number(1), number(0.25)}), resources).value == Approx(0.25).epsilon(1e-6));
    CHECK(answer(call(Function::func, {number(1.9), number(7)}), resources).value ==
          Approx(1).margin(2e-3));  // id is truncated
    CHECK(answer(call(Function::curve_x, {number(1), number(0.5)}), resources).value == Approx(1.5).epsilon(1e-3));
    CHECK(answer(call(Function::curve_y, {number(1), number(0.5)}), resources).value == 0);
    CHECK(answer(call(Function::curve_z, {number(1), number(1)}), resources).value == Approx(6));
    CHECK(answer(call(Function::curve_gal, {number(1)}), resources).value == Approx(std::sqrt(45)).epsilon(1e-6));
    CHECK(answer(extent(4), resources).value == -7);
    CHECK(answer(extent(5), resources).value == 100000);
    CHECK(answer(extent(6), resources).value == 0.5);
    CHECK(answer(extent(0), resources).value == 0);
    CHECK(answer(call(Function::func, {number(1), number(1)}), resources).said.empty());
}

// "A wrong id: error message, value 0."
TEST_CASE("a wrong id has the value 0 and is said once", "[lsystem]") {
    for (const double id : {0.0, 2.0, -1.0, 1e300, std::nan("")}) {
        const Answer found = answer(call(Function::func, {number(id), number(1)}), some_resources(), 3);
        CHECK(found.value == 0);
        CHECK(found.said.starts_with("model.l:8:5: warning: func: there is no function"));
        CHECK(std::count(found.said.begin(), found.said.end(), '\n') == 1);
    }
    const Answer found = answer(call(Function::curve_gal, {number(1)}), nullptr);
    CHECK(found.value == 0);
    CHECK(found.said.find("--view") != std::string::npos);
    CHECK(answer(extent(5), nullptr).value == 100000);
    CHECK(answer(extent(5), nullptr).said.find("--view") != std::string::npos);
}

// "Display(x)" has no effect without a window.
TEST_CASE("Display is accepted and 0", "[lsystem]") {
    CHECK(answer(call(Function::display, {number(3)}), nullptr).value == 0);
}

TEST_CASE("a text among the parameters of a module is its number", "[lsystem]") {
    ModelBuilder model;
    model.model().texts = {"other", "%.2f"};
    Expression label = text("%.2f");
    label.index = 1;
    model.system().axiom = {model.module("A", {number(3)}), model.module("L", {label, number(7)})};
    model.rule({{"A", 1}}, {model.module("@", {}), model.module("L", {label, formal(0) * number(0.5)})});
    CHECK(text_after(model, 1) == "@L(1,1.5)L(1,7)");
}
