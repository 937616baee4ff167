/* The curve that the liana follows, with 400 chords to measure it */
curve: helix.cur 400
initial line width: 0.2 cylinder
