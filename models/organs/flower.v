/* Surfaces of flower.l */
surface: s sepal.s 1
surface: p petal.s 1
line style: cylinder
render mode: shaded
