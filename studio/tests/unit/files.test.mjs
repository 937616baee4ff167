// Side files as the page edits them: only the lines of the points change.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { load } from "./load.mjs";

const { readPoints } = await load("side/files.ts");
const models = join(dirname(fileURLToPath(import.meta.url)), "../../../models");
const text = (name) => readFileSync(join(models, name), "utf8");

test("files of the library are read, and written back with the same points", () => {
  for (const name of ["phyllotaxis/gourd.func", "language/shoot/shape.fset", "organs/fluted.con"]) {
    const files = readPoints(name, text(name));
    assert.ok(files.length > 0, name);
    for (const [number, file] of files.entries()) {
      assert.ok(file.points.length >= 3);
      const again = readPoints(name, file.write(file.points))[number];
      assert.equal(JSON.stringify(again.points), JSON.stringify(file.points), name);
      assert.equal(file.write(file.points).split("\n").length, text(name).split("\n").length, name);
    }
  }
});

test("a point that is added changes the count and nothing else of the head", () => {
  const [file] = readPoints("gourd.func", text("phyllotaxis/gourd.func"));
  const more = [...file.points, { x: 1, y: 0.25, z: 0, times: 1 }];
  const [again] = readPoints("gourd.func", file.write(more));
  assert.equal(again.points.length, file.points.length + 1);
  assert.equal(again.name, file.name);
});

test("a file with mistakes has no points", () => {
  assert.deepEqual(readPoints("a.func", "points: 3\n0 0\n1 1\n"), []);
  assert.deepEqual(readPoints("a.func", "points: 2\n0 zero\n1 1\n"), []);
  assert.deepEqual(readPoints("a.con", "cver 1\n"), []);
});
