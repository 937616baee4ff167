// How fast 100,000 internodes turn, beside the same number of bare lines drawn by three.js: node tests/speed.mjs [count]
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { openBrowser, openPage } from "./browser.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const count = Number(process.argv[2] ?? 100_000);
const lines = `
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, Scene, WebGLRenderer } from "three";
export { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, Scene, WebGLRenderer };
`;
const bundle = await build({
  stdin: { contents: lines, resolveDir: join(here, "..") },
  bundle: true,
  write: false,
  minify: true,
  format: "iife",
  globalName: "Three",
});
const browser = await openBrowser();
const page = await openPage(browser, "about:blank");
await page.evaluate(
  `${readFileSync(join(here, "../dist/studio.js"), "utf8").split("/*--- studio ---*/")[0]}; window.View = EspalierView;`,
);
await page.evaluate(`${bundle.outputFiles[0].text}; window.Three = Three;`);

const result = await page.evaluate(measure, count);
await browser.close();
const ratio = result.internodes / result.lines;
console.log(`${count} lines of three.js: ${result.lines.toFixed(1)} ms a frame`);
console.log(`${count} internodes: ${result.internodes.toFixed(1)} ms a frame, ${ratio.toFixed(2)} times that of the lines`);
if (process.argv.includes("--check") && ratio > 2) process.exit(1);

function measure(count) {
  const { PlantScene } = window.View;
  const [width, height] = [1000, 640];

  /** A crown of short internodes, as a packet holds them. */
  function internodes() {
    const words = new Uint16Array(count * 12);
    let state = 1;
    const random = () => (state = (state * 16807) % 2147483647) / 2147483647;
    for (let i = 0; i < count; i++) {
      const at = i * 12;
      for (let k = 0; k < 3; k++) {
        const base = random() * 64000;
        words[at + k] = base;
        words[at + 3 + k] = base + (random() - 0.5) * 1500;
      }
      words[at + 6] = words[at + 7] = 65535 * (0.02 + 0.1 * random());
      words[at + 8] = 90 | (80 << 8);
      words[at + 9] = 60;
      words[at + 10] = i & 65535;
      words[at + 11] = i >> 16;
    }
    return words;
  }
  const words = internodes();

  function canvas() {
    const element = document.createElement("canvas");
    element.width = width;
    element.height = height;
    document.body.append(element);
    return element;
  }

  const scene = new PlantScene(canvas());
  scene.resize(width, height);
  scene.show({
    kind: "packet",
    growth: 1,
    step: 1,
    bytes: 0,
    message: new ArrayBuffer(0),
    plants: new Uint32Array(1),
    lower: [0, 0, 0],
    upper: [5, 5, 5],
    radius: 0.06,
    internodeCount: count,
    internodes: new Uint32Array(words.buffer),
    positions: new Float32Array(0),
    normals: new Int8Array(0),
    colours: new Uint8Array(0),
    modules: new Uint32Array(0),
    indices: new Uint32Array(0),
    ranges: [],
    onPicture: null,
    groups: [],
    texturedLimbs: false,
    labels: [],
  });

  const { WebGLRenderer, Scene, BufferGeometry, BufferAttribute, LineSegments, LineBasicMaterial } = window.Three;
  const renderer = new WebGLRenderer({ canvas: canvas(), antialias: false });
  renderer.setSize(width, height, false);
  const ends = new Float32Array(count * 6);
  for (let i = 0; i < count; i++) for (let k = 0; k < 6; k++) ends[i * 6 + k] = (words[i * 12 + k] / 65535) * 5;
  const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(ends, 3));
  const bare = new Scene().add(new LineSegments(geometry, new LineBasicMaterial({ color: 0x224422 })));

  const finish = (gl) => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  // The shortest of many times, taken in turns: other programs of the machine disturb both alike.
  const draws = {
    internodes: () => {
      scene.draw();
      scene.finish();
    },
    lines: () => {
      renderer.render(bare, scene.orbit.camera);
      finish(renderer.getContext());
    },
  };
  const shortest = { internodes: Infinity, lines: Infinity };
  for (let i = 0; i < 50; i++) {
    scene.orbit.turn(0.05, 0);
    for (const [name, draw] of Object.entries(draws)) {
      const start = performance.now();
      draw();
      shortest[name] = Math.min(shortest[name], performance.now() - start);
    }
  }
  return shortest;
}
