/* The tropisms of ABOP figure 2.8; the model gives their elasticity. */
#define FIGURE 1

#if FIGURE == 3
tropism: T -0.02,-1,0
#elif FIGURE == 4
tropism: T -0.61,0.77,-0.19
#else
tropism: T 0,-1,0
#endif
line style: cylinder
render mode: shaded
