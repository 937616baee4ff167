#define RED 3
angle factor: 16
initial color: RED 4
color increment: 1
initial line width: 0.5 cylinder
line width increment: 0.1
initial scale: 2
scale multiplier: 1.5
interpretation past %: off
environment display: before
viewpoint: 0,0,1
view reference point: 0, 0, 0
twist: 10
projection: perspective
viewing angle: 30
front distance: 0.1
back distance: 100
scale factor: 1.2
box: x: -1,1 y: -1,1 z: -1,1
z buffer: on
render mode: shaded
light: V: 1,1,1 A: 0.1,0.1,0.1 D: 1 1 1 S: 1 1 1
light: O: 1 2 3 P: 0 0 1 2 30 T: 1 0.1 0
shadow map: size: 512 color: .1 .2 .3 offset: 4 5
surface: l leaf.s 1 3 3 0
surface: p petal.s 0.5
contour: 1 fluted.con
contour sides: 12
line style: polygon
tapered lines: on
twist of cylinders: on
tropism: T: 0 -1 0 A: 45 I: 0.5 E: 0.2 S: 0.1
torque: T: 1 0 0 I: 0.5 E: 0.1
tropism direction: 0,1,0
initial elasticity: 0.1
elasticity increment: 0.01
texture: F: bark.png L: l H: l E: m S R: 2
