/** What the page and the worker of its session tell each other. */

/** A file of the session, by its path; null: it is gone. */
export type KeptFile = [path: string, bytes: Uint8Array<ArrayBuffer> | null];

/** How a session begins. */
export interface Begin {
  /** A path to open; "": none. */
  open: string;
  seed?: number;
  steps?: number;
  /** The address named it. */
  named?: boolean;
  /** MiB that a growth may take. */
  memory?: number;
}

export type ToWorker =
  | {
      kind: "begin";
      module: WebAssembly.Module;
      library: ArrayBuffer;
      kept: KeptFile[];
      begin: Begin;
      /** ms in which only requests are answered. */
      rests: number;
    }
  | { kind: "ask"; text: string }
  | { kind: "taken" }
  | { kind: "file"; number: number };

/** What the session says comes as texts and as bytes, without more. */
export type FromWorker =
  | string
  | ArrayBuffer
  | { kind: "ready" }
  | { kind: "failed"; why: string }
  | { kind: "heard" }
  | { kind: "kept"; files: KeptFile[] }
  | { kind: "file"; number: number; bytes: Uint8Array<ArrayBuffer> | null }
  /** A file that lies beside the page, by its path from there. */
  | { kind: "beside"; number: number; path: string };
