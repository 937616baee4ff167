// A world whose stages are called one by one.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/simulation/world.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace espalier::simulation {

/// What derivation leaves of a step: it can be drawn again, and gone on from.
struct DerivedStep {
    struct OfPlant {
        std::shared_ptr<const ModuleString> string;
        std::string memory;  ///< memory of the derivation, as bytes for this machine
    };
    int step = 0;
    std::vector<OfPlant> plants;
    std::uint64_t births = 0;  ///< modules that were born until then
};

/// A world in the memory of one process, for whoever looks at what a stage of start() or step() leaves, or draws some
/// of the steps only.
class StagedWorld : public World {
public:
    explicit StagedWorld(const Scene& scene, std::size_t memory = std::size_t(-1),
                         const std::filesystem::path& files = {}, std::shared_ptr<Printout> printout = nullptr);

    /// Before the first step: the derivation length of all plants, instead of the scene's.
    void set_steps(int steps);

    void write_axioms();
    void derive();
    void interpret();
    void exchange();
    /// Answers what turtles answer themselves in an exchange: ?P, ?H, ?L, ?U.
    void answer_turtle_queries();

    /// After write_axioms() or derive().
    DerivedStep derived() const;
    /// Instead of write_axioms() or derive(): the world is as it was when `derived` was taken, of this scene or of one
    /// that derives alike. It can go on from there in scenes without processes whose plants neither ask nor grow anew
    /// in every step. Others have more to remember, see WorldCheckpoint: they may only be interpreted.
    void take(const DerivedStep& derived);
    /// frame() without what processes know: after take() they know nothing of the step.
    Frame frame_of_plants() const;
};

}  // namespace espalier::simulation
