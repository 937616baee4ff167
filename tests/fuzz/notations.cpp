// Any bytes as a file of every notation: its model must be readable and bear a few steps, or the mistakes must be named
// in lines of the file itself.
#include "espalier/language/notation.h"
#include "espalier/language/reader.h"
#include "espalier/lsystem/derivation.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

namespace {

using namespace espalier;

constexpr std::size_t longest = 1 << 14;
constexpr std::size_t memory = 1 << 18;
constexpr int steps = 3;

std::optional<std::string> translation(const NotationType& notation, const std::string& text) {
    try {
        return language::translated(notation, text, "plant" + notation.extension).text;
    } catch (const UserError& error) {
        for (const Diagnostic& mistake : error.diagnostics()) {
            const bool is_bytes = mistake.message.find("is a binary file") != std::string::npos;
            if (!is_bytes && (mistake.place.line < 1 || mistake.place.column < 1)) std::abort();
        }
        return std::nullopt;
    }
}

void grow(const std::shared_ptr<const CompiledModel>& model) {
    DerivationSettings settings;
    settings.memory = memory;
    settings.printout = std::make_shared<Printout>([](const std::string&) {});
    Derivation derivation(model, settings);
    ModuleString string, next;
    derivation.start(string);
    for (int step = 0; step < steps && !derivation.stopped(); ++step) {
        derivation.step(string, next);
        std::swap(string, next);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > longest) return 0;
    const std::string text(reinterpret_cast<const char*>(data), size);
    for (const auto& [name, notation] : registered<NotationType>()) {
        const std::optional<std::string> model = translation(*notation, text);
        if (!model) continue;
        // Outside the try block: what a notation accepts must be a model that can be run.
        const auto compiled = compile(read_model_text(*model, name, "/nonexistent"));
        try {
            grow(compiled);
        } catch (const UserError&) {
        } catch (const RunError&) {
        }
    }
    return 0;
}
