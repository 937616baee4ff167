// A plant as bytes, for another rank or for later.
#pragma once

#include "simulation/plant/growing_plant.h"

#include <cstddef>
#include <iosfwd>
#include <span>

namespace espalier::simulation {

/// Some queries of a plant, with their parameters and nothing else of the plant.
void put_queries(std::ostream& out, std::span<const Query* const> queries);
/// The plant then has a string of the parameters alone, where processes read and answer them.
void get_queries(std::istream& in, GrowingPlant& plant);

/// What is drawn, but for the surfaces of its organs.
void put_geometry(std::ostream& out, const PlantGeometry& drawn);
void get_geometry(std::istream& in, PlantGeometry& drawn);

/// The string, what is drawn of it, and what it asks.
void put_plant(std::ostream& out, const GrowingPlant& plant);
/// `step` says which surfaces the plant has.
void get_plant(std::istream& in, GrowingPlant& plant, int step);

/// Where the parameters of the module that follows a query begin in the plant's string; 0 if it has none.
std::size_t following_at(const Query& query, const ModuleString& string);

/// What lasts of a plant from step to step.
void put_state(std::ostream& out, const GrowingPlant& plant);
/// Its string takes no more than `memory` bytes. Throws RunError for bytes that are damaged.
void get_state(std::istream& in, GrowingPlant& plant, std::size_t memory);

}  // namespace espalier::simulation
