// What the goals of a lesson say of a growth.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { valueOfGoal, isReached } = await load("lesson.ts");

const statistics = {
  growth: 1,
  columns: ["step", "plant", "name", "height"],
  rows: [
    [0, 0, "left", 1],
    [0, 1, "right", 1],
    [1, 0, "left", 2],
    [1, 1, "right", 4],
    [1, 2, "right", null],
  ],
};
const goal = { text: "", column: "height", plant: "", least: null, most: null };

test("a goal's value is the mean over all plants, or over those of a name, at the step", () => {
  assert.equal(valueOfGoal(goal, statistics, 1), 3);
  assert.equal(valueOfGoal(goal, statistics, 0), 1);
  assert.equal(valueOfGoal({ ...goal, plant: "left" }, statistics, 1), 2);
  assert.equal(valueOfGoal({ ...goal, plant: "right" }, statistics, 1), 4);
});

test("what is not known is no value, and reaches nothing", () => {
  assert.equal(valueOfGoal({ ...goal, column: "width" }, statistics, 1), null);
  assert.equal(valueOfGoal({ ...goal, plant: "oak" }, statistics, 1), null);
  assert.equal(valueOfGoal(goal, statistics, 7), null);
  assert.equal(isReached(goal, null), false);
});

test("a goal is reached at its bounds and between them", () => {
  assert.equal(isReached({ ...goal, least: 2 }, 2), true);
  assert.equal(isReached({ ...goal, least: 2 }, 1.9), false);
  assert.equal(isReached({ ...goal, least: 2, most: 3 }, 3), true);
  assert.equal(isReached({ ...goal, least: 2, most: 3 }, 3.1), false);
});
