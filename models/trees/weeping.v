/* Gravity; the model says how much each branch yields to it. */
tropism: T 0,-1,0
line style: cylinder
render mode: shaded
