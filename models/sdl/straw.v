/* A width for straw.sdl, whose components are lines */
initial line width: 0.12 s
line style: cylinder
