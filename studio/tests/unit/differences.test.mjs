import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { columnBetween, differencesBetween, fieldBetween } = await load("differences.ts");

test("a column is compared module by module, and its range has both signs", () => {
  const before = { name: "age", values: new Float32Array([1, 2, 3, NaN]) };
  const now = { name: "age", values: new Float32Array([1, 4.5, 2, 1]) };
  const { values, lowest, highest } = columnBetween(before, now);
  assert.deepEqual([...values], [0, 2.5, -1, NaN]);
  assert.deepEqual([lowest, highest], [-2.5, 2.5]);
});

test("a field is compared in its units, although bytes of both have other meanings", () => {
  const before = { lowest: 0, highest: 255, values: new Uint8Array([0, 100, 255]) };
  const now = { lowest: 100, highest: 151, values: new Uint8Array([0, 255, 0]) };
  const { values, lowest, highest } = fieldBetween(before, now);
  assert.deepEqual([lowest, highest], [-155, 155]);
  const told = [...values].map((value) => lowest + (value / 255) * (highest - lowest));
  [100, 51, -155].forEach((wanted, i) => assert.ok(Math.abs(told[i] - wanted) <= 310 / 255, `${told}`));
});

test("what differs between two documents is told by the names of settings", () => {
  const setting = (name, label, text) => ({ name, label, text });
  const before = {
    path: "/a/tree.l",
    name: "tree.l",
    seed: 1,
    steps: 8,
    settings: [setting("ANGLE", "angle: between branches", "30"), setting("RATIO", "", "0.8")],
    texts: [{ path: "/a/tree.l", content: "one" }],
  };
  assert.deepEqual(differencesBetween(before, before), []);
  const now = { ...before, seed: 5, settings: [setting("ANGLE", "angle: between branches", "45"), setting("RATIO", "", "0.8")] };
  assert.deepEqual(differencesBetween(before, now), ["Angle 30 (now 45)", "Seed 1 (now 5)"]);
  assert.deepEqual(differencesBetween(before, { ...before, texts: [{ path: "/a/tree.l", content: "two" }] }), ["another text"]);
  assert.deepEqual(differencesBetween(before, { ...before, path: "/a/bush.l" }), ["tree.l"]);
});
