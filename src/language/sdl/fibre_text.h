// The fibres of a skeleton as productions of a homomorphism: generalized cylinders whose rings are magnetic cuts.
#pragma once

#include "language/sdl/skeleton.h"

#include <string>
#include <vector>

namespace espalier::language::sdl {

/// Names of the modules that one set of fibres becomes.
struct FibreModules {
    const Fibre* fibre = nullptr;
    std::string drawn;  ///< draws a fibre
    std::string along;  ///< moves along its bent axis; empty if it is straight
};

/// Rings along the fibre: every part of the contour has a whole number of stretches.
int stretches_of(const Fibre& fibre);
/// The strengths of the magnets of a ring, `at` from 0, the beginning of the fibre, to 1.
std::vector<double> strengths_at(const Fibre& fibre, double at);

/// What a component's production contains to draw its fibre.
std::string fibre_call(const FibreModules& modules);
/// The productions that draw a set of fibres and move along them.
std::string fibre_productions(const FibreModules& modules);

}  // namespace espalier::language::sdl
