// Numbers along the axes of the editors of side files.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { tickStep, ticksOf, widened } = await load("side/axis.ts");
const texts = (low, high, most) => ticksOf(low, high, most).map(({ text }) => text);

test("ticks stand at one, two or five times a power of ten", () => {
  for (const [high, step] of [
    [1, 0.2],
    [1.2, 0.5],
    [0.42, 0.1],
    [95, 20],
    [5, 1],
    [3e-7, 1e-7],
  ])
    assert.ok(Math.abs(tickStep(0, high, 5) / step - 1) < 1e-12, `${high}: ${tickStep(0, high, 5)}`);
  for (let high = 1e-6; high < 1e6; high *= 1.37) assert.ok(ticksOf(0, high, 5).length <= 6 && ticksOf(0, high, 5).length >= 3, `${high}`);
});

test("ticks have the decimals that tell them apart", () => {
  assert.deepEqual(texts(0, 1, 5), ["0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
  assert.deepEqual(texts(-1, 1, 5), ["-1.0", "-0.5", "0", "0.5", "1.0"]);
  assert.deepEqual(texts(20, 95, 5), ["20", "40", "60", "80"]);
  assert.deepEqual(texts(0.3, 0.7, 4), ["0.3", "0.4", "0.5", "0.6", "0.7"]);
  assert.deepEqual(texts(0, 250000, 5), ["0", "50000", "100000", "150000", "200000", "250000"]);
  assert.deepEqual(texts(0, 2.5e6, 5), ["0", "5e+5", "1.0e+6", "1.5e+6", "2.0e+6", "2.5e+6"]);
  assert.deepEqual(texts(0, 0.0003, 3), ["0", "0.0001", "0.0002", "0.0003"]);
});

test("a range is widened to ticks, and one without extent has one", () => {
  assert.deepEqual(widened(0, 1.2, 5), [0, 1.5]);
  assert.deepEqual(widened(0, 1, 5), [0, 1]);
  assert.deepEqual(widened(-3, 92, 5), [-20, 100]);
  const [low, high] = widened(7, 7, 5);
  assert.ok(low < 7 && high > 7);
});
