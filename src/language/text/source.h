// Text that remembers where each of its characters was written, and the mistakes found in it.
#pragma once

#include "espalier/base/error.h"
#include "espalier/language/notation.h"

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language {

/// A place in one of the files of a model; small, unlike Place. Columns count code points.
struct Location {
    std::uint32_t file = 0;
    int line = 0;
    int column = 0;

    auto operator<=>(const Location&) const = default;
};

/// The files a model was read from, by number.
class Sources {
public:
    std::uint32_t add(std::string name, std::string text);
    /// One that was translated: what has an origin is placed there, and the rest in the translation.
    std::uint32_t add(std::string name, TranslatedText text);
    const std::string& name(std::uint32_t file) const { return files_[file].name; }
    const std::string& text(std::uint32_t file) const { return files_[file].text; }
    Place place(Location location) const;
    /// The line of text a location stands in.
    std::string line(Location location) const;
    /// The line at its place, which of a translated file is one of the notation.
    std::string line_at_place(Location location) const;

private:
    struct File {
        std::string name;
        std::string text;
        std::vector<std::size_t> line_starts;
        std::vector<TranslatedText::Origin> origins;
    };
    /// Where the author of a translated file wrote it; not known for all others.
    Place origin(Location location) const;

    std::vector<File> files_;
};

/// Text with the location of every character, kept as runs.
class MappedText {
public:
    const std::string& text() const { return text_; }
    std::size_t size() const { return text_.size(); }
    void append(char character, Location at);
    /// Appends text that a macro stands for: all of it is at one location.
    void append_at(std::string_view text, Location at);
    /// Appends a part of another text, keeping its locations.
    void append(const MappedText& other, std::size_t from, std::size_t to);
    /// Returns the location of the character at `offset`; the end of the text has a location too.
    Location location(std::size_t offset) const;

private:
    struct Run {
        std::size_t start;
        Location at;
        bool fixed;  // every character of the run is at `at`
    };
    std::size_t run_of(std::size_t offset) const;

    std::string text_;
    std::vector<Run> runs_;
};

/// A mistake that ends the statement at hand; caught where reading can go on.
struct SyntaxError {
    Location at;
    std::string message;
};

/// Thrown when so many mistakes were found that more would not help.
struct TooManyMistakes {};

/// Collects what is wrong, sorted by place in the end.
class Mistakes {
public:
    explicit Mistakes(const Sources& sources) : sources_(sources) {}

    /// Throws TooManyMistakes with the last one that is kept.
    void error(Location at, std::string message);
    void error(const SyntaxError& mistake) { error(mistake.at, mistake.message); }
    void warning(Location at, std::string message);
    /// A warning that --quiet does not silence.
    void insist(Location at, std::string message);

    bool none() const { return errors_.empty(); }
    std::vector<Diagnostic> errors() const { return sorted(errors_, Diagnostic::Severity::error); }
    std::vector<Diagnostic> warnings() const { return sorted(warnings_, Diagnostic::Severity::warning); }

private:
    struct Mistake : SyntaxError {
        bool insistent = false;
    };
    static constexpr std::size_t most_errors = 20;

    std::vector<Diagnostic> sorted(std::vector<Mistake> found, Diagnostic::Severity severity) const;

    const Sources& sources_;
    std::vector<Mistake> errors_;
    std::vector<Mistake> warnings_;
};

}  // namespace espalier::language
