// What a review has found, each at its place.
#pragma once

#include "espalier/base/error.h"

#include <map>
#include <string>
#include <vector>

namespace espalier::language {

class Findings {
public:
    void warn(const Place& place, std::string message);
    /// In the order of their places.
    std::vector<Diagnostic> in_order();

private:
    std::string source_line(const Place& place);

    std::map<std::string, std::vector<std::string>> files_;
    std::vector<Diagnostic> found_;
};

}  // namespace espalier::language
