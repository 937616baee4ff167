// What a shared page tells of organs that are clicked at, without a server.
#pragma once

#include "studio/growth/recorded_frame.h"

#include <nlohmann/json.hpp>

#include <map>

namespace espalier::studio {

/// Gathers the organs of a run's frames, each once, and what every frame says of them.
class SharedOrgans {
public:
    explicit SharedOrgans(const RecordedRun& run) : run_(run) {}

    /// What a frame says: `organ`, for each module of its packet the number of its organ less that of the module
    /// before; `parameters`, by their names, a number or null for each module; `units` of those that have one.
    nlohmann::ordered_json add(const DrawnFrame& frame);
    /// All organs that were added, as columns: `identity` (16 hexadecimal digits), `symbol`, `plant`, `born`, `order`,
    /// and `parent` (the number of an organ, or -1). `symbols` and `plants` are the names that two of them count.
    nlohmann::ordered_json table() const;

private:
    std::int64_t number_of(const DrawnFrame& frame, const RecordedModule& module);

    const RecordedRun& run_;
    std::vector<RecordedModule> organs_;  ///< their symbols count `symbols_`
    std::map<OrganKey, std::int64_t> numbers_;
    std::vector<std::string> symbols_;
};

}  // namespace espalier::studio
