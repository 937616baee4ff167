/** Models and worlds. index.d.ts says what each does. */
import createEspalier from "./core.mjs";

/** Of the module; null before start(). */
let core = null;

/** @param {ArrayBuffer | Uint8Array} wasmBinary core.wasm */
export async function start(wasmBinary) {
  core = await createEspalier({ wasmBinary, print: () => undefined, printErr: () => undefined });
}

/** Paths as the caller wrote them. */
function own(text) {
  return text.replaceAll(/\/given\/\d+\//g, "");
}

export class EspalierError extends Error {
  constructor({ error, problems }) {
    super(own(error));
    this.name = "EspalierError";
    this.problems = problems.map(located);
  }
}

function located(problem) {
  return { ...problem, message: own(problem.message), file: own(problem.file) };
}

/** A name that nothing reads is a slip of the pen. */
function refuseUnknown(options, ...known) {
  for (const name of Object.keys(options)) {
    if (!known.includes(name)) throw new TypeError(`there is no option '${name}': ${known.join(", ")}`);
  }
}

function call(name, ...values) {
  const types = values.map((value) => (typeof value === "string" ? "string" : "number"));
  const answer = JSON.parse(core.ccall(`espalier_${name}`, "string", types, values));
  if ("error" in answer) throw new EspalierError(answer);
  return answer;
}

/** A copy: the next call writes over what the module holds. */
function copied(Type, { at, length }, each = 1) {
  const bytes = core.HEAPU8.slice(at, at + length * each * Type.BYTES_PER_ELEMENT);
  return new Type(bytes.buffer);
}

let folders = 0;

/** Writes files into a folder of their own. */
function written(files) {
  const folder = `/given/${++folders}`;
  for (const [name, content] of Object.entries(files)) {
    const parts = name.split("/");
    if (parts.some((part) => part === "" || part === "." || part === "..")) {
      throw new TypeError(`'${name}' is no path below a folder, such as "models/tree.l"`);
    }
    const path = `${folder}/${name}`;
    core.FS.mkdirTree(path.slice(0, path.lastIndexOf("/")));
    core.FS.writeFile(path, content);
  }
  return folder;
}

function removed(folder) {
  for (const name of core.FS.readdir(folder)) {
    if (name === "." || name === "..") continue;
    const path = `${folder}/${name}`;
    if (core.FS.isDir(core.FS.stat(path).mode)) removed(path);
    else core.FS.unlink(path);
  }
  core.FS.rmdir(folder);
}

function asTexts(values) {
  return Object.fromEntries(Object.entries(values).map(([key, value]) => [key, String(value)]));
}

/** What JSON has no room for is refused here, in words. */
function whole(value, name) {
  if (value === undefined) return {};
  if (!Number.isSafeInteger(value) || value < 0) throw new TypeError(`${name} is ${value}, and no whole number from 0 on`);
  return { [name]: value };
}

export class ModuleString {
  #text;

  constructor({ names, letters, offsets, parameters, text }) {
    this.names = names;
    this.letters = copied(Uint16Array, letters);
    this.offsets = copied(Uint32Array, offsets);
    this.parameters = copied(Float64Array, parameters);
    this.#text = text;
  }

  get length() {
    return this.letters.length;
  }

  symbol(index) {
    return this.names[this.letters[index]];
  }

  parametersOf(index) {
    return this.parameters.subarray(this.offsets[index], this.offsets[index + 1]);
  }

  toString() {
    return this.#text;
  }
}

export class Model {
  constructor(text, defines = {}) {
    this.text = text;
    this.defines = { ...defines };
  }

  derive(options = {}) {
    refuseUnknown(options, "steps", "seed");
    const { steps, seed } = options;
    const folder = written({ "model.l": this.text });
    const asked = { open: `${folder}/model.l`, set: asTexts(this.defines), ...whole(steps, "steps"), ...whole(seed, "seed") };
    try {
      return new ModuleString(call("derive", JSON.stringify(asked)));
    } finally {
      removed(folder);
    }
  }
}

let worlds = 0;
/** Worlds that nobody holds any more. */
const forgotten = new FinalizationRegistry(({ number, folder }) => release(number, folder));

function release(number, folder) {
  core.ccall("espalier_free", null, ["number"], [number]);
  removed(folder);
}

export class World {
  #number = ++worlds;
  #folder;
  #state;

  constructor(grows, options = {}) {
    refuseUnknown(options, "open", "seed", "steps", "set", "memory");
    const { open, seed, steps, set = {}, memory } = options;
    const isModel = grows instanceof Model;
    const files = isModel ? { "model.l": grows.text } : grows;
    const names = Object.keys(files);
    const opened = isModel ? "model.l" : (open ?? names.find((name) => name.endsWith(".toml")) ?? names[0]);
    if (!names.includes(opened)) throw new TypeError(`there is no file '${opened}' among ${names.join(", ")}`);
    this.#folder = written(files);
    const asked = {
      open: `${this.#folder}/${opened}`,
      set: asTexts(isModel ? { ...grows.defines, ...set } : set),
      ...whole(seed, "seed"),
      ...whole(steps, "steps"),
      ...whole(memory, "memory"),
    };
    this.printed = "";
    try {
      this.#take(call("world", this.#number, JSON.stringify(asked)));
    } catch (error) {
      removed(this.#folder);
      throw error;
    }
    forgotten.register(this, { number: this.#number, folder: this.#folder }, this);
  }

  #take({ printed = "", ...state }) {
    this.#state = state;
    this.printed += printed;
  }

  get step() {
    return this.#state.step;
  }

  get lastStep() {
    return this.#state.last;
  }

  get ended() {
    return this.#state.ended;
  }

  get modules() {
    return this.#state.modules;
  }

  get plants() {
    return this.#state.plants;
  }

  get fields() {
    return this.#state.fields;
  }

  get warnings() {
    return this.#state.warnings.map(located);
  }

  get statistics() {
    const { plants, columns, rows } = this.#state;
    return rows.map((row, plant) => ({ plant: plants[plant], ...Object.fromEntries(columns.map((name, i) => [name, row[i]])) }));
  }

  grow(steps = 1) {
    for (let i = 0; i < steps && !this.ended; i++) this.#take(call("step", this.#number));
    return this;
  }

  string(plant = 0) {
    return new ModuleString(call("string", this.#number, plant));
  }

  mesh(options = {}) {
    refuseUnknown(options, "plant", "triangles", "sides");
    const { plant, triangles, sides } = options;
    const asked = { ...whole(plant, "plant"), ...whole(triangles, "triangles"), ...whole(sides, "sides") };
    const told = call("mesh", this.#number, JSON.stringify(asked));
    return {
      positions: copied(Float32Array, told.points, 3),
      normals: copied(Float32Array, told.normals, 3),
      uvs: copied(Float32Array, told.uvs, 2),
      colors: copied(Uint8Array, told.rgb, 3),
      indices: copied(Uint32Array, told.triangles, 3),
      parts: told.parts.map(([symbol, of, identity, first, count]) => ({ symbol, plant: of, identity, start: 3 * first, count: 3 * count })),
    };
  }

  field(name) {
    const { values, ...told } = call("field", this.#number, name);
    return { ...told, values: copied(Float32Array, values) };
  }

  free() {
    if (this.#folder === null) return;
    forgotten.unregister(this);
    release(this.#number, this.#folder);
    this.#folder = null;
  }
}
