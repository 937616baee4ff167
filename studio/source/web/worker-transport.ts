/** The session in a worker of this page: nothing is sent anywhere, and nothing needs to be installed. */
import type { Transport, TransportEvents } from "../transport.js";
import { keepFiles, keptFiles } from "./kept.js";
import type { Begin, FromWorker, KeptFile, ToWorker } from "./messages.js";
import { saveOwnFiles } from "./own-files.js";
import { part } from "./parts.js";

export { hasOwnSession } from "./parts.js";

/** A worker that computes hears nothing. One that has not heard these for so long is ended, and another begins. */
const urgent = new Set(["stop", "change", "graph", "points", "view-value", "undo", "redo", "open", "open-text", "export"]);
const patience = 900; // ms

const firstTree = "/library/environments/tree.toml";
/** A page of one growth says its file, its seed and its steps. */
function howToBegin(isFirst: boolean): Begin {
  const { open, seed, steps } = document.documentElement.dataset;
  if (!open) return { open: firstTree, seed: Math.floor(Math.random() * 1000) };
  const begin: Begin = { open, named: isFirst }; // those that follow begin with what is kept
  if (seed) begin.seed = Number(seed);
  if (steps) begin.steps = Number(steps);
  return begin;
}

interface Parts {
  module: WebAssembly.Module;
  library: ArrayBuffer;
  script: string;
}

/** Loaded once: workers that follow begin with them. */
let loaded: Promise<Parts> | null = null;

async function load(): Promise<Parts> {
  const [module, library, script] = await Promise.all([
    part("espalier.wasm.xz").then((bytes) => WebAssembly.compile(bytes)),
    part("library.pack"),
    part("worker.js").then((bytes) => URL.createObjectURL(new Blob([bytes], { type: "text/javascript" }))),
  ]);
  return { module, library, script };
}

const state = "/state/studio.json";
const markOfOpening = `${state}.opening`; // the session opens nothing that ended the one before
const restForChanges = 1500; // ms, in which a page finds the next worker and says again what was not heard

/** The last step that the page was told of. */
let newest = -1;
/** How the next worker begins. */
let next: { files: (kept: KeptFile[]) => KeptFile[]; rests: number } | null = null;

/** The kept state, whose last version grows no further than to a step. */
function held(files: KeptFile[], step: number): KeptFile[] {
  return files.map(([path, bytes]) => {
    if (path !== state || !bytes) return [path, bytes];
    const document = JSON.parse(new TextDecoder().decode(bytes)) as { states: { steps?: number }[] };
    const last = document.states.at(-1);
    if (last) last.steps = step;
    return [path, new TextEncoder().encode(JSON.stringify(document))];
  });
}

export class WorkerTransport implements Transport {
  readonly lost = "A step took too long and was ended. Your texts are kept, and the plant is there again in a moment.";
  private worker: Worker | null = null;
  private ready = false;
  private readonly unheard: string[] = [];
  private saves = 0;
  private begins = 0;
  private readonly files = new Map<number, (bytes: Uint8Array<ArrayBuffer> | null) => void>();


  constructor(private readonly events: TransportEvents) {
    this.begin().catch((error) => events.closed(error instanceof Error ? error.message : String(error)));
  }

  get isOpen(): boolean {
    return this.ready;
  }

  send(text: string): void {
    const name = (JSON.parse(text) as { do: string }).do;
    this.unheard.push(name);
    if (name === "save") this.saves++;
    this.post({ kind: "ask", text });
    if (urgent.has(name)) setTimeout(() => this.endIfDeaf(name), patience);
  }

  async file(number: number): Promise<Blob> {
    const bytes = await new Promise<Uint8Array<ArrayBuffer> | null>((resolve) => {
      this.files.set(number, resolve);
      this.post({ kind: "file", number });
    });
    if (!bytes) throw new Error("There is no such file.");
    return new Blob([bytes]);
  }

  private post(message: ToWorker): void {
    this.worker?.postMessage(message);
  }

  private async begin(): Promise<void> {
    const { module, library, script } = await (loaded ??= load());
    const kept = await keptFiles();
    const begin = howToBegin(this.begins++ === 0);
    this.worker = new Worker(script);
    this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.hear(data);
    this.worker.onerror = (event) => {
      event.preventDefault();
      this.end();
    };
    const { files, rests } = next ?? { files: (all: KeptFile[]) => all, rests: 0 };
    next = null;
    this.post({ kind: "begin", module, library, kept: files(kept), begin, rests });
  }

  private hear(data: FromWorker): void {
    if (typeof data === "string") {
      if (data.startsWith('{"say":"growth"')) newest = (JSON.parse(data) as { step: number }).step;
      this.events.received(data);
    } else if (data instanceof ArrayBuffer) {
      this.events.received(data);
      this.post({ kind: "taken" });
    } else if (data.kind === "ready") {
      this.ready = true;
      this.events.opened();
    } else if (data.kind === "heard") {
      if (this.unheard.shift() === "save") this.saves--;
    } else if (data.kind === "kept") {
      if (this.saves > 0) void saveOwnFiles(data.files);
      keepFiles(data.files);
    } else if (data.kind === "file") {
      this.hand(data.number, data.bytes);
    } else if (data.kind === "beside") {
      void part(data.path).then(
        (bytes) => this.hand(data.number, new Uint8Array(bytes)),
        () => this.hand(data.number, null),
      );
    } else {
      this.end(data.why);
    }
  }

  private hand(number: number, bytes: Uint8Array<ArrayBuffer> | null): void {
    this.files.get(number)?.(bytes);
    this.files.delete(number);
  }

  /** The worker that follows is told again what this one has not heard; where it was to stop, it grows no further. */
  private endIfDeaf(name: string): void {
    if (!this.ready || !this.unheard.includes(name)) return;
    const step = Math.max(0, newest);
    if (this.unheard.includes("stop")) next = { files: (kept) => held(kept, step), rests: 0 };
    else next = { files: (kept) => kept.filter(([path]) => path !== markOfOpening), rests: restForChanges };
    this.end();
  }

  private end(refused: string | null = null): void {
    if (!this.worker) return;
    this.worker.terminate();
    this.worker = null;
    this.ready = false;
    for (const resolve of this.files.values()) resolve(null);
    this.events.closed(refused, next !== null);
  }
}
