// Binary messages, laid out by hand as docs/developer/studio-protocol.md has them.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { drawnModules, readMessage } = await load("view/packets.ts");

/** A message of numbers: [kind, value] with the kinds u, i, f for four bytes, b for one and t for text. */
function message(letters, parts) {
  const bytes = [...Buffer.from(letters, "latin1")];
  for (const [kind, value] of parts) {
    const four = Buffer.alloc(4);
    if (kind === "u") four.writeUInt32LE(value);
    if (kind === "i") four.writeInt32LE(value);
    if (kind === "f") four.writeFloatLE(value);
    if (kind === "b") bytes.push(value);
    else if (kind === "t") bytes.push(...Buffer.from(value));
    else bytes.push(...four);
  }
  return new Uint8Array(bytes).buffer;
}

const column = [["u", 7], ["i", 3], ["u", 2], ["f", 0.5], ["f", 1.5], ["u", 3], ["t", "age\0"], ["f", 0.5], ["f", 1.5]];

test("a column has a name, bounds and a number for each module", () => {
  const read = readMessage(message("ESC1", column));
  assert.deepEqual([read.kind, read.growth, read.step, read.name], ["column", 7, 3, "age"]);
  assert.deepEqual([read.lowest, read.highest, [...read.values]], [0.5, 1.5, [0.5, 1.5]]);
});

test("a packet tells its plants, its box, its triangles and its labels", () => {
  const head = [["u", 2], ["i", -1], ["u", 1], ["u", 0], ["u", 3], ["u", 3], ["u", 0]];
  const box = [0, 0, 0, 1, 2, 3, 0.25].map((value) => ["f", value]);
  const corners = [0, 0, 0, 1, 0, 0, 0, 1, 0].map((value) => ["f", value]);
  const bytes = Array.from({ length: 24 }, (_, i) => ["b", i]);
  const rest = [5, 5, 5, 0, 1, 2].map((value) => ["u", value]);
  const label = [["u", 0], ["u", 1], ["u", 0], ["f", 1], ["f", 2], ["f", 3], ["b", 9], ["b", 8], ["b", 7], ["b", 255], ["u", 4], ["u", 2], ["t", "hi\0\0"]];
  const read = readMessage(message("ESP1", [...head, ...box, ["u", 6], ...corners, ...bytes, ...rest, ...label]));
  assert.deepEqual([read.growth, read.step, [...read.plants]], [2, -1, [6]]);
  assert.deepEqual([read.upper, read.radius], [[1, 2, 3], 0.25]);
  assert.deepEqual([...read.indices], [0, 1, 2]);
  assert.deepEqual(read.ranges, [{ texture: 0, first: 0, count: 3 }]);
  assert.deepEqual(read.labels, [{ position: [1, 2, 3], colour: [9, 8, 7], module: 4, text: "hi" }]);
});

test("a message that is cut anywhere, or begins with other letters, is refused", () => {
  const whole = message("ESC1", column);
  for (let length = 4; length < whole.byteLength; length++) assert.throws(() => readMessage(whole.slice(0, length)));
  assert.throws(() => readMessage(message("ESX9", [])), /ESX9/);
});

test("modules that are drawn are listed once, along the string", () => {
  const internode = (module) => [0, 0, 0, 0, 0, module];
  const packet = {
    internodeCount: 3,
    internodes: new Uint32Array([...internode(9), ...internode(2), ...internode(2)]),
    modules: new Uint32Array([11, 11, 11]),
    groups: [{ modules: new Uint32Array([4, 100]) }],
  };
  assert.deepEqual([...drawnModules(packet)], [2, 4, 9, 11, 100]);
});
