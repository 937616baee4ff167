import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { withRows, sameTexts } = await load("tables.ts");

test("rows of steps that are known are replaced", () => {
  const rows = [[0, 1], [1, 2], [2, 3]];
  assert.deepEqual(withRows(rows, [[1, 20], [2, 30], [3, 40]]), [[0, 1], [1, 20], [2, 30], [3, 40]]);
  assert.deepEqual(withRows(rows, []), rows);
});

test("names with commas are not taken for two", () => {
  assert.ok(sameTexts(["a,b", "c"], ["a,b", "c"]));
  assert.ok(!sameTexts(["a,b"], ["a", "b"]));
});
