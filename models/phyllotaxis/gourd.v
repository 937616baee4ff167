/* A receptacle for collision.l with SHAPE 4: its profile, x the radius and y the height, and the radii of its organs */
curve: gourd.cur 400
function: gourd.func
initial line width: 1 cylinder
