// Any bytes as a model: reading, reviewing, compiling, a few steps and their pictures must end in a result or in words.
#include "espalier/language/reader.h"
#include "espalier/lsystem/derivation.h"
#include "espalier/turtle/interpretation.h"
#include "espalier/turtle/symbol.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace {

using namespace espalier;

constexpr std::size_t longest = 1 << 14;
constexpr std::size_t memory = 1 << 18;
constexpr int steps = 3;

const std::vector<std::string>& turtle_symbols() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const auto& [name, symbol] : symbols()) all.push_back(name);
        return all;
    }();
    return names;
}

void grow(const std::shared_ptr<const Model>& model) {
    DerivationSettings settings;
    settings.memory = memory;
    settings.input_folder = "/nonexistent";
    settings.print = [](const std::string&) {};
    Derivation derivation(compile(model), settings);
    ModuleString string, next;
    derivation.start(string);
    for (int step = 0; step < steps && !derivation.stopped(); ++step) {
        derivation.step(string, next);
        std::swap(string, next);
    }
    interpret(*model, string, {}, &derivation);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    // Nothing is read from this machine's disk.
    if (size > longest || text.find("include") != std::string_view::npos) return 0;
    ReadOptions options;
    options.quirks = size % 2 == 1;
    options.predefined = {{"WIDTH", "1"}};
    try {
        const std::shared_ptr<const Model> model = read_model_text(text, "model.l", "/nonexistent", options);
        review(*model, turtle_symbols());
        grow(model);
    } catch (const UserError&) {
    } catch (const RunError&) {
    }
    return 0;
}
