// The colours of a film: what browsers decode must be the picture's, so the numbers are those of ITU-R BT.601.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { planesOf } = await load("film.ts");

/** The colour that a decoder shows for these numbers, by the inverse of the standard's matrix. */
function decoded(y, cb, cr) {
  const [luma, blue, red] = [(y - 16) / 219, (cb - 128) / 224, (cr - 128) / 224];
  return [luma + 1.402 * red, luma - 0.344136 * blue - 0.714136 * red, luma + 1.772 * blue].map((v) => Math.round(255 * v));
}

function filled(width, height, colourAt) {
  const pixels = new Uint8ClampedArray(4 * width * height);
  for (let i = 0; i < width * height; i++) pixels.set([...colourAt(i % width, Math.floor(i / width)), 255], 4 * i);
  return pixels;
}

test("a picture of one colour is decoded as that colour, to a rounding", () => {
  for (const colour of [[0, 0, 0], [255, 255, 255], [84, 108, 48], [200, 60, 40], [12, 34, 250]]) {
    const planes = planesOf(filled(4, 2, () => colour), 4, 2);
    assert.equal(planes.length, 12);
    const shown = decoded(planes[5], planes[8], planes[10]);
    shown.forEach((value, k) => assert.ok(Math.abs(value - colour[k]) <= 2, `${colour} is shown as ${shown}`));
  }
});

test("black and white have the ends of the limited range, and no colour", () => {
  const planes = planesOf(filled(2, 2, (x) => (x === 0 ? [0, 0, 0] : [255, 255, 255])), 2, 2);
  assert.deepEqual([...planes], [16, 235, 16, 235, 128, 128]);
});

test("four pixels share the mean of their colours", () => {
  const halves = planesOf(filled(2, 2, (x) => (x === 0 ? [255, 0, 0] : [0, 0, 255])), 2, 2);
  const mixed = planesOf(filled(2, 2, () => [127.5, 0, 127.5]), 2, 2);
  assert.ok(Math.abs(halves[4] - mixed[4]) <= 1 && Math.abs(halves[5] - mixed[5]) <= 1);
});
