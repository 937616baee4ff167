// Numbers for the symbols of all models of a run.
#pragma once

#include "espalier/lsystem/lsystem.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace espalier::timeline {

/// Numbers for the symbols of all models, the same from frame to frame, and their names for the files.
class SymbolNumbers {
public:
    /// A number for each letter of the model. New models add their symbols behind the old ones.
    const std::vector<std::uint16_t>& of(const Model& model);
    const std::vector<std::string>& names() const { return names_; }

private:
    std::map<const Model*, std::vector<std::uint16_t>> numbers_;
    std::map<std::string, std::uint16_t> number_of_;
    std::vector<std::string> names_;
};

}  // namespace espalier::timeline
