/* View of the shoot: turtle, functions, light */
initial line width: 0.15 cylinder
initial color: 16
contour sides: 8
function set: shape.fset
viewpoint: 0,0,1
projection: parallel
scale factor: 0.9
z buffer: on
render mode: shaded
light: V 1,1,2 A 0.2,0.2,0.2
