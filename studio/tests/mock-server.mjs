// A small stand-in for `espalier studio` that speaks the protocol with a made-up tree: to develop the page without the program.
// node tests/mock-server.mjs [port]
import { createServer } from "node:http";
import { existsSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { WebSocketServer } from "ws";

const dist = join(dirname(fileURLToPath(import.meta.url)), "../dist");
const port = Number(process.argv[2] ?? 8799);
const types = { html: "text/html; charset=utf-8", js: "text/javascript", css: "text/css", svg: "image/svg+xml" };
const policy =
  "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' blob: data:; connect-src 'self' ws:; worker-src blob:";

const text = `/* A ternary tree

   Source: made up. Try: espalier run tree.l --define ANGLE=40 */

#define ANGLE 32      /* angle of branches; 5..80 degrees */
#define RATIO 0.78    /* of lengths; 0.5..0.95 */
#define LEAVES 1      /* leaves at the tips; 0..1 whole */

lsystem: 1
Start: { total = 0; }
derivation length: 8
axiom: A(1, 0.1)
A(l, w) : l > 0.05 { total = total + 1; } --> !(w) F(l)
	[ +(ANGLE) A(l * RATIO, w * 0.7) ] /(120) [ +(ANGLE) A(l * RATIO, w * 0.7) ]
	/(120) A(l * RATIO, w * 0.75)
homomorphism
A(l, w) --> ~l(l)
endlsystem
`;
const func = `fver 1 1
name: growth
samples: 10
flip: off
points: 5
0.000000 0.000000
0.200000 0.100000
0.500000 0.900000
0.800000 1.000000
1.000000 1.000000
`;
const contour = `cver 1 3
name: leaf
points: 6 6
type: cr
samples: 10
1 0 0 1
0.5 0.9 0 1
-0.5 0.7 0 1
-1 0 0 1
-0.5 -0.7 0 1
0.5 -0.9 0 1
`;

const document = {
  say: "document",
  version: 1,
  path: "",
  name: "",
  kind: "model",
  folder: "/home/me",
  texts: [],
  settings: [
    {
      kind: "number",
      name: "ANGLE",
      label: "angle of branches",
      value: 32,
      text: "32",
      default: "32",
      lowest: 5,
      highest: 80,
      whole: false,
      unit: "degrees",
      group: "Form",
      changed: false,
    },
    {
      kind: "number",
      name: "RATIO",
      label: "ratio of lengths",
      value: 0.78,
      text: "0.78",
      default: "0.78",
      lowest: 0.5,
      highest: 0.95,
      whole: false,
      unit: "",
      group: "Form",
      changed: false,
    },
    {
      kind: "number",
      name: "LEAVES",
      label: "leaves at the tips",
      value: 1,
      text: "1",
      default: "1",
      lowest: 0,
      highest: 1,
      whole: true,
      unit: "",
      group: "Organs",
      changed: false,
    },
  ],
  graphs: [
    {
      path: "tree.l",
      components: [
        { name: "camera", type: "camera", line: 1, values: {} },
        { name: "trunk", type: "tree", line: 5, values: { length: "3.5", curve: "0 0.5 1" } },
        { name: "branches", type: "phiball", line: 6, values: {} },
        { name: "twig", type: "tree", line: 7, values: {} },
        { name: "leaf", type: "leaf", line: 8, values: {} },
        { name: "flower", type: "leaf", line: 9, values: {} },
      ],
      links: [
        { from: "camera", to: "trunk", kind: "child" },
        { from: "trunk", to: "branches", kind: "branch" },
        { from: "branches", to: "twig", kind: "child" },
        { from: "twig", to: "twig", kind: "branch" },
        { from: "twig", to: "leaf", kind: "leaf" },
        { from: "branches", to: "flower", kind: "leaf" },
      ],
    },
  ],
  seed: 1,
  steps: 8,
  undo: null,
  redo: null,
};

function setting(name) {
  return document.settings.find((one) => one.name === name).value;
}

function grow(step) {
  const angle = (setting("ANGLE") * Math.PI) / 180;
  const ratio = setting("RATIO");
  const internodes = [];
  const tips = [];
  let random = document.seed * 7919 + 1;
  const jitter = () => ((random = (random * 16807) % 2147483647) / 2147483647 - 0.5) * 0.25;
  const visit = (base, heading, left, length, width, depth) => {
    if (depth >= step) return tips.push({ base, heading, left, length });
    const tip = base.map((value, k) => value + heading[k] * length);
    internodes.push({ base, tip, r0: width, r1: width * 0.75, order: depth });
    for (let k = 0; k < 3; k++) {
      const roll = (k * 2 * Math.PI) / 3 + depth + jitter() * 4;
      const bend = k === 2 ? angle * 0.35 : angle + jitter();
      const up = cross(heading, left);
      const side = left.map((value, i) => value * Math.cos(roll) + up[i] * Math.sin(roll));
      const turned = heading.map((value, i) => value * Math.cos(bend) + side[i] * Math.sin(bend));
      visit(tip, turned, normalize(cross(turned, [0.3, 0.1, 0.9])), length * ratio, width * 0.66, depth + 1);
    }
  };
  visit([0, 0, 0], [0, 1, 0], [1, 0, 0], 1, 0.07, 0);
  return { internodes, tips };
}

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const normalize = (a) => a.map((value) => value / Math.hypot(...a));

function packet(growth, step) {
  const { internodes, tips } = grow(step);
  const lower = [Infinity, Infinity, Infinity];
  const upper = [-Infinity, -Infinity, -Infinity];
  for (const { base, tip } of internodes)
    for (const point of [base, tip])
      for (let k = 0; k < 3; k++) {
        lower[k] = Math.min(lower[k], point[k]);
        upper[k] = Math.max(upper[k], point[k]);
      }
  if (internodes.length === 0) {
    lower.fill(0);
    upper.fill(0);
  }
  const leaves = setting("LEAVES") === 1 && step > 3 ? tips : [];
  const groups = leaves.length > 0 ? 1 : 0;
  const buffer = Buffer.alloc(60 + 4 + internodes.length * 24 + groups * 8 + leaves.length * (48 + 4 + 4));
  let at = buffer.write("ESP1", 0, "latin1");
  const u32 = (value) => (at = buffer.writeUInt32LE(value >>> 0, at));
  const f32 = (value) => (at = buffer.writeFloatLE(value, at));
  const u16 = (value) => (at = buffer.writeUInt16LE(Math.round(Math.min(1, Math.max(0, value)) * 65535), at));
  const u8 = (value) => (at = buffer.writeUInt8(value, at));
  u32(growth);
  at = buffer.writeInt32LE(step, at);
  [1, internodes.length, 0, 0, groups].forEach(u32);
  lower.forEach(f32);
  upper.forEach(f32);
  f32(0.07);
  u32(0);
  internodes.forEach(({ base, tip, r0, r1, order }, index) => {
    for (const point of [base, tip]) for (let k = 0; k < 3; k++) u16((point[k] - lower[k]) / (upper[k] - lower[k] || 1));
    u16(r0 / 0.07);
    u16(r1 / 0.07);
    [122, 96, 68, order].forEach(u8);
    u32(index);
  });
  if (groups) {
    u32(3);
    u32(leaves.length);
    for (const { base, heading, left, length } of leaves) {
      const size = Math.max(0.1, length * 0.8);
      const up = cross(heading, left);
      for (let k = 0; k < 3; k++) [left[k] * size, heading[k] * size, up[k] * size, base[k]].forEach(f32);
    }
    leaves.forEach((_, index) => [70 + (index % 5) * 8, 140 + (index % 7) * 6, 60, 255].forEach(u8));
    leaves.forEach((_, index) => u32(internodes.length + index));
  }
  return buffer;
}

function shapes(growth) {
  const points = [
    [0, 0, 0],
    [-0.25, 0.4, 0.08],
    [0, 0.45, 0],
    [0.25, 0.4, 0.08],
    [0, 1, 0],
  ];
  const triangles = [0, 2, 1, 0, 3, 2, 1, 2, 4, 2, 3, 4];
  const buffer = Buffer.alloc(12 + 16 + points.length * 32 + triangles.length * 4);
  let at = buffer.write("ESS1", 0, "latin1");
  const u32 = (value) => (at = buffer.writeUInt32LE(value, at));
  const f32 = (value) => (at = buffer.writeFloatLE(value, at));
  [growth, 1, 3, 0, points.length, triangles.length].forEach(u32);
  points.flat().forEach(f32);
  points.forEach(() => [0, 0, 1].forEach(f32));
  points.forEach(([x, y]) => [x + 0.5, y].forEach(f32));
  triangles.forEach(u32);
  return buffer;
}

function column(growth, step, name) {
  const count = grow(step).internodes.length;
  const padded = Math.ceil(name.length / 4) * 4;
  const buffer = Buffer.alloc(28 + padded + count * 4);
  let at = buffer.write("ESC1", 0, "latin1");
  at = buffer.writeUInt32LE(growth, at);
  at = buffer.writeInt32LE(step, at);
  at = buffer.writeUInt32LE(count, at);
  at = buffer.writeFloatLE(0, at);
  at = buffer.writeFloatLE(count, at);
  at = buffer.writeUInt32LE(name.length, at);
  buffer.write(name, at, "latin1");
  at += padded;
  for (let i = 0; i < count; i++) at = buffer.writeFloatLE(i % 50 === 7 ? NaN : i, at);
  return buffer;
}

let growth = 0;
let grown = 0;
let timer = 0;
const history = [];
let future = [];
const pages = new Set();
const say = (message) => pages.forEach((page) => page.send(JSON.stringify(message)));
const growthMessage = () => ({
  say: "growth",
  growth,
  version: document.version,
  state: grown < document.steps ? "growing" : "done",
  step: grown,
  last: document.steps,
  modules: grow(grown).internodes.length * 2,
  internodes: grow(grown).internodes.length,
  seconds: 0.12,
  reason: null,
});
const row = (step) => [
  step,
  grow(step).internodes.length,
  grow(step).internodes.length * 2,
  1 - document.settings[1].value ** step,
  step * step,
];
const columns = ["step", "internodes", "modules", "height", "leaf_area"];

function regrow(keep) {
  growth++;
  const target = document.steps;
  grown = keep ? Math.min(grown, target) : 0;
  clearInterval(timer);
  say(growthMessage());
  say({ say: "columns", growth, columns: ["order", "age", "length"] });
  pages.forEach((page) => page.send(shapes(growth)));
  say({ say: "statistics", growth, columns, rows: Array.from({ length: grown + 1 }, (_, step) => row(step)) });
  pages.forEach((page) => page.send(packet(growth, page.look === "last" ? grown : Math.min(page.look, grown))));
  timer = setInterval(() => {
    if (grown >= document.steps) return clearInterval(timer);
    grown++;
    say(growthMessage());
    say({ say: "statistics", growth, columns, rows: [row(grown)] });
    pages.forEach((page) => page.look === "last" && page.send(packet(growth, grown)));
  }, 120);
}

function snapshot() {
  return structuredClone({ texts: document.texts, settings: document.settings, seed: document.seed, steps: document.steps });
}

let open = null;
function change(request) {
  open ??= snapshot();
  document.version++;
  for (const [path, content] of Object.entries(request.texts ?? {})) {
    const file = document.texts.find((one) => one.path === path);
    file.content = content;
    file.changed = true;
  }
  for (const [name, value] of Object.entries(request.settings ?? {})) {
    const one = document.settings.find((setting) => setting.name === name);
    one.text = value ?? one.default;
    one.value = Number(one.text);
    one.changed = one.text !== one.default;
  }
  if (request.seed !== undefined) document.seed = request.seed;
  if (request.steps !== undefined) document.steps = request.steps;
  if (!request.transient) {
    history.push({ label: request.label, state: open });
    future = [];
    open = null;
  }
  document.undo = history.at(-1)?.label ?? null;
  document.redo = future.at(-1)?.label ?? null;
  say(document);
  const wrong = document.texts[0]?.content.split("\n").findIndex((line) => line.includes("wrong"));
  say({
    say: "problems",
    version: document.version,
    problems:
      wrong >= 0
        ? [{ severity: "error", file: "tree.l", line: wrong + 1, column: 1, message: "unknown name wrong", source: "" }]
        : [],
  });
  if (!(wrong >= 0)) regrow(true);
  return { version: document.version };
}

const entry = (folder, name, summary, picture) => ({ path: `${folder}/${name}`, folder, name, summary, picture });
const pictures = ["tree-decurrent", "sdl-fern", "species-aspen", "topiary", "hedge", "light", "sdl-spruce", "pgraph-bush"];
const library = {
  models: ["Oak", "Fern", "Aspen", "Topiary", "Hedge", "Ash", "Spruce", "Bush"].map((name, index) =>
    entry(
      index < 4 ? "trees" : "herbs",
      name,
      "Two constant angles and one constant factor. A tree that forks in each step.",
      index,
    ),
  ),
  scenes: [entry("light", "Two trees", "Two trees that shade each other.", 4)],
  files: [entry("", "tree.l", "My tree", null)],
};

const help = {
  symbols: [
    { name: "F", summary: "a segment", help: "F(length) moves the turtle and draws a segment." },
    { name: "+", summary: "turns left", help: "+(angle)" },
  ],
  keywords: [
    { name: "axiom:", summary: "the first string", help: "axiom: modules" },
    { name: "derivation length:", summary: "number of steps", help: "" },
  ],
  functions: [{ name: "ran", summary: "a random number", help: "ran(x) is uniform between 0 and x." }],
  processes: [],
  stages: [],
  keys: [],
  exporters: [
    { name: "gltf", summary: "glTF 2.0, for viewers and Blender", help: "Options: step" },
    { name: "obj", summary: "Wavefront OBJ", help: "" },
  ],
};

help.components = [
  {
    name: "tree",
    summary: "an axis with branches",
    keys: [
      { name: "length", summary: "of the axis", unit: "m", lowest: 0, highest: 20, standard: 1, kind: "number" },
      { name: "segments", summary: "", unit: "", lowest: 1, highest: 50, standard: 8, kind: "whole" },
      { name: "curve", summary: "bending along the axis", unit: "", lowest: null, highest: null, standard: "0", kind: "list" },
    ],
  },
  { name: "leaf", summary: "a leaf", keys: [] },
  { name: "phiball", summary: "leaves on a ball", keys: [] },
  { name: "camera", summary: "where one looks from", keys: [] },
];
const answers = {
  graph: ({ component, key, text }) => {
    const one = document.graphs[0].components.find(({ name }) => name === component);
    if (text === null) delete one.values[key];
    else one.values[key] = text;
    say(document);
    return { version: 1 };
  },
  hello: (_, page) => {
    setTimeout(() => {
      page.send(JSON.stringify(document));
      if (document.path) {
        page.send(JSON.stringify(growthMessage()));
        page.send(JSON.stringify({ say: "columns", growth, columns: ["order", "age", "length"] }));
        page.send(shapes(growth));
        page.send(
          JSON.stringify({ say: "statistics", growth, columns, rows: Array.from({ length: grown + 1 }, (_, step) => row(step)) }),
        );
      }
    }, 10);
    return { version: "mock" };
  },
  library: () => library,
  help: () => help,
  open: ({ path }) => {
    Object.assign(document, { path, name: "Ternary tree", version: document.version + 1 });
    document.texts = [
      { path: "tree.l", role: "main", content: text, changed: false, language: "cpfg" },
      { path: "growth.func", role: "side", content: func, changed: false, language: "plain" },
      { path: "leaf.con", role: "side", content: contour, changed: false, language: "plain" },
    ];
    grown = 0;
    say(document);
    say({
      say: "message",
      number: 5,
      severity: "warning",
      text: "tree.l, line 12: two productions have the same weight. Give them different ones.",
    });
    setTimeout(() => regrow(false), 10);
    return {};
  },
  "open-text": ({ name, content }) => {
    answers.open({ path: name });
    document.texts[0].content = content;
    return {};
  },
  change,
  undo: () => step(history, future),
  redo: () => step(future, history),
  grow: ({ to }) => {
    document.steps = to;
    regrow(true);
    return {};
  },
  stop: () => (clearInterval(timer), {}),
  look: ({ step, held }, page) => {
    page.look = step;
    const at = step === "last" ? grown : step;
    if (held !== growth && growth > 0 && at <= grown) page.send(packet(growth, at));
    return { step: at };
  },
  frame: ({ step }, page) => (page.send(packet(growth, step)), {}),
  column: ({ step, name }, page) => (page.send(column(growth, step, name)), {}),
  pick: ({ module, step }) => ({
    plant: "tree",
    symbol: "F",
    text: `F(${(0.78 ** 3).toFixed(4)}, 0.02)`,
    identity: 1000 + module,
    order: 2,
    born: Math.max(0, step - 3),
    parent: { identity: 17, symbol: "A", born: 1, module: 0 },
    names: ["length", "width"],
    parameters: [0.4746, 0.02],
    children: 3,
    history: {
      steps: [2, 3, 4, 5, 6],
      parameters: [
        [0.1, 0.01],
        [0.2, 0.012],
        [0.35, 0.015],
        [0.45, 0.018],
        [0.4746, 0.02],
      ],
    },
    places: [{ file: "tree.l", line: 13, column: 1, text: "A(l, w) : l > 0.05 --> !(w) F(l) ..." }],
    siblings: [module + 1, module + 2],
  }),
  save: () => (document.texts.forEach((file) => (file.changed = false)), say(document), { path: "tree.l" }),
  export: ({ format }) => ({ file: { number: 100, name: `tree.${format}`, bytes: 12 } }),
  dismiss: () => ({}),
};

function step(from, to) {
  const entry = from.pop();
  to.push({ label: entry.label, state: snapshot() });
  Object.assign(document, entry.state, {
    version: document.version + 1,
    undo: history.at(-1)?.label ?? null,
    redo: future.at(-1)?.label ?? null,
  });
  say(document);
  regrow(true);
  return { version: document.version };
}

function file(number) {
  const name = pictures[number];
  const path = name && join(dist, "../../docs/pictures", `${name}.png`);
  return path && existsSync(path) ? readFileSync(path) : Buffer.from("mock file");
}

const server = createServer((request, response) => {
  const path = request.url === "/" ? "/index.html" : request.url;
  if (path.startsWith("/file/")) return response.end(file(Number(path.slice(6))));
  const found = join(dist, path);
  if (!existsSync(found)) return response.writeHead(404).end();
  response.writeHead(200, { "content-type": types[path.split(".").pop()], "content-security-policy": policy });
  response.end(readFileSync(found));
});
new WebSocketServer({ server, path: "/socket" }).on("connection", (page) => {
  page.look = "last";
  page.on("message", (data) => {
    const request = JSON.parse(data.toString());
    if (request.do === "hello") pages.add(page);
    const answer = answers[request.do](request, page);
    page.send(JSON.stringify({ reply: request.id, ...answer }));
  });
  page.on("close", () => pages.delete(page));
});
server.listen(port, "127.0.0.1", () => console.log(`http://127.0.0.1:${port}/#token=mock`));
