// Every model of the library grows as it does when its modules are replaced one after the other.
#include "espalier/language/reader.h"
#include "espalier/lsystem/derivation.h"

#include "catch.h"
#include "lsystem/model_builder.h"

#include <filesystem>
#include <string>

using namespace espalier;

namespace {

constexpr int most_steps = 12;
constexpr std::size_t longest = 100'000;

std::vector<std::filesystem::path> every_model() {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(ESPALIER_SOURCE_DIR "/models")) {
        if (entry.path().extension() == ".l") paths.push_back(entry.path());
    }
    return paths;
}

Derivation derivation_of(const std::shared_ptr<const CompiledModel>& model, bool one_by_one) {
    DerivationSettings settings;
    settings.lineage = true;
    settings.one_by_one = one_by_one;
    settings.printout = std::make_shared<Printout>([](const std::string&) {});
    settings.input_folder = source_of(*model).path.parent_path();
    return Derivation(model, std::move(settings));
}

}  // namespace

TEST_CASE("every model of the library grows as it does one module after the other", "[library]") {
    std::size_t compared = 0;
    for (const std::filesystem::path& path : every_model()) {
        INFO(path);
        const auto compiled = compile(read_model(path));
        Derivation derivation = derivation_of(compiled, false), reference = derivation_of(compiled, true);
        ModuleString string, next, expected;
        derivation.start(string);
        reference.start(expected);
        const int steps = std::min(most_steps, derivation.length());
        for (int step = 1; step <= steps && string.size() < longest && !derivation.stopped(); ++step) {
            INFO("step " << step);
            reference.step(string, expected);
            derivation.step(string, next);
            REQUIRE(test::same(next, expected));
            std::swap(string, next);
            ++compared;
        }
    }
    CHECK(compared > 500);
}
