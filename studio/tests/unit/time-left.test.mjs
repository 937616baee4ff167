import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { secondsLeft } = await load("time-left.ts");

/** Steps whose modules multiply by a factor; each takes a microsecond a module. */
function grown(steps, factor) {
  const moments = [];
  for (let step = 0, seconds = 0; step <= steps; step++) {
    const modules = Math.round(1000 * factor ** step);
    seconds += modules / 1e6;
    moments.push({ step, seconds, modules });
  }
  return moments;
}

test("of modules that double, the last step takes half of all time", () => {
  const moments = grown(20, 2);
  const wanted = moments[20].seconds - moments[12].seconds;
  const told = secondsLeft(moments.slice(0, 13), 20);
  assert.ok(Math.abs(told / wanted - 1) < 0.01, `${told} instead of ${wanted}`);
});

test("steps that stay as long take as long as those before", () => {
  assert.ok(Math.abs(secondsLeft(grown(10, 1), 30) - 20 * 0.001) < 1e-9);
});

test("what becomes fewer is not taken to vanish, and one moment tells nothing", () => {
  assert.ok(secondsLeft(grown(5, 0.5), 10) > 0);
  assert.equal(secondsLeft(grown(0, 2), 10), null);
  assert.equal(secondsLeft([], 10), null);
});

test("moments that were left out do not matter", () => {
  const moments = grown(20, 1.5);
  const some = moments.filter(({ step }) => step % 3 === 0 && step <= 15);
  const wanted = moments[20].seconds - moments[15].seconds;
  assert.ok(Math.abs(secondsLeft(some, 20) / wanted - 1) < 0.01);
});
