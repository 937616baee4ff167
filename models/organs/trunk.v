/* The cross-section of trunk.l */
contour: 1 fluted.con
contour sides: 48
line style: cylinder
render mode: shaded
