// Lists, vectors and the surface of one value of a field.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { at, increase } = await load("lists.ts");
const { around, sameVector, vectorOf } = await load("view/vectors.ts");
const { isosurface } = await load("view/isosurface.ts");

test("an element that is missing is a mistake, not undefined", () => {
  assert.equal(at([7, 8], 1), 8);
  assert.throws(() => at([7, 8], 2), /2 elements has none with the index 2/);
  const counts = new Uint32Array(2);
  assert.deepEqual([increase(counts, 1, 3), increase(counts, 1, 1), counts[1]], [0, 3, 4]);
});

test("vectors are equal by their numbers: 0.1 + 0.2 is not 0.3, and -0 is 0", () => {
  assert.ok(sameVector([1, -0, 2], [1, 0, 2]) && sameVector(null, null));
  assert.ok(!sameVector([0.1 + 0.2, 0, 0], [0.3, 0, 0]) && !sameVector(null, [0, 0, 0]));
  const box = around({ lower: [0, 0, 0], upper: [1, 1, 1] }, { lower: [-1, 0.5, 0], upper: [0, 3, 0.5] });
  assert.deepEqual(box, { lower: [-1, 0, 0], upper: [1, 3, 1] });
});

test("the surface of a distance is a closed sphere", () => {
  const side = 24;
  const radius = 8;
  const away = (point) => Math.hypot(...point.map((value) => value - side / 2));
  const values = new Uint8Array(side ** 3);
  for (let i = 0; i < values.length; i++) {
    const cell = [i % side, Math.floor(i / side) % side, Math.floor(i / side ** 2)];
    values[i] = 10 * away(cell.map((value) => value + 0.5));
  }
  const { positions, indices } = isosurface(values, [side, side, side], 10 * radius);
  for (let i = 0; i < positions.length; i += 3) {
    const distance = away(vectorOf((k) => positions[i + k] * side));
    assert.ok(Math.abs(distance - radius) < 0.2, `${distance}`);
  }
  // Each edge belongs to two triangles, which walk along it in opposite directions or both in the same.
  const edges = new Map();
  for (let i = 0; i < indices.length; i++) {
    const pair = [indices[i], indices[i % 3 === 2 ? i - 2 : i + 1]].sort((a, b) => a - b).join();
    edges.set(pair, (edges.get(pair) ?? 0) + 1);
  }
  assert.ok(edges.size > 500 && [...edges.values()].every((count) => count === 2));
});
