// What models print.
#pragma once

#include "espalier/base/stations.h"

#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

namespace espalier::lsystem {

/// Makes what models print fit for people: control characters other than newline and tab are shown as \x1b, and behind
/// `most` bytes one sentence says that the rest is left out. The models of a run share one; any thread may print.
class Printout {
public:
    using Show = std::function<void(const std::string&)>;

    static constexpr std::size_t most = std::size_t{1} << 20;

    /// Goes to standard error.
    Printout();
    explicit Printout(Show show) : show_(std::move(show)) {}

    /// What printf says.
    void print(const std::string& text);
    /// What the program says of the model: all of it.
    void say(const std::string& text);

private:
    const Show show_;
    std::mutex mutex_;
    std::size_t printed_ = 0;  ///< bytes
    bool is_full_ = false;
};

}  // namespace espalier::lsystem
