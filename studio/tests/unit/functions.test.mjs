// The functions of a document in one plane: their lines, which of them show, and where their places lie.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { entriesOf } = await load("side/functions.ts");
const { comparable, extentOf, height, PlaneView, united, width } = await load("side/plane-view.ts");

const curve = (path, name, points, kind = "function") => ({
  path,
  name,
  kind,
  spline: "clamped",
  points: points.map(([x, y]) => ({ x, y, z: 0, times: 1 })),
});

test("each function has a line of its own and its number in its file", () => {
  const curves = [curve("a.fset", "ONE", []), curve("a.fset", "", []), ...Array.from({ length: 16 }, (_, i) => curve(`${i}.func`, "f", []))];
  const entries = entriesOf(curves);
  assert.deepEqual(entries.slice(0, 3).map(({ name, number }) => [name, number]), [["ONE", 0], ["function 2", 1], ["f", 0]]);
  assert.equal(new Set(entries.map(({ line }) => line)).size, 18);
});

test("an extent holds zero, and of a function the x from 0 to 1 or what goes beyond", () => {
  assert.deepEqual(extentOf(curve("a", "a", [[0, 20], [1, 95]])), { x: [0, 1], y: [0, 95] });
  assert.deepEqual(extentOf(curve("a", "a", [[-1, -2], [3, -1]])), { x: [-1, 3], y: [-2, 0] });
  assert.deepEqual(extentOf(curve("a", "a", [[2, 1], [3, 4]], "contour")), { x: [0, 3], y: [0, 4] });
});

test("functions of like ranges show together", () => {
  const upTo = (y) => ({ x: [0, 1], y: [0, y] });
  assert.ok(comparable(upTo(1), upTo(1.2)) && comparable(upTo(4), upTo(1)) && comparable(upTo(0), upTo(0)));
  assert.ok(!comparable(upTo(1), upTo(95)) && !comparable(upTo(95), upTo(1)) && !comparable(upTo(1), upTo(0)));
  assert.ok(!comparable(upTo(1), { x: [0, 1], y: [-9, 0] }));
});

test("a place of the plane is found again under the pointer, and all that shows lies within the axes", () => {
  const picture = { getBoundingClientRect: () => ({ left: 40, top: 7, width: 2 * width, height: 2 * height }) };
  for (const even of [false, true]) {
    const extent = united([{ x: [0, 1], y: [0, 0.42] }, { x: [-0.5, 1], y: [-3, 0] }]);
    const view = new PlaneView(extent, even);
    for (const [x, y] of [[-0.5, -3], [0, 0], [1, 0.42]]) {
      const [px, py] = view.toPicture(x, y);
      assert.ok(px >= view.left && px <= width && py >= 0 && py <= height - 20, `${x}, ${y}: ${px}, ${py}`);
      const [backX, backY] = view.fromPicture(picture, { clientX: 40 + 2 * px, clientY: 7 + 2 * py });
      assert.ok(Math.abs(backX - x) < 1e-9 && Math.abs(backY - y) < 1e-9);
    }
    const [[ax, ay], [bx, by]] = [view.toPicture(0, 0), view.toPicture(0.3, 0.3)];
    assert.equal(Math.abs(bx - ax - (ay - by)) < 1e-9, even);
  }
  // An arrow goes a twentieth of the way between two ticks.
  assert.deepEqual(new PlaneView({ x: [0, 1], y: [0, 95] }, false).steps, [0.01, 1]);
});
