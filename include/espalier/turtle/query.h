// What a plant asks: its surroundings, in questions stamped by the turtle that met them, or the turtle itself.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/geometry/plant_geometry.h"
#include "espalier/lsystem/module_string.h"

#include <array>
#include <cstdint>
#include <span>

namespace espalier::turtle {

/// One communication module of one plant, ?E or a named one, which a process of the scene answers. Parameters point
/// into the plant's string.
struct Query {
    std::int16_t process = -1;       ///< index into Model::processes; -1: ?E, the scene's default process
    LetterId following = no_letter;  ///< the module that follows in the string, if any
    std::uint32_t plant = 0;
    std::uint32_t module = 0;       ///< index of the module that carries the parameters
    std::size_t parameters_at = 0;  ///< where they begin in ModuleString::parameters
    std::span<const double> parameters;
    std::span<const double> following_parameters;
    Identity identity = 0;  ///< identity of the communication module; 0 if the string keeps no lineage
    Identity following_identity = 0;
    Pose pose;
    double width = 0;  ///< line width, metres
    double scale = 1;
};

/// Makes room for queries without initialising them: every caller writes what it makes room for.
template <class T>
class UnwrittenAllocator : public UninitialisedAllocator<T> {
public:
    template <class U>
    struct rebind {
        using other = UnwrittenAllocator<U>;
    };
    using UninitialisedAllocator<T>::UninitialisedAllocator;
    using UninitialisedAllocator<T>::construct;

    template <class U>
    void construct(U*) noexcept {}
};

using QueryColumn = std::vector<Query, UnwrittenAllocator<Query>>;

/// Where the turtle was that answered ?P ?H ?L ?U or ?Q itself. Of ?P that is the answer; the others have more.
struct TurtleAnswer {
    std::uint32_t module;       ///< index of the module that carries the parameters
    std::uint32_t count;        ///< parameters that are answered with the position, the first ones
    std::size_t parameters_at;  ///< where they begin in ModuleString::parameters
    glm::dvec3 position;
    double width;  ///< line width, metres
};

/// The answer to ?H ?L ?U or ?Q.
struct TurtleDirection {
    std::size_t parameters_at = 0;
    std::size_t count = 0;  ///< number of values
    std::array<double, 4> values{};
};

/// An answer is written over a copy of the query's own parameters; what a process leaves alone keeps its value.
using Answer = std::span<double>;

}  // namespace espalier::turtle
