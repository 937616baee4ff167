// How much of a ray, or of a disc of rays, passes the balls that it meets.
#pragma once

#include "environment/light/shade/balls_along.h"

namespace espalier::environment {

/// The lengths of a ray inside the balls, each as a part of the ball's diameter, added up. Balls are larger by
/// `margin`.
double sum_of_chords(const BallsMet& met, double margin);

/// The product of 1 - (1 - t) A / (pi r^2) over the balls with their centre in front, A being the area that the ball's
/// disc shares with the ray's own of radius r. Writes behind the last ball.
double passed_by_areas(BallsMet& met, double radius, double transmittance);

}  // namespace espalier::environment
