// Whether two scenes derive alike, so that the strings of one serve the other.
#pragma once

#include "espalier/base/read_log.h"
#include "espalier/simulation/world.h"

#include <climits>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace espalier::studio {

/// True if nothing that is drawn comes back to the strings: no plant asks anything, no process is there, and every
/// step of derivation can be taken up again. Such steps may be drawn in any order, or not at all.
bool draws_apart(const Scene& scene);

/// True if what geometry stages draw does not come back to the strings, though what turtles ask does: no process reads
/// what is drawn, and a string with its answers is drawn as it was without them. The steps of a growth that has ended
/// may then be drawn in any order, with other stages, without deriving and exchanging again.
bool stages_draw_apart(const World& world);

/// What strings were derived from.
struct Origin {
    Scene scene;  ///< as World decided it
    std::map<std::filesystem::path, ReadLog::File> files;
    int last_step = 0;       ///< as the scene says, before the user grew on
    bool exchanges = false;  ///< processes or turtles answered the strings: those of another growth must all be there
};

/// Other values of parameters that derivation writes as constants and never reads: angles, widths, colours.
class ParameterChanges {
public:
    explicit ParameterChanges(const Alphabet& alphabet)
        : arities_(alphabet.arities().begin(), alphabet.arities().end()) {}

    void add(LetterId letter, std::size_t parameter, double from, double to);
    bool empty() const { return changes_.empty(); }
    /// The letters of the parameters.
    std::vector<LetterId> letters() const;
    void apply(ModuleString& string) const;

private:
    /// By the bits of what is written, so that 0 and -0 differ.
    using Values = std::vector<std::pair<std::uint64_t, double>>;

    std::vector<std::uint16_t> arities_;
    std::map<std::pair<LetterId, std::size_t>, Values> changes_;
};

struct ReusePlan {
    int steps = INT_MAX;                                          ///< derived alike: from step 0 on
    std::vector<std::shared_ptr<const ParameterChanges>> plants;  ///< to be made in the strings; null: none

    bool changes_strings() const;
};

/// None if strings of `before` do not serve `now`. In both draw all, or the stages, apart.
std::optional<ReusePlan> reuse_plan(const Origin& before, const Origin& now);

}  // namespace espalier::studio
