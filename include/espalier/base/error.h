// Errors: mistakes of the user, failures of a run, and where they happened.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace espalier {

/// A place in a file as its author sees it; line and column count from 1, 0 = unknown.
struct Place {
    std::string file;
    int line = 0;
    int column = 0;

    bool known() const { return !file.empty(); }
};

/// "file:12:9", leaving out what is not known.
std::string to_string(const Place& place);

/// One message about one place. `source` is the line of text it speaks of, shown with a caret; may be empty.
struct Diagnostic {
    enum class Severity { error, warning };
    Severity severity = Severity::error;
    Place place;
    std::string message;
    std::string source = {};
    /// Of a warning: something that was written has not the effect it reads like, so --quiet does not silence it.
    bool insistent = false;
};

/// The message as the user reads it: place, message, source line and caret.
std::string to_string(const Diagnostic& diagnostic);

/// A mistake in what the user wrote (model, scene, mesh, command line): exit code 1.
class UserError : public std::runtime_error {
public:
    explicit UserError(const std::string& message);
    UserError(const Place& place, const std::string& message, const std::string& source = {});
    explicit UserError(std::vector<Diagnostic> diagnostics);

    const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

private:
    std::vector<Diagnostic> diagnostics_;
};

/// A run that could not go on (memory, disk, NaN, a process that failed): exit code 2.
class RunError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace espalier
