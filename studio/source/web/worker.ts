/** The worker that holds a page's session: the module, its files, and turns between two messages. */
import { unpacked } from "../view/index.js";
import { unpackLibrary } from "./library-pack.js";
import type { FromWorker, KeptFile, PackedParts, Parts, ToWorker } from "./messages.js";
import { streamOf, type Packed } from "./packed.js";

interface FileSystem {
  mkdirTree(path: string): void;
  writeFile(path: string, bytes: Uint8Array): void;
  readFile(path: string): Uint8Array<ArrayBuffer>;
  readdir(path: string): string[];
  stat(path: string): { mode: number; size: number; mtime: Date };
  isDir(mode: number): boolean;
  chdir(path: string): void;
}

interface Module {
  FS: FileSystem;
  ccall(name: string, returns: string | null, types: string[], values: unknown[]): unknown;
}

// Made by emscripten, and before this script in the same file.
declare function createEspalier(options: object): Promise<Module>;
declare const self: {
  onmessage: (event: MessageEvent<ToWorker>) => void;
  postMessage(message: FromWorker, transfer?: Transferable[]): void;
};

const tick = 100; // ms
const turns = 20; // ms between two looks for messages
const library = "/library/";
const kept = ["/state", "/home"]; // folders whose files the page keeps

let module: Module | null = null;
let works = false;
let restsTo = 0; // in which time nothing grows
/** Nothing grows on before the page has shown the first plant: it has few processors, and needs them for that. */
let waitsForPage = false;
let pageHasTaken = false;
let known = new Map<string, string>();
const next = new MessageChannel();

function call(name: string, returns: "number" | "string" | null = null, ...values: unknown[]): unknown {
  const types = values.map((value) => (typeof value === "string" ? "string" : "number"));
  return module?.ccall(`espalier_${name}`, returns, types, values);
}

function* filesBelow(files: FileSystem, folder: string): Generator<[path: string, mark: string]> {
  for (const name of files.readdir(folder)) {
    if (name === "." || name === "..") continue;
    const path = `${folder}/${name}`;
    const { mode, size, mtime } = files.stat(path);
    if (files.isDir(mode)) yield* filesBelow(files, path);
    else yield [path, `${size} ${mtime.getTime()}`];
  }
}

/** Tells the page which files have changed. */
function tellKept({ FS }: Module): void {
  const now = new Map(kept.flatMap((folder) => [...filesBelow(FS, folder)]));
  const changed: KeptFile[] = [];
  for (const [path, mark] of now) if (known.get(path) !== mark) changed.push([path, FS.readFile(path).slice()]);
  for (const path of known.keys()) if (!now.has(path)) changed.push([path, null]);
  known = now;
  if (changed.length > 0) self.postMessage({ kind: "kept", files: changed });
}

/** What there is to do, for a moment; then messages are heard. */
function work(): void {
  if (!module) return;
  const end = performance.now() + turns;
  do works = call("turn", "number") === 1 && !waitsForPage;
  while (works && performance.now() < end);
  if (works) next.port2.postMessage(0);
}
next.port1.onmessage = work;

function workOn(): void {
  if (works || waitsForPage || performance.now() < restsTo) return;
  works = true;
  next.port2.postMessage(0);
}

function sent(bytes: ArrayBuffer): void {
  self.postMessage(bytes, [bytes]);
  waitsForPage = !pageHasTaken;
}

function taken(): void {
  call("taken");
  pageHasTaken = true;
  waitsForPage = false;
  workOn();
}

/** Compiled as it comes. */
async function compiled(packed: Packed): Promise<WebAssembly.Module> {
  const { body } = await unpacked(await streamOf(packed));
  return WebAssembly.compileStreaming(new Response(body, { headers: { "Content-Type": "application/wasm" } }));
}

async function bytesOf(packed: Packed): Promise<ArrayBuffer> {
  const bytes = await unpacked(await streamOf(packed));
  return bytes.arrayBuffer();
}

async function load(packed: PackedParts): Promise<Parts> {
  const [module, library] = await Promise.all([compiled(packed.module), bytesOf(packed.library)]);
  self.postMessage({ kind: "loaded", module, library });
  return { module, library };
}

function areLoaded(parts: Parts | PackedParts): parts is Parts {
  return parts.module instanceof WebAssembly.Module;
}

async function begin(message: ToWorker & { kind: "begin" }): Promise<void> {
  const parts = areLoaded(message.parts) ? message.parts : await load(message.parts);
  const made = await createEspalier({
    said: (text: string) => self.postMessage(text),
    sent,
    print: () => undefined,
    printErr: () => undefined,
    instantiateWasm: (imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance) => void) => {
      void WebAssembly.instantiate(parts.module, imports).then(done);
      return {};
    },
  });
  for (const folder of ["/library", "/scratch", ...kept]) made.FS.mkdirTree(folder);
  unpackLibrary(parts.library, (path, bytes) => write(made.FS, library + path, bytes));
  for (const [path, bytes] of message.kept) if (bytes) write(made.FS, path, bytes);
  made.FS.chdir("/library");
  module = made;
  const why = call("begin", "string", JSON.stringify(message.begin)) as string;
  if (why) throw new Error(why);
  setInterval(() => {
    call("tick");
    tellKept(made);
    workOn();
  }, tick);
  tellKept(made);
  restsTo = performance.now() + message.rests;
  self.postMessage({ kind: "ready" });
  workOn();
}

function write(files: FileSystem, path: string, bytes: Uint8Array): void {
  files.mkdirTree(path.slice(0, path.lastIndexOf("/")));
  files.writeFile(path, bytes);
}

function sendFile({ FS }: Module, number: number): void {
  const path = call("file", "string", number) as string;
  const bytes = path ? FS.readFile(path).slice() : null;
  // Pictures of the library are there by their names alone.
  if (bytes?.length === 0 && path.startsWith(library)) self.postMessage({ kind: "beside", number, path: path.slice(library.length) });
  else self.postMessage({ kind: "file", number, bytes });
}

function hear(message: ToWorker): void {
  if (message.kind === "begin") {
    begin(message).catch((error) => self.postMessage({ kind: "failed", why: String(error) }));
    return;
  }
  if (!module) return;
  if (message.kind === "taken") taken();
  else if (message.kind === "file") sendFile(module, message.number);
  else {
    call("receive", null, message.text);
    call("tick"); // what has changed is kept before anything grows
    tellKept(module);
    self.postMessage({ kind: "heard" });
    workOn();
  }
}

self.onmessage = ({ data }) => hear(data);
self.postMessage({ kind: "runs" });
