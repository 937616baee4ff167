// Any bytes as a model: reading, reviewing, compiling, a few steps and their pictures must end in a result or in words.
#include "espalier/language/reader.h"
#include "espalier/lsystem/derivation.h"
#include "espalier/turtle/interpretation.h"
#include "espalier/turtle/symbol.h"
#include "espalier/turtle/view_file.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace {

using namespace espalier;

constexpr std::size_t longest = 1 << 14;
constexpr std::size_t memory = 1 << 18;
constexpr int steps = 3;

// Surfaces, contours, a function and tropisms for models to use.
const View& view() {
    static const View known = [] {
        View made = read_view_text(
            "angle increment: 30\ninitial line width: 2 cylinder\nsurface: a leaf.s 1\n"
            "contour: 1 fluted.con\ntropism: T: 0 1 0 A: 30 I: 0.5 E: 0.2\n"
            "torque: T: 0 0 1 E: 0.1\ntropism direction: 0,1,0\ninitial elasticity: 0.1\n",
            "plant.v", {}, ESPALIER_SOURCE_DIR "/models/organs");
        auto resources = std::make_shared<Resources>(*made.resources);
        resources->functions.emplace_back(std::vector<glm::dvec2>{{0, 0}, {0, 1}, {1, 1}, {1, 2}}, 0);
        resources->curves.emplace_back(std::vector<glm::dvec3>{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 2, 3}},
                                       SpaceCurve::Type::b_spline);
        made.resources = resources;
        return made;
    }();
    return known;
}

bool same(const ModuleString& a, const ModuleString& b) {
    if (a.letters != b.letters || a.parameters != b.parameters || a.births.size() != b.births.size()) return false;
    for (std::size_t i = 0; i < a.births.size(); ++i) {
        if (a.identity(i) != b.identity(i) || a.parent(i) != b.parent(i)) return false;
    }
    return true;
}

/// Every step is done twice, the second time one module after the other, with what came before it.
void grow(const std::shared_ptr<const Model>& model) {
    DerivationSettings settings;
    settings.lineage = true;
    settings.memory = memory;
    settings.input_folder = "/nonexistent";
    settings.printout = std::make_shared<Printout>([](const std::string&) {});
    const auto compiled = compile(model);
    Derivation derivation(compiled, settings);
    settings.one_by_one = true;
    settings.memory = 16 * memory;  // what grows one module after the other has more room than it needs
    Derivation reference(compiled, settings);
    ModuleString string, next, expected;
    derivation.start(string);
    reference.start(expected);
    for (int step = 0; step < steps && !derivation.stopped(); ++step) {
        derivation.step(string, next);
        reference.step(string, expected);
        if (!same(next, expected)) __builtin_trap();
        std::swap(string, next);
    }
    interpret(*model, string, view().turtle, &derivation);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    // Nothing is read from this machine's disk.
    if (size > longest || text.find("include") != std::string_view::npos) return 0;
    ReadOptions options;
    if (size % 2 == 1) options.arithmetic = Arithmetic::cpfg;
    options.resources = view().resources;
    options.predefined = {{"WIDTH", "1"}};
    try {
        const std::shared_ptr<const Model> model = read_model_text(text, "model.l", "/nonexistent", options);
        static const ReviewOptions options_of_review{symbol_arities()};
        review(*model, options_of_review);
        grow(model);
    } catch (const UserError&) {
    } catch (const RunError&) {
    }
    return 0;
}
