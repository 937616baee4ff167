/** The surface on which a field has one value, by surface nets (Gibson 1998): one vertex in each cell that it crosses. */
import { at } from "../lists.js";
import { axes, vectorOf, type Vector } from "./vectors.js";

export interface Isosurface {
  /** From 0 to 1 across the box of the field. */
  positions: Float32Array;
  indices: Uint32Array;
}

const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [k & 1, (k >> 1) & 1, k >> 2] as const);
const edges = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((from) =>
  [1, 2, 4].filter((bit) => !(from & bit)).map((bit) => [from, from | bit] as const),
);

/** `values` stand at the centres of voxels, x fastest; `level` is in their unit. At the border of the box it is open. */
export function isosurface(values: Uint8Array, size: Vector, level: number): Isosurface {
  const [columns, rows, layers] = size;
  const strides = [1, columns, columns * rows] as const;
  const positions: number[] = [];
  const indices: number[] = [];
  const vertexOf = new Int32Array(values.length).fill(-1);

  /** The mean of where the edges of a cell cross the level; -1 if none does. */
  const vertex = (cell: Vector, first: number): number => {
    const here = corners.map(([i, j, k]) => at(values, first + i + j * strides[1] + k * strides[2]) - level);
    if (here.every((value) => value >= 0) || here.every((value) => value < 0)) return -1;
    const sum: [number, number, number] = [0, 0, 0];
    let count = 0;
    for (const [from, to] of edges) {
      const [before, after] = [at(here, from), at(here, to)];
      if (before < 0 === after < 0) continue;
      const part = before / (before - after);
      const [start, end] = [at(corners, from), at(corners, to)];
      for (const k of axes) sum[k] += start[k] + part * (end[k] - start[k]);
      count++;
    }
    positions.push(...vectorOf((k) => (cell[k] + 0.5 + sum[k] / count) / size[k]));
    return positions.length / 3 - 1;
  };

  for (let z = 0; z < layers - 1; z++)
    for (let y = 0; y < rows - 1; y++)
      for (let x = 0; x < columns - 1; x++) {
        const first = x + y * strides[1] + z * strides[2];
        vertexOf[first] = vertex([x, y, z], first);
      }

  // The four cells around each edge that crosses the level make a square.
  const place: [number, number, number] = [0, 0, 0];
  for (place[2] = 0; place[2] < layers; place[2]++)
    for (place[1] = 0; place[1] < rows; place[1]++)
      for (place[0] = 0; place[0] < columns; place[0]++) {
        const here = place[0] + place[1] * strides[1] + place[2] * strides[2];
        for (const [axis, u, v] of [[0, 1, 2], [1, 2, 0], [2, 0, 1]] as const) {
          if (place[axis] + 1 >= size[axis] || place[u] === 0 || place[v] === 0) continue;
          if (at(values, here) >= level === at(values, here + strides[axis]) >= level) continue;
          const a = at(vertexOf, here);
          const b = at(vertexOf, here - strides[u]);
          const c = at(vertexOf, here - strides[u] - strides[v]);
          const d = at(vertexOf, here - strides[v]);
          if (Math.min(a, b, c, d) < 0) continue;
          indices.push(a, b, c, a, c, d);
        }
      }
  return { positions: new Float32Array(positions), indices: new Uint32Array(indices) };
}
