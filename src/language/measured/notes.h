// What a reader of measured plants did not use, and what it guessed: each named once, with the number of places.
#pragma once

#include "espalier/base/error.h"

#include <map>
#include <string>
#include <vector>

namespace espalier::language::measured {

class Notes {
public:
    explicit Notes(std::string file) : file_(std::move(file)) {}

    /// Something that the file holds and nothing reads: "element <annotation>", "column 'Azimuth'"; in so many places,
    /// of which this is the first.
    void unused(const std::string& what, const Place& place = {}, std::size_t places = 1);
    /// A guess, or a loss, in a sentence; the same sentence is said once.
    void warn(const std::string& sentence, const Place& place = {}, std::size_t places = 1);

    /// In the order of the first places of each; of those that are unused a hundred at most, and how many more.
    std::vector<Diagnostic> warnings() const;

private:
    struct Kind {
        std::string text;
        Place first;
        std::size_t places;
        bool is_unused;
    };
    void note(const std::string& text, const Place& place, bool is_unused, std::size_t places);

    std::string file_;
    std::vector<Kind> kinds_;
    std::map<std::string, std::size_t> number_of_;
    std::size_t unused_kinds_ = 0, further_ = 0;
};

}  // namespace espalier::language::measured
