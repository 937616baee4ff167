import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { differingLines } = await load("editor/differing-lines.ts");
const told = (disk, mine) => differingLines(disk, mine).map(({ of, number, text }) => `${of} ${number} ${text}`);

test("a line that was changed is told of both texts, the disk's first", () => {
  assert.deepEqual(told("a\nb\nc\n", "a\nB\nc\n"), ["disk 2 b", "mine 2 B"]);
  assert.deepEqual(told("a\nb", "a\nb"), []);
});

test("lines that moved down by others are no difference", () => {
  assert.deepEqual(told("a\nb\nc\nd", "new\na\nb\nX\nd"), ["mine 1 new", "disk 3 c", "mine 4 X"]);
  assert.deepEqual(told("a\nb\nc", "b\nc"), ["disk 1 a"]);
});

test("of texts that are too large to compare, all lines between the first and the last difference are told", () => {
  const many = (first) => [first, ...Array.from({ length: 3000 }, (_, i) => `line ${i}`), "end"].join("\n");
  const large = differingLines(`same\n${many("a")}\nx\nlast`, `same\n${many("b")}\ny\nlast`);
  assert.equal(large.length, 2 * 3003);
  assert.deepEqual([large[0].of, large[0].number, large.at(-1).of, large.at(-1).text], ["disk", 2, "mine", "y"]);
});
