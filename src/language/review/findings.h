// What a review has found, each at its place.
#pragma once

#include "espalier/base/error.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace espalier::language {

class Findings {
public:
    void warn(const Place& place, std::string message) { add(place, std::move(message), false); }
    /// Of what has not the effect it reads like: --quiet does not silence it.
    void insist(const Place& place, std::string message) { add(place, std::move(message), true); }
    /// In the order of their places.
    std::vector<Diagnostic> in_order();

private:
    void add(const Place& place, std::string message, bool insistent);
    std::string source_line(const Place& place);

    std::map<std::string, std::vector<std::string>> files_;
    std::vector<Diagnostic> found_;
};

}  // namespace espalier::language
