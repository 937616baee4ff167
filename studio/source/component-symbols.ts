/** Symbols of the types of components, in a square of 24 units (Lintermann & Deussen 1997, figure 5). */

const rays = (count: number, from: number, to: number): string =>
  Array.from({ length: count }, (_, i) => {
    const angle = (2 * Math.PI * i) / count - Math.PI / 2;
    const at = (radius: number) => `${(12 + radius * Math.cos(angle)).toFixed(1)} ${(12 + radius * Math.sin(angle)).toFixed(1)}`;
    return `M${at(from)}L${at(to)}`;
  }).join("");

const circle = (x: number, y: number, radius: number): string =>
  `M${x - radius} ${y}a${radius} ${radius} 0 1 0 ${2 * radius} 0a${radius} ${radius} 0 1 0 ${-2 * radius} 0`;

/** Outlines by type; a type of its own that is not here has none. */
export const componentSymbols: Readonly<Record<string, string>> = {
  Simple: `${circle(12, 12, 8)}M4 12a8 3 0 0 0 16 0`,
  Horn: "M5 21C5 12 10 5 19 3C14 8 13 14 13 21a4 1.5 0 0 1 -8 0",
  Leaf: "M12 22V3M12 3C5 8 5 15 12 19C19 15 19 8 12 3M12 10L8.5 8M12 10L15.5 8M12 14.5L8 12M12 14.5L16 12",
  Tree: "M12 22V3M12 18L4 12M12 18L20 12M12 12L6 7M12 12L18 7M12 7L9 4M12 7L15 4",
  Hydra: rays(8, 1.5, 9.5),
  Ring: `${circle(12, 12, 7)}${rays(8, 7, 10.5)}`,
  Phiball: `${circle(12, 12, 6)}${rays(12, 7.5, 8)}${rays(7, 2, 2.5)}${rays(10, 10, 10.5)}`,
  FFD: "M3 6C9 3 15 9 21 6V18C15 21 9 15 3 18ZM9 5.5V17.5M15 6.5V18.5M3 12C9 9 15 15 21 12",
  World: `${circle(12, 12, 9)}M12 7V16M12 17L9 13M12 17L15 13`,
};
