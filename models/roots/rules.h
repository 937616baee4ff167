/* Rules that the root systems of this folder share.

   An axis of order o, 0 for the axes at the seed and the stem, approaches its final length: after t days it has
   LENGTH(o, t) = k (1 - exp(-r t / k)), k final length, r initial rate (Pages, Jordan & Picard 1989). Laterals stand
   SPACING(o) apart and emerge DELAY days after the tip has passed. Lengths, places and times do not depend on the length of
   a step. Tips ask the soil: their time runs slower where it is not as good as it could be. A model may define what they
   ask (ASK), what is answered (ANSWER) and the PACE of their time; else tips of laterals ask for nitrate.

   Modules
     A(w)        an axis that is to emerge in `w` days, where it stands (in the first step, made after the others, less DT)
     R(o,t,l)    tip of an axis of order o, t days old, l metres from its base
     G(o,t,l,to) the same in the middle of a step: it has grown to `l` of `to` metres  */

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
#ifndef ASK
#define ASK ?nitrate(1000000)
#define ANSWER ?nitrate(c)
#define PACE(o) ((o) == 0 ? 1 : LEAST + (1 - LEAST) * (c) / ((c) + HALF))
#endif

A(w) : w > DT --> A(w - DT)
A(w) --> !(WIDTH(0)) G(0, DT - w, 0, GROWN(0, DT - w)) ASK
R(o, t, l) ANSWER --> G(o, t + DT * PACE(o), l, GROWN(o, t + DT * PACE(o))) ASK

decomposition
maximum depth: 400
G(o, t, l, to) : NEXT(o, l) <= to -->
	F(NEXT(o, l) - l) [/(ran(360)) +(ANGLE(o)) !(WIDTH(o + 1))
	G(o + 1, t - TIME(o, NEXT(o, l)) - DELAY, 0, GROWN(o + 1, t - TIME(o, NEXT(o, l)) - DELAY)) ASK]
	/(ran(360)) +(nran(0, WIGGLE)) G(o, t, NEXT(o, l), to)
G(o, t, l, to) : to > l --> F(to - l) R(o, t, to)
G(o, t, l, to) --> R(o, t, l)
