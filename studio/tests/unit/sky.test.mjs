// The sun of a scene in the dial, and how bright sun and sky are.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { brightness } = await load("view/light.ts");
const { elevation, placeInDial } = await load("sun-dial.ts");

const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-12, `${a} is not ${b}`);

test("the dial shows the sun where it stands for somebody who looks away from the camera", () => {
  // A camera at azimuth 0 stands at z > 0 and looks along -z; x is to its right.
  const ahead = placeInDial([0, Math.SQRT1_2, -Math.SQRT1_2], 0);
  near(ahead.right, 0);
  near(ahead.up, 0.5);
  const right = placeInDial([1, 0, 0], 0);
  near(right.right, 1);
  near(right.up, 0);
  // Turned to x > 0, it has the sun of x behind it.
  const behind = placeInDial([1, 0, 0], Math.PI / 2);
  near(behind.right, 0);
  near(behind.up, -1);
  const zenith = placeInDial([0, 1, 0], 1);
  near(Math.hypot(zenith.right, zenith.up), 0);
  near(elevation([0, 0.5, Math.sqrt(0.75)]), 30);
});

test("sun and sky share the light as in the scene; a covered sky has no sun, and the night little light", () => {
  const white = [1, 1, 1];
  const usual = brightness({ sun: [0.6, 0.8, 0], colour: white, diffuse: 0.43, par: 1000 });
  assert.ok(Math.abs(usual.sun - 1) < 0.01 && Math.abs(usual.sky - 1) < 0.01);
  const hazy = brightness({ sun: [0.6, 0.8, 0], colour: white, diffuse: 0.7, par: 1000 });
  assert.ok(hazy.sun < usual.sun && hazy.sky > usual.sky && hazy.onGround < usual.onGround);
  const covered = brightness({ sun: null, colour: white, diffuse: 1, par: 300 });
  assert.equal(covered.sun, 0);
  const night = brightness({ sun: null, colour: white, diffuse: 1, par: 0 });
  assert.ok(night.sun === 0 && night.sky < 0.5);
});
