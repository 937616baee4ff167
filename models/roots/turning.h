/* The rule of roots that turn to where something in the soil rises: a model says what the tip asks (ASK), what it is
   answered with the gradient gx, gy, gz (ANSWER), whether there is room for one more step (HAS_ROOM), and the weight of
   that direction (TURN). Without room a tip stops.

   Modules
     T(l)       tip of a root of `l` metres
     ?H(x,y,z)  the turtle's heading  */

#define STEEP(gx, gy, gz) sqrt((gx) * (gx) + (gy) * (gy) + (gz) * (gz))
#define BEND(g, gx, gy, gz) (TURN * (g) / (STEEP(gx, gy, gz) + HALF))

T(l) ?H(x, y, z) ANSWER : l < LENGTH && HAS_ROOM -->
	@R(x + BEND(gx, gx, gy, gz), y + BEND(gy, gx, gy, gz) - GRAVI, z + BEND(gz, gx, gy, gz))
	/(ran(360)) +(nran(0, WIGGLE)) F(RATE) T(l + RATE) ?H(0, 0, 0) ASK
T(l) ?H(x, y, z) ANSWER --> T(l)
