/* Shared by models: a flat leaf of a length and an angle of half its tip. */
#define LEAF(length, angle) { . +(angle) f(length) -(2 * (angle)) f(length) -(180 - 2 * (angle)) f(length) }
