/** The surface on which a field has one value, by surface nets (Gibson 1998): one vertex in each cell that it crosses. */
import type { Vector } from "./packets.js";

export interface Isosurface {
  /** From 0 to 1 across the box of the field. */
  positions: Float32Array;
  indices: Uint32Array;
}

const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [k & 1, (k >> 1) & 1, k >> 2] as const);
const edges = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((from) => [1, 2, 4].filter((bit) => !(from & bit)).map((bit) => [from, from | bit]));

/** `values` stand at the centres of voxels, x fastest; `level` is in their unit. At the border of the box it is open. */
export function isosurface(values: Uint8Array, size: Vector, level: number): Isosurface {
  const [columns, rows, layers] = size;
  const strides = [1, columns, columns * rows];
  const positions: number[] = [];
  const indices: number[] = [];
  const vertexOf = new Int32Array(values.length).fill(-1);

  /** The mean of where the edges of a cell cross the level; -1 if none does. */
  const vertex = (x: number, y: number, z: number, at: number): number => {
    const here = corners.map(([i, j, k]) => values[at + i + j * strides[1] + k * strides[2]] - level);
    if (here.every((value) => value >= 0) || here.every((value) => value < 0)) return -1;
    const sum = [0, 0, 0];
    let count = 0;
    for (const [from, to] of edges) {
      if (here[from] < 0 === here[to] < 0) continue;
      const part = here[from] / (here[from] - here[to]);
      for (let k = 0; k < 3; k++) sum[k] += corners[from][k] + part * (corners[to][k] - corners[from][k]);
      count++;
    }
    [x, y, z].forEach((cell, k) => positions.push((cell + 0.5 + sum[k] / count) / size[k]));
    return positions.length / 3 - 1;
  };

  for (let z = 0; z < layers - 1; z++)
    for (let y = 0; y < rows - 1; y++)
      for (let x = 0; x < columns - 1; x++) {
        const at = x + y * strides[1] + z * strides[2];
        vertexOf[at] = vertex(x, y, z, at);
      }

  // The four cells around each edge that crosses the level make a square.
  const place = [0, 0, 0];
  for (place[2] = 0; place[2] < layers; place[2]++)
    for (place[1] = 0; place[1] < rows; place[1]++)
      for (place[0] = 0; place[0] < columns; place[0]++) {
        const at = place[0] + place[1] * strides[1] + place[2] * strides[2];
        for (let axis = 0; axis < 3; axis++) {
          const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
          if (place[axis] + 1 >= size[axis] || place[u] === 0 || place[v] === 0) continue;
          if (values[at] >= level === values[at + strides[axis]] >= level) continue;
          const square = [at, at - strides[u], at - strides[u] - strides[v], at - strides[v]].map((cell) => vertexOf[cell]);
          if (square.some((number) => number < 0)) continue;
          indices.push(square[0], square[1], square[2], square[0], square[2], square[3]);
        }
      }
  return { positions: new Float32Array(positions), indices: new Uint32Array(indices) };
}
