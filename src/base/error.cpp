#include "espalier/base/error.h"

#include "base/excerpt.h"

#include <fmt/format.h>

namespace espalier {
namespace {

std::string joined(const std::vector<Diagnostic>& diagnostics) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics) {
        if (!text.empty()) text += '\n';
        text += to_string(diagnostic);
    }
    return text;
}

}  // namespace

std::string to_string(const Place& place) {
    if (!place.known()) return "";
    if (place.line <= 0) return place.file;
    if (place.column <= 0) return fmt::format("{}:{}", place.file, place.line);
    return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

std::string to_string(const Diagnostic& diagnostic) {
    std::string text;
    if (diagnostic.place.known()) text += to_string(diagnostic.place) + ": ";
    if (diagnostic.severity == Diagnostic::Severity::warning) text += "warning: ";
    text += printable(diagnostic.message);
    if (!diagnostic.source.empty()) text += excerpt(diagnostic.source, diagnostic.place.column);
    return text;
}

UserError::UserError(const std::string& message) : UserError(Place{}, message) {}

UserError::UserError(const Place& place, const std::string& message, const std::string& source)
    : UserError(std::vector<Diagnostic>{
          {Diagnostic::Severity::error, place, message, source.empty() ? source_line(place) : source}}) {}

UserError::UserError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(joined(diagnostics)), diagnostics_(std::move(diagnostics)) {}

}  // namespace espalier
