// A world whose plants several ranks hold: what an exchange, a frame and a checkpoint need from the others.
#pragma once

#include "espalier/environment/environment.h"
#include "espalier/simulation/ranks.h"
#include "espalier/simulation/scene.h"

#include "simulation/spread/plant_set.h"

#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace espalier::simulation {

/// Every rank derives and interprets the plants of its own blocks. In an exchange each process answers, on every rank,
/// the queries of the plants that the rank holds, having seen those queries of others that its kind of Spreading asks
/// for; answers to the others' are thrown away. So the values are those of one rank that holds all plants. Whoever
/// records plants gets them whole. All ranks call the same functions in the same order.
class Spread {
public:
    /// `fields_read`: the fields that turtles read. Throws UserError for a process that cannot be spread, and where
    /// there are more ranks than blocks.
    Spread(Ranks& ranks, const Scene& scene, const Environment& environment,
           const std::vector<std::string>& fields_read);

    Ranks& ranks() { return ranks_; }
    void mark(std::span<GrowingPlant> plants) const;
    /// What the user should know of processes that every rank carries whole: a line each.
    std::vector<std::string> notes(const Environment& environment) const;

    /// Before the exchange: plants of others get what processes must see of them. `first_sees_all`: on the first rank,
    /// whose fields are recorded, processes see all queries.
    void share(PlantSet& plants, Environment& environment, int step, bool first_sees_all);
    /// After the exchange: each rank r gets the plants of to_each[r] that others hold, and what processes say of each,
    /// for a part of a frame. Ranks after these get nothing.
    void distribute(PlantSet& plants, std::span<const PlantSet::Part> to_each, const Environment& environment,
                    int step);
    /// What the processes of the rank that holds a plant say of it.
    std::vector<Quantity> statistics(const Environment& environment, const GrowingPlant& plant) const;
    /// Returns, on every rank, a number for each of these plants, which follow each other: what `of` says of it on the
    /// rank that holds it.
    std::vector<double> of_each(std::span<const GrowingPlant> plants,
                                const std::function<double(const GrowingPlant&)>& of);
    /// Forgets what was received of plants that others hold.
    void forget(std::span<GrowingPlant> plants);

    /// Returns, on the first rank, the state of each of these plants, which follow each other, that another holds; ""
    /// for the others.
    std::vector<std::string> states(PlantSet& plants, PlantSet::Part part);

    /// Moves plants, block by block, where the slowest rank takes 1.3 times as long as the mean. `seconds`: what this
    /// rank has worked on its plants since it was asked last. `memory`: bytes that a plant's string may take.
    void balance(PlantSet& plants, double seconds, std::size_t memory);

private:
    /// Where queries of a rank may be asked whose answers others change: a box for each of its blocks and processes.
    using Places = std::vector<std::vector<Box>>;

    /// What the plants of this rank ask.
    struct Asked {
        Places places;
        std::vector<std::vector<Box>>
            reaches;                        ///< of plants, by number: around the reaches of their queries, by process
        std::vector<bool> goes_everywhere;  ///< of plants: they ask a process that sees all queries
    };

    Asked asked(PlantSet& plants, Environment& environment, int step) const;
    std::vector<Places> places_of_all(const Places& own);
    bool may_matter(const GrowingPlant& plant, const Asked& asked, const Places& places) const;
    void select(const GrowingPlant& plant, std::span<const Query> queries, Environment& environment, int step,
                const Places& places, bool sees_all, std::vector<const Query*>& selected) const;
    std::vector<double> weights_of(std::span<const GrowingPlant> plants, double seconds);
    void move(PlantSet& plants, const std::vector<int>& to, std::size_t memory);
    void put_shared(std::ostream& out, PlantSet& plants, Environment& environment, int step, const Asked& asked,
                    const Places& places, bool sees_all) const;
    /// Trades what `write` writes for each of the other ranks; returns what they wrote for this one, an empty text for
    /// itself.
    std::vector<std::string> traded(const std::function<void(std::ostream& out, int rank)>& write);

    Ranks& ranks_;
    std::vector<std::size_t> blocks_;                ///< of plants
    std::vector<int> rank_of_;                       ///< of plants
    std::vector<Spreading> spreadings_;              ///< of processes
    bool sends_plants_ = false;                      ///< whole ones, to all
    std::vector<std::vector<Quantity>> statistics_;  ///< of plants that others hold
};

}  // namespace espalier::simulation
