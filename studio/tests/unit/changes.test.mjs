// What is sent of many changes, with a server that answers when the test says so.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { Changes } = await load("changes.ts");

function desk() {
  const sent = [];
  const connection = {
    state: "open",
    request: (name, fields) => new Promise((resolve, reject) => sent.push({ name, fields, resolve, reject })),
  };
  const listeners = [];
  const told = [];
  const studio = { connection, on: (_, listener) => listeners.push(listener), tell: (_, text) => told.push(text) };
  const turn = () => new Promise((done) => setImmediate(done));
  const answer = () => {
    sent.at(-1).resolve({ version: 1 });
    return turn();
  };
  return { changes: new Changes(studio), sent, connection, listeners, told, turn, answer };
}

test("of a slider that is dragged only the newest value follows the one under way", async () => {
  const { changes, sent, answer } = desk();
  for (const value of ["1", "2", "3"]) changes.transient("LENGTH", { settings: { LENGTH: value } }, "length");
  assert.deepEqual(sent.map(({ fields }) => fields.settings.LENGTH), ["1"]);
  await answer();
  assert.deepEqual(sent.map(({ fields }) => fields.settings.LENGTH), ["1", "3"]);
  assert.equal(sent[1].fields.transient, true);
});

test("a change of something else makes the open one lasting first", async () => {
  const { changes, sent, answer } = desk();
  changes.transient("LENGTH", { settings: { LENGTH: "1" } }, "length");
  changes.transient("ANGLE", { settings: { ANGLE: "9" } }, "angle");
  await answer();
  assert.deepEqual([sent[1].fields.settings, sent[1].fields.transient], [{ LENGTH: "1" }, undefined]);
  await answer();
  assert.deepEqual([sent[2].fields.settings, sent[2].fields.transient], [{ ANGLE: "9" }, true]);
});

test("settled when the server has everything", async () => {
  const { changes, sent, answer } = desk();
  changes.transient("LENGTH", { settings: { LENGTH: "1" } }, "length");
  let done = false;
  const settled = changes.settle().then(() => (done = true));
  await answer();
  assert.equal(done, false);
  assert.equal(sent.length, 2); // the same, lasting
  await answer();
  await settled;
});

test("what was not heard because the connection broke is sent again; what is refused is told", async () => {
  const { changes, sent, connection, listeners, told, turn, answer } = desk();
  changes.lasting("seed", { seed: 7 }, "seed");
  connection.state = "lost";
  sent[0].reject(new Error("lost"));
  await turn();
  connection.state = "open";
  for (const listener of listeners) listener("open");
  assert.deepEqual([sent.length, sent[1].fields.seed], [2, 7]);
  await answer();
  changes.lasting("seed", { seed: -1 }, "seed");
  sent[2].reject(new Error("no whole number"));
  await turn();
  assert.deepEqual(told, ["no whole number"]);
});

test("listeners hear when the server has answered everything, and not before", async () => {
  const { changes, answer } = desk();
  let calls = 0;
  changes.onIdle(() => calls++);
  changes.lasting("seed", { seed: 1 }, "seed");
  changes.points("points 0 of a.func", { path: "a.func", number: 0, points: [] }, true);
  assert.deepEqual([changes.isBusy, calls], [true, 0]);
  await answer();
  assert.deepEqual([changes.isBusy, calls], [true, 0]);
  await answer();
  assert.deepEqual([changes.isBusy, calls], [false, 1]);
});
