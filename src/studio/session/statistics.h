// The table of a growth's statistics, as the charts of pages draw it.
#pragma once

#include "studio/session/message.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace espalier::studio {

class Statistics {
public:
    /// Rows of statistics.csv; the first is the header. `units`: of columns that processes add.
    void add(const std::string& rows, const std::map<std::string, std::string>& units = {});
    void clear();
    /// The rows from `first` on.
    Json message(std::uint32_t growth, std::size_t first = 0) const;
    bool has_untold() const { return untold_ < rows_.size(); }
    /// The rows that pages have not been told, which they then have.
    Json take_untold(std::uint32_t growth);

private:
    std::vector<std::string> columns_;
    std::map<std::string, std::string> units_{
        {"length", "m"}, {"height", "m"}, {"volume", "m3"}};  ///< of those that have one
    std::vector<std::vector<std::string>> rows_;
    std::size_t untold_ = 0;  ///< the first row that pages have not been told
};

}  // namespace espalier::studio
