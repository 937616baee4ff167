import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { sweptValues } = await load("swept-values.ts");

test("values stand at equal distances, ends included, and rise", () => {
  assert.deepEqual(sweptValues(0, 1, 5, false), [0, 0.25, 0.5, 0.75, 1]);
  assert.deepEqual(sweptValues(30, 10, 3, false), [10, 20, 30]);
  assert.deepEqual(sweptValues(0, 1, 4, false), [0, 0.333333, 0.666667, 1]);
});

test("whole numbers come once, and there are 3 to 12 values", () => {
  assert.deepEqual(sweptValues(1, 3, 6, true), [1, 2, 3]);
  assert.equal(sweptValues(0, 100, 50, true).length, 12);
  assert.equal(sweptValues(0, 100, 1, true).length, 3);
});
