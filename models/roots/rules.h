/* Rules that the root systems of this folder share.

   An axis of order o, 0 for the axes at the seed and the stem, approaches its final length: after t days it has
   LENGTH(o, t) = k (1 - exp(-r t / k)), k final length, r initial rate (Pages, Jordan & Picard 1989). Laterals stand
   SPACING(o) apart and emerge DELAY days after the tip has passed. Lengths, places and times do not depend on the length of
   a step. Tips ask the soil: their time runs slower where it is not as good as it could be, and stands still at a wall: a
   tip that has ROOM metres to the nearest one grows by no more than these, less its radius. Axes ask before they emerge; only
   the one of an axiom, which emerges at once, cannot know of a wall. A model may define what they ask (ASK), what is
   answered (ANSWER), the PACE of their time and their ROOM; else tips ask for nitrate, which only laterals heed, and for
   the nearest wall. A model that defines AGED(t) has it behind each piece, which is t days old at its far end.

   Modules
     A(w)        an axis that is to emerge in `w` days, where it stands (in the first step, made after the others, less DT)
     R(o,t,l)    tip of an axis of order o, t days old, l metres from its base
     G(o,t,l,to,p,d) the same in the middle of a step: it has grown to `l` of `to` metres, at the pace p, and has d metres
                 to the nearest wall  */

#define BY_ORDER(o, a, b, c) ((o) == 0 ? (a) : (o) == 1 ? (b) : (c))
#define FINAL(o) BY_ORDER(o, LENGTH_0, LENGTH_1, LENGTH_2)
#define RATE(o) BY_ORDER(o, RATE_0, RATE_1, RATE_2)
#define WIDTH(o) BY_ORDER(o, WIDTH_0, WIDTH_1, WIDTH_2)
#define ANGLE(o) BY_ORDER(o, ANGLE_1, ANGLE_2, 0)
#define SPACING(o) BY_ORDER(o, SPACING_0, SPACING_1, 1000)
#define LENGTH(o, t) (FINAL(o) * (1 - exp(-RATE(o) * (t) / FINAL(o))))
#define TIME(o, l) (-FINAL(o) / RATE(o) * log(1 - (l) / FINAL(o)))
#define NEXT(o, l) ((floor((l) / SPACING(o) + 0.000001) + 1) * SPACING(o))
#define GROWN(o, t) ((t) > 0 ? LENGTH(o, t) : 0)
#define FREE(o, d) ((d) > WIDTH(o) / 2 ? (d) - WIDTH(o) / 2 : 0)
#define HELD(o, t, l, d) (GROWN(o, t) > (l) + FREE(o, d) ? TIME(o, (l) + FREE(o, d)) : (t))
#define BORN(o, t, l) ((t) - TIME(o, l) - DELAY)
#ifndef ASK
#define ASK ?nitrate(1000000, 0, 0, 0, 0, 1000)
#define ANSWER ?nitrate(c, gx, gy, gz, taken, room)
#define PACE(o) ((o) == 0 ? 1 : LEAST + (1 - LEAST) * (c) / ((c) + HALF))
#define ROOM room
#endif
#ifndef ROOM
#define ROOM 1000
#endif
#ifdef AGED
?roots(h, u, s, f, t) --> ?roots(0, 0, 0, 0, t + DT)
#else
#define AGED(t)
#endif

A(w) ANSWER : w > DT --> A(w - DT) ASK
A(w) ANSWER -->
	!(WIDTH(0)) G(0, HELD(0, DT - w, 0, ROOM), 0, GROWN(0, HELD(0, DT - w, 0, ROOM)), 1, ROOM) ASK
A(w) : w > DT --> A(w - DT) ASK
A(w) --> !(WIDTH(0)) G(0, DT - w, 0, GROWN(0, DT - w), 1, 1000) ASK
R(o, t, l) ANSWER -->
	G(o, HELD(o, t + DT * PACE(o), l, ROOM), l, GROWN(o, HELD(o, t + DT * PACE(o), l, ROOM)), PACE(o), ROOM) ASK

decomposition
maximum depth: 400
G(o, t, l, to, p, d) : NEXT(o, l) <= to -->
	F(NEXT(o, l) - l) AGED((t - TIME(o, NEXT(o, l))) / p) [/(ran(360)) +(ANGLE(o)) !(WIDTH(o + 1))
	G(o + 1, HELD(o + 1, BORN(o, t, NEXT(o, l)), 0, d + l - NEXT(o, l)), 0,
	GROWN(o + 1, HELD(o + 1, BORN(o, t, NEXT(o, l)), 0, d + l - NEXT(o, l))), p, d + l - NEXT(o, l)) ASK]
	/(ran(360)) +(nran(0, WIGGLE)) G(o, t, NEXT(o, l), to, p, d + l - NEXT(o, l))
G(o, t, l, to, p, d) : to > l --> F(to - l) AGED(0) R(o, t, to)
G(o, t, l, to, p, d) --> R(o, t, l)
