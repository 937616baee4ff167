// The plants of a world, wherever they are: in memory, in parts on disk, on several ranks.
#pragma once

#include "espalier/environment/environment.h"

#include "simulation/plant/growing_plant.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <vector>

namespace espalier::simulation {

/// A world steps through the parts of its plants and asks nothing about where they are: it fetches a part, derives and
/// interprets the plants of it that are local, and stores it. Then processes see the queries, and recorders are shown
/// the plants. A plant is local to one rank. Of the others, the world has the number, the description and the count of
/// modules.
///
/// Functions that are marked "together" are called by all ranks in the same order. The others concern this process
/// alone, and throw RunError where a disk is full or fails.
class PlantSet {
public:
    using Part = std::span<GrowingPlant>;  ///< plants that follow each other in the scene

    virtual ~PlantSet() = default;

    /// Of the whole scene, by number.
    virtual std::span<GrowingPlant> all() = 0;

    // The growth of one step.

    /// Together: what was received of other ranks is forgotten, and after a checkpoint plants may move to ranks that
    /// have less to do. `busy`: seconds that this rank has worked on its plants so far.
    virtual void begin_growth(double busy, int step) = 0;
    /// Together: all plants, cut so that the local ones of each part fit into memory; as many parts on all ranks, of
    /// which the last may be empty.
    virtual std::vector<Part> parts() = 0;
    /// The local plants of the part come into memory.
    virtual void fetch(Part part) = 0;
    /// Together, when all plants are derived: modules that were born in this step are numbered after `births`, plant by
    /// plant in the order of the scene; `births` grows by them. Plants that are stored by then get the numbers when
    /// they are read. `is_recorded`: somebody sees the numbers of plants that other ranks hold.
    virtual void place_births(std::uint64_t& births, bool is_recorded) = 0;
    /// It has been interpreted. `drawn`: recorders will read what is drawn.
    virtual void store(Part part, int step, bool drawn) = 0;
    /// All parts are stored.
    virtual void end_growth() = 0;

    // The exchange.

    /// Together: plants that others hold get what processes must see of them. `first_sees_all`: on the first rank,
    /// whose fields are recorded, processes see all queries.
    virtual void share(Environment& environment, int step, bool first_sees_all) = 0;
    /// What a plant asks, between growth and exchange. They stand in `room` where the plant is not in memory.
    virtual std::span<const Query> queries_of(const GrowingPlant& plant, QueryColumn& room) = 0;
    /// Those of all plants; null where they are in the plants' interpretations.
    virtual const environment::WaitingQueries* queries() = 0;

    // Recording.

    /// What processes say of a plant that is local or shown.
    virtual std::vector<Quantity> statistics(const Environment& environment, const GrowingPlant& plant) = 0;
    /// Together: parts in which one process can look at all plants without more memory than growth takes.
    virtual std::vector<Part> frame_parts() = 0;
    /// Together: each rank r is shown the plants to_each[r] whole, until it hides them; ranks after these, nothing.
    virtual void show(std::span<const Part> to_each, const Environment& environment, int step) = 0;
    /// On all ranks, after show().
    virtual void hide() = 0;
    /// How many ranks may each write some of the files of a frame.
    virtual std::size_t writers() = 0;
    /// Together: how many points each plant has in a file.
    virtual std::vector<std::size_t> points() = 0;

    // Checkpoints.

    /// Together: the first rank gets the states that others hold, in an unlinked file in `folder`.
    virtual void gather_states(const std::filesystem::path& folder) = 0;
    /// Of a local plant; on the first rank, after gather_states(), of any.
    virtual void put_state(std::ostream& out, GrowingPlant& plant) = 0;
    /// The state of a plant was read: of one that is local, this rank keeps it.
    virtual void take_restored(GrowingPlant& plant) = 0;
    /// About what a checkpoint of the local plants takes.
    virtual std::size_t bytes() = 0;

    /// To other ranks, so far.
    struct Sent {
        std::uint64_t messages = 0, bytes = 0;
    };
    virtual Sent sent() = 0;
};

}  // namespace espalier::simulation
