/** The session in a worker of this page: nothing is sent anywhere, and nothing needs to be installed. */
import type { Transport, TransportEvents } from "../transport.js";
import { howToBegin } from "./beginning.js";
import { haveRead, keepFiles, keptFiles } from "./kept.js";
import type { FromWorker, KeptFile, Parts, ToWorker } from "./messages.js";
import { saveOwnFiles } from "./own-files.js";
import { packedParts } from "./packed.js";
import { part } from "./parts.js";

export { hasOwnSession } from "./parts.js";

/** A worker that computes hears nothing. One that has not heard these for so long is ended, and another begins. */
const urgent = new Set(["stop", "change", "graph", "points", "view-value", "undo", "redo", "open", "open-text", "export"]);
const patience = 900; // ms

/** Loaded by the first worker: those that follow begin with them. */
let parts: Parts | null = null;
/** Whether the worker that the page's first script has begun is in use, or was. */
let firstIsTaken = false;

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
  private tookFirst = false;
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
    const begun = await window.espalierBegun;
    if (!begun) throw new Error("The page has no session.");
    if (!firstIsTaken) {
      firstIsTaken = true;
      haveRead(begun.kept);
      this.use(begun.worker);
      for (const data of begun.heard) this.hear(data);
      return;
    }
    const kept = await keptFiles();
    const { files, rests } = next ?? { files: (all: KeptFile[]) => all, rests: 0 };
    next = null;
    this.use(new Worker(begun.script));
    this.post({ kind: "begin", parts: parts ?? packedParts(), kept: files(kept), begin: howToBegin(false), rests });
  }

  private use(worker: Worker): void {
    this.worker = worker;
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.hear(data);
    worker.onerror = (event) => {
      event.preventDefault();
      this.end();
    };
  }

  private hear(data: FromWorker): void {
    if (typeof data === "string") {
      if (data.startsWith('{"say":"growth"')) newest = (JSON.parse(data) as { step: number }).step;
      this.events.received(data);
    } else if (data instanceof ArrayBuffer) {
      this.events.received(data);
      this.take();
    } else if (data.kind === "loaded") {
      parts = data;
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
    } else if (data.kind === "failed") {
      this.end(data.why);
    }
  }

  /** The first plant is drawn before the worker grows on. */
  private take(): void {
    const { worker } = this;
    const tell = () => worker?.postMessage({ kind: "taken" } satisfies ToWorker);
    if (this.tookFirst || document.hidden) tell();
    else requestAnimationFrame(() => setTimeout(tell));
    this.tookFirst = true;
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
