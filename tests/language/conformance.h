// What the conformance tests share: sentences of docs/language.md, and strings that prove them.
#pragma once

#include "espalier/base/file.h"
#include "espalier/lsystem/derivation.h"

#include "catch.h"
#include "reading.h"

#include <filesystem>
#include <string>

namespace espalier::test {

using namespace espalier::language;

/// White space as one blank each.
inline std::string normalised(const std::string& text) {
    std::string result;
    for (const char c : text) {
        const bool blank = c == ' ' || c == '\n';
        if (!blank || (!result.empty() && result.back() != ' ')) result += blank ? ' ' : c;
    }
    return result;
}

/// Requires that the language's page says so, word by word.
inline void quote(const std::string& sentence) {
    static const std::string page =
        normalised(read_text(std::filesystem::path(ESPALIER_SOURCE_DIR) / "docs/language.md"));
    INFO("docs/language.md does not say: " << sentence);
    REQUIRE(page.find(normalised(sentence)) != std::string::npos);
}

/// The string of a model after its derivation length, in cpfg's notation.
inline std::string derived(const std::string& text, const ReadOptions& options = {}, DerivationSettings settings = {}) {
    const std::shared_ptr<const Model> model = read(text, options);
    if (!settings.printout) settings.printout = std::make_shared<Printout>([](const std::string&) {});
    Derivation derivation(compile(model), settings);
    ModuleString string, next;
    derivation.start(string);
    for (int step = 0; step < derivation.length() && !derivation.stopped(); ++step) {
        derivation.step(string, next);
        std::swap(string, next);
    }
    return to_text(string, model->alphabet);
}

/// One step from an axiom.
inline std::string step(const std::string& axiom, const std::string& productions, const std::string& header = "") {
    return derived(lsystem_of("derivation length: 1\n" + header, axiom, productions));
}

/// The first message of the mistakes of a model, or of running it.
inline std::string mistake(const std::string& text, const ReadOptions& options = {}) {
    try {
        derived(text, options);
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

}  // namespace espalier::test
