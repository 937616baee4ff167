// The package as its users have it: node npm/tests/package.test.mjs PACKAGE.tgz PROGRAM
//
// It is installed into a project of its own; node, the compiler of TypeScript and Chromium use it there.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { dirname, extname, join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";

const [archive, program] = process.argv.slice(2).map((path) => resolve(path));
const repository = dirname(dirname(dirname(fileURLToPath(import.meta.url))));
const studio = join(repository, "studio");
const project = mkdtempSync(join(tmpdir(), "espalier-npm-"));
const names = ["environments/two-trees.toml", "models/light/competing-tree.l"];
const files = () => Object.fromEntries(names.map((name) => [name, readFileSync(join(repository, name), "utf8")]));
const shoot = "#define RATIO 0.5\nlsystem: 1\nderivation length: 4\naxiom: A(1)\nA(x) --> F(x)[+(30)B]A(x*RATIO)\nendlsystem\n";
let espalier;

before(async () => {
  writeFileSync(join(project, "package.json"), '{ "private": true, "type": "module" }');
  execFileSync("npm", ["install", "--silent", "--offline", "--no-audit", "--no-fund", archive], { cwd: project });
  cpSync(join(studio, "node_modules/three"), join(project, "node_modules/three"), { recursive: true });
  espalier = await import(pathToFileURL(join(project, "node_modules/espalier/node.js")).href);
});

after(() => rmSync(project, { recursive: true, force: true }));

test("a string is text, and columns", () => {
  const string = new espalier.Model(shoot).derive({ steps: 2 });
  assert.equal(String(string), "F(1)[+(30)B]F(0.5)[+(30)B]A(0.25)");
  assert.equal(string.length, 11);
  assert.equal(string.symbol(10), "A");
  assert.deepEqual([...string.parametersOf(10)], [0.25]);
  assert.deepEqual([...string.parameters], [1, 30, 0.5, 30, 0.25]);
  assert.match(String(new espalier.Model(shoot, { RATIO: 0.25 }).derive({ steps: 2 })), /A\(0.0625\)$/);
});

test("a mistake is told with its place", () => {
  const wrong = () => new espalier.World({ "a/wrong.l": "lsystem: 1\naxiom: A(\nendlsystem\n" });
  assert.throws(wrong, (error) => {
    assert.ok(error instanceof espalier.EspalierError);
    assert.match(error.message, /^a\/wrong\.l:2:10: /);
    const [{ file, line, column }] = error.problems;
    assert.deepEqual({ file, line, column }, { file: "a/wrong.l", line: 2, column: 10 });
    return true;
  });
});

test("what cannot be meant is refused before anything grows", () => {
  const { Model, World } = espalier;
  assert.throws(() => new World({ "../a.l": shoot }), /no path below a folder/);
  assert.throws(() => new World({ "/a.l": shoot }), /no path below a folder/);
  assert.throws(() => new World(new Model(shoot), { step: 3 }), /no option 'step'/);
  assert.throws(() => new World(new Model(shoot), { seed: -1 }), /no whole number/);
  assert.throws(() => new World({ "a.l": shoot }, { open: "b.l" }), /no file 'b\.l'/);
  assert.throws(() => new World(new Model(shoot)).mesh({ plant: 1 }), /no plant 1/);
  assert.throws(() => new World(new Model(shoot)).field("light"), /light/);
});

test("the mesh of a stem is closed tubes of its size", () => {
  const world = new espalier.World(new espalier.Model(shoot), { steps: 4 }).grow(9);
  assert.equal(world.step, 4);
  assert.ok(world.ended);
  const { positions, normals, colors, indices, parts } = world.mesh({ sides: 6 });
  assert.equal(positions.length, normals.length);
  assert.equal(positions.length, colors.length);
  assert.ok(indices.every((index) => index < positions.length / 3));
  const heights = positions.filter((_, i) => i % 3 === 1);
  assert.ok(Math.abs(Math.max(...heights) - 1.875) < 0.01);
  assert.equal(parts.reduce((sum, { count }) => sum + count, 0), indices.length);
  assert.equal(world.statistics[0].height, 1.875);
});

test("a scene with light grows as the program grows it", () => {
  const world = new espalier.World(files(), { seed: 5 }).grow(40);
  const run = join(project, "run");
  const options = ["--steps", "40", "--seed", "5", "--output", run, "--quiet"];
  execFileSync(program, ["run", join(repository, names[0]), ...options]);
  const [header, ...rows] = readFileSync(join(run, "statistics.csv"), "utf8").trim().split("\n").map((line) => line.split(","));
  const last = rows.slice(-2).map((row) => Object.fromEntries(header.map((name, i) => [name, row[i]])));
  world.statistics.forEach(({ plant, ...values }, i) => {
    assert.equal(plant, last[i].name);
    for (const [name, value] of Object.entries(values)) assert.equal(value, Number(last[i][name]), name);
  });
  const { values, size, voxel, unit } = world.field("light");
  assert.equal(values.length, size[0] * size[1] * size[2]);
  assert.deepEqual(voxel, [0.5, 0.5, 0.5]);
  assert.equal(unit, "1");
  assert.ok(values.every((value) => value > 0 && value <= 1));
  world.free();
  assert.throws(() => world.grow(), /freed/);
});

test("worlds live side by side, and each has its files", () => {
  const worlds = [0.5, 0.25].map((RATIO) => new espalier.World(new espalier.Model(shoot, { RATIO }), { steps: 2 }));
  for (const world of worlds) world.grow(2);
  assert.deepEqual(worlds.map((world) => String(world.string()).slice(-9)), ["]A(0.25)", "A(0.0625)"].map((text) => text.padStart(9, "B")));
});

test("the types fit an example", () => {
  writeFileSync(
    join(project, "example.ts"),
    `import { EspalierError, Model, World, type Mesh } from "espalier";
const world: World = new World(new Model("", { A: 1 }), { steps: 3, set: { B: "2" } });
const mesh: Mesh = world.grow(2).mesh({ triangles: 100 });
const height: number = Number(world.statistics[0]?.height) + mesh.positions[0]! + world.field("light").values[0]!;
try { world.free(); } catch (error) { if (error instanceof EspalierError) console.log(error.problems[0]?.line, height); }
`,
  );
  const options = ["--noEmit", "--strict", "--target", "es2022", "--module", "nodenext", "--moduleResolution", "nodenext"];
  execFileSync(join(studio, "node_modules/.bin/tsc"), [...options, "--lib", "es2022,dom", "example.ts"], { cwd: project, stdio: "pipe" });
});

test("the examples run in a page and in a worker", async () => {
  const { openBrowser, openPage, shot } = await import("../../studio/tests/browser.mjs");
  const types = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm" };
  const server = createServer(async ({ url }, response) => {
    try {
      const bytes = await readFile(join(project, new URL(url, "http://localhost").pathname));
      response.writeHead(200, { "Content-Type": types[extname(url)] ?? "application/octet-stream" }).end(bytes);
    } catch {
      response.writeHead(url === "/favicon.ico" ? 204 : 404).end();
    }
  });
  await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
  const browser = await openBrowser();
  try {
    const examples = `http://127.0.0.1:${server.address().port}/node_modules/espalier/examples`;
    const tree = await openPage(browser, `${examples}/tree.html`, { viewport: { width: 480, height: 360 } });
    await tree.waitForFunction(() => document.body.dataset.step === "100");
    await shot(tree, "npm-tree");
    assert.deepEqual(tree.problems, []);
    const worker = await openPage(browser, `${examples}/worker.html`);
    await worker.waitForFunction(() => document.body.dataset.step === "40");
    assert.match(await worker.locator("#told").textContent(), /step 40 of 40: left \d+\.\d m, right \d+\.\d m; \d+ triangles/);
    assert.deepEqual(worker.problems, []);
  } finally {
    await browser.close();
    server.close();
  }
});
