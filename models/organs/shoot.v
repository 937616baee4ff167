/* The leaf of shoot.l */
surface: l leaf.s 1
line style: cylinder
render mode: shaded
