// Curves of side files: numbers of uniform cubic B-splines.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { uniformSpline, clampedSpline, heightAt } = await load("side/spline.ts");
const point = (x, y, times = 1) => ({ x, y, z: 0, times });
const near = (a, b) => a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) < 1e-6, `${a} is not ${b}`));

test("a segment begins at a sixth, four sixths and a sixth of its points", () => {
  const curve = uniformSpline([point(0, 6), point(6, 0), point(12, 6), point(18, 0)], false);
  near(curve[0], [6, 2, 0]);
  near(curve.at(-1), [12, 4, 0]);
});

test("points in a line give a line, evenly walked", () => {
  const curve = uniformSpline([0, 1, 2, 3, 4].map((x) => point(x, 2 * x)), false, 4);
  curve.forEach(([x, y]) => near([y], [2 * x]));
  near(curve[2], [1.5, 3, 0]);
});

test("a closed curve ends where it begins", () => {
  const curve = uniformSpline([point(1, 0), point(0, 1), point(-1, 0), point(0, -1)], true);
  near(curve[0], curve.at(-1));
});

test("three points at one place make a corner that the curve goes through", () => {
  const curve = uniformSpline([point(0, 0), point(5, 7, 3), point(9, 0)], false);
  assert.ok(curve.some(([x, y]) => Math.abs(x - 5) < 1e-9 && Math.abs(y - 7) < 1e-9));
});

test("the curve of functions reaches its first and last point", () => {
  const curve = clampedSpline([point(0, 1), point(0.3, 0), point(0.6, 2), point(1, 0.5)]);
  near(curve[0], [0, 1, 0]);
  near(curve.at(-1), [1, 0.5, 0]);
  near(clampedSpline([point(0, 8), point(0, 0), point(0, 0), point(0, 0)])[80], [0, 1, 0]); // (1 - 1/2)^3 of 8
});

test("the height of a curve is that of the line between its places, and of its ends beyond them", () => {
  const curve = [[0, 1, 0], [0.5, 3, 0], [0.5, 4, 0], [1, 2, 0]];
  for (const [x, y] of [[-1, 1], [0, 1], [0.25, 2], [0.5, 3], [0.75, 3], [1, 2], [7, 2]]) assert.equal(heightAt(curve, x), y);
  // Of points in even distances the spline is y = x^3 there: 0, 0, 0 and 1 have that polynomial.
  const cubic = clampedSpline([point(0, 0), point(1 / 3, 0), point(2 / 3, 0), point(1, 1)], 2000);
  for (const x of [0.2, 0.5, 0.9]) near([heightAt(cubic, x)], [x ** 3]);
});
