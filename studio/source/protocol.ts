/** The text messages of the studio's protocol (docs/studio-protocol.md). */

export interface TextFile {
  path: string;
  role: "main" | "model" | "view" | "side";
  content: string;
  changed: boolean;
  language: "cpfg" | "toml" | "pgraph" | "sdl" | "species" | "plain";
}

export interface Setting {
  name: string;
  label: string;
  value: number | null;
  text: string;
  default: string;
  lowest: number | null;
  highest: number | null;
  whole: boolean;
  unit: string;
  group: string;
  changed: boolean;
  choices: string[] | null;
}

export interface StudioDocument {
  version: number;
  path: string;
  name: string;
  kind: "model" | "scene" | "object";
  folder: string;
  texts: TextFile[];
  settings: Setting[];
  seed: number;
  steps: number;
  undo: string | null;
  redo: string | null;
}

export interface Problem {
  severity: "error" | "warning" | "note";
  file: string;
  line: number;
  column: number;
  message: string;
  source: string;
}

export interface Growth {
  growth: number;
  version: number;
  state: "reading" | "growing" | "done" | "stopped" | "failed";
  step: number;
  last: number;
  modules: number;
  internodes: number;
  seconds: number;
  reason: string | null;
}

export interface FieldName {
  name: string;
  unit: string;
  meaning: string;
}

export interface LibraryEntry {
  path: string;
  folder: string;
  name: string;
  summary: string;
  picture: number | null;
}

export interface Library {
  models: LibraryEntry[];
  scenes: LibraryEntry[];
  files: LibraryEntry[];
}

export interface HelpEntry {
  name: string;
  summary: string;
  help: string;
}

export interface Help {
  symbols: HelpEntry[];
  keywords: HelpEntry[];
  functions: HelpEntry[];
  processes: HelpEntry[];
  stages: HelpEntry[];
  keys: HelpEntry[];
  exporters: HelpEntry[];
}

export interface Parent {
  identity: number;
  symbol: string;
  born: number;
  module?: number | null;
}

export interface Place {
  file: string;
  line: number;
  column: number;
  text: string;
}

export interface Picked {
  plant: string;
  symbol: string;
  text: string;
  identity: number;
  order: number | null;
  born: number;
  parent: Parent | null;
  names: string[];
  parameters: number[];
  children: number | Parent[];
  history: { steps: number[]; parameters: number[][] } | null;
  places: Place[];
  siblings: number[];
}

export interface ChangeRequest {
  texts?: Record<string, string>;
  settings?: Record<string, string | null>;
  seed?: number;
  steps?: number;
  label?: string;
  transient?: boolean;
}

export interface SharedModel {
  name: string;
  content: string;
  settings: Record<string, string>;
  seed: number;
  steps: number;
}

/** What each request sends and gets. */
export interface Requests {
  hello: { send: { token: string }; get: { version: string } };
  library: { send: object; get: Library };
  help: { send: object; get: Help };
  open: { send: { path: string }; get: object };
  "open-text": { send: SharedModel; get: object };
  change: { send: ChangeRequest; get: { version: number } };
  undo: { send: object; get: { version: number } };
  redo: { send: object; get: { version: number } };
  grow: { send: { to: number }; get: object };
  stop: { send: object; get: object };
  look: { send: { step: number | "last"; held?: number }; get: { step: number } };
  frame: { send: { growth: number; step: number }; get: object };
  column: { send: { growth: number; step: number; name: string }; get: object };
  pick: { send: { growth: number; step: number; module: number }; get: Picked };
  field: { send: { growth: number; name: string }; get: object };
  save: { send: { path?: string }; get: { path: string } };
  export: { send: { format: string; options: Record<string, string> }; get: { file: { number: number; name: string; bytes: number } } };
  dismiss: { send: { message: number }; get: object };
}

export interface Statistics {
  growth: number;
  columns: string[];
  rows: number[][];
  plants?: string[];
}

/** What the server says without being asked. */
export type Said =
  | ({ say: "document" } & StudioDocument)
  | { say: "problems"; version: number; problems: Problem[] }
  | ({ say: "growth" } & Growth)
  | ({ say: "statistics" } & Statistics)
  | { say: "columns"; growth: number; columns: string[] }
  | { say: "fields"; growth: number; fields: FieldName[] }
  | { say: "message"; number: number; severity: Problem["severity"]; text: string }
  | { say: "progress"; what: string; done: number };
