// Settings of view files in their texts: what is written elsewhere stays.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { byLetter, withValues, without, writtenSettings } = await load("side/view-text.ts");
const scale = { name: "scale factor:", kind: "number" };
const colour = { name: "background color:", kind: "colour" };
const light = { name: "light:", kind: "letters" };
const text = "/* scale factor: 9 */\nscale factor: 2 z buffer: on\nlight: V 1,2,3 A 0.5\nlight: O 0 1 0\nbackground color: 1\n2 3\n";

test("settings are found where they are written, not in comments", () => {
  const [found, ...more] = writtenSettings(text, scale);
  assert.deepEqual([found.values, more.length], [["2"], 0]);
  assert.equal(text.slice(found.from, found.to), "scale factor: 2");
  assert.deepEqual(writtenSettings(text, colour)[0].values, ["1", "2", "3"]);
  assert.equal(writtenSettings(text, light).length, 2);
});

test("the values of a line of letters are known by letter", () => {
  const letters = byLetter(writtenSettings(text, light)[0].values);
  assert.deepEqual([...letters], [["V", ["1", "2", "3"]], ["A", ["0.5"]]]);
});

test("a value is written in its place, or at the end if the text has none", () => {
  const [found] = writtenSettings(text, scale);
  const changed = withValues(text, scale, found, "3.5");
  assert.equal(changed, text.replace("factor: 2 z", "factor: 3.5 z"));
  assert.equal(withValues("line style: pixel", scale, null, "4"), "line style: pixel\nscale factor: 4\n");
});

test("a setting that is taken out takes its line with it if nothing else stands there", () => {
  const [, second] = writtenSettings(text, light);
  assert.equal(without(text, second), text.replace("light: O 0 1 0\n", ""));
  const [found] = writtenSettings(text, scale);
  assert.ok(without(text, found).includes("\nz buffer: on\n"));
});
