/** What the page and the worker of its session tell each other. */
import type { Packed } from "./packed.js";

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

/** What a worker needs besides its script. */
export interface Parts {
  module: WebAssembly.Module;
  library: ArrayBuffer;
}

export type PackedParts = Record<keyof Parts, Packed>;

export type ToWorker =
  | {
      kind: "begin";
      /** What is packed is loaded by the worker, which tells it for those that follow. */
      parts: Parts | PackedParts;
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
  /** The script of the worker is there. */
  | { kind: "runs" }
  | ({ kind: "loaded" } & Parts)
  | { kind: "ready" }
  | { kind: "failed"; why: string }
  | { kind: "heard" }
  | { kind: "kept"; files: KeptFile[] }
  | { kind: "file"; number: number; bytes: Uint8Array<ArrayBuffer> | null }
  /** A file that lies beside the page, by its path from there. */
  | { kind: "beside"; number: number; path: string };

/** The session that a page's first script has begun, which the studio takes over. */
export interface Begun {
  script: string;
  worker: Worker;
  /** The files with which it began. */
  kept: KeptFile[];
  /** What it has said since. */
  heard: FromWorker[];
}
