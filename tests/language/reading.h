// What the tests of the language share: a model from a few lines, and its mistakes.
#pragma once

#include "espalier/language/reader.h"

#include <string>

namespace espalier::test {

using namespace espalier::language;

/// An L-system around header items, an axiom and productions.
inline std::string lsystem_of(const std::string& header, const std::string& axiom, const std::string& rules) {
    return "lsystem: 1\n" + header + "axiom: " + axiom + "\n" + rules + "endlsystem\n";
}

inline std::shared_ptr<const Model> read(const std::string& text, const ReadOptions& options = {}) {
    return read_model_text(text, "model.l", {}, options);
}

inline std::vector<Diagnostic> mistakes(const std::string& text, const ReadOptions& options = {}) {
    try {
        read(text, options);
    } catch (const UserError& error) {
        return error.diagnostics();
    }
    return {};
}

/// What the reader warns of while it reads.
inline std::vector<Diagnostic> reading_warnings(const std::string& text) {
    std::vector<Diagnostic> found;
    ReadOptions options;
    options.warnings = &found;
    read(text, options);
    return found;
}

/// The messages of the mistakes, one a line, without source lines: "3:5: expected ..."
inline std::string messages(const std::string& text, const ReadOptions& options = {}) {
    std::string result;
    for (const Diagnostic& mistake : mistakes(text, options)) {
        if (!result.empty()) result += "\n";
        result +=
            std::to_string(mistake.place.line) + ":" + std::to_string(mistake.place.column) + ": " + mistake.message;
    }
    return result;
}

/// The modules as a reader would write them: names, with the number of parameters in brackets where there are any.
inline std::string modules(const Model& model, const std::vector<ModuleTemplate>& templates) {
    std::string result;
    for (const ModuleTemplate& module : templates) {
        if (!result.empty()) result += ' ';
        result += model.alphabet.name(module.letter);
        if (!module.arguments.empty()) result.append("/").append(std::to_string(module.arguments.size()));
    }
    return result;
}

}  // namespace espalier::test
