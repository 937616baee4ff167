/** The text messages of the studio's protocol (docs/studio-protocol.md). */

export interface TextFile {
  path: string;
  role: "main" | "model" | "view" | "side";
  content: string;
  changed: boolean;
  /** Another program has written the file since it was changed here. */
  disputed: boolean;
  language: "cpfg" | "toml" | "pgraph" | "sdl" | "species" | "view" | "map" | "materials" | "plain";
}

export interface Setting {
  name: string;
  label: string;
  kind: "number" | "switch";
  value: number;
  text: string;
  default: string;
  lowest: number | null;
  highest: number | null;
  whole: boolean;
  unit: string;
  group: string;
  changed: boolean;
}

export interface StudioDocument {
  version: number;
  path: string;
  name: string;
  kind: "model" | "scene" | "object" | "run";
  folder: string;
  texts: TextFile[];
  settings: Setting[];
  graphs?: ComponentGraph[];
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
  reason: string;
  /** Their names. */
  plants: string[];
}

export interface FieldName {
  name: string;
  unit: string;
  meaning: string;
}

export interface LibraryEntry {
  path: string;
  /** The heading under which people find it. */
  shelf: string;
  name: string;
  summary: string;
  picture: number | null;
}

export interface Library {
  library: LibraryEntry[];
  files: LibraryEntry[];
}

export interface HelpEntry {
  name: string;
  summary: string;
  help: string;
}

export interface Help {
  symbols: HelpEntry[];
  /** Of languages, by their names. */
  words?: Record<string, HelpEntry[]>;
  functions: HelpEntry[];
  processes: HelpEntry[];
  stages: HelpEntry[];
  recorders?: HelpEntry[];
  keys: HelpEntry[];
  exporters: HelpEntry[];
  components?: ComponentType[];
  view?: ViewSetting[];
}

/** What stands behind a setting of a view file, or behind a letter of its line. */
export interface ViewValue {
  kind: "number" | "whole" | "switch" | "word" | "vector" | "colour" | "file" | "flag" | "letters" | "other";
  help: string;
  /** What holds without it. */
  standard: string;
  unit: string;
  lowest: number | null;
  highest: number | null;
  words: string[];
  letter: string;
}

export interface ViewSetting extends ViewValue {
  /** With its colon. */
  name: string;
  /** What follows it, in words. */
  values: string;
  group: "growth" | "shape" | "picture" | "window";
  letters: ViewValue[];
}

/** How the author of a model looked at it, as its view file says. */
export interface AuthorView {
  towards_eye: [number, number, number];
  twist: number;
  perspective: boolean;
  angle: number;
  towards_light?: [number, number, number];
  background?: [number, number, number];
}

/** A value of a component of a graph. */
export interface ComponentKey {
  name: string;
  summary: string;
  unit: string;
  lowest: number | null;
  highest: number | null;
  standard: string | number | null;
  kind: "number" | "whole" | "list" | "word";
}

export interface ComponentType {
  name: string;
  summary: string;
  keys: ComponentKey[];
}

export interface GraphComponent {
  name: string;
  type: string;
  line: number;
  values: Record<string, string>;
}

export interface GraphLink {
  from: string;
  to: string;
  kind: "child" | "branch" | "leaf";
}

/** A graph of components: a text of the language pgraph that could be read. */
export interface ComponentGraph {
  path: string;
  components: GraphComponent[];
  links: GraphLink[];
}

export type GraphEdit =
  | { edit: "set"; component: string; key: string; text: string | null }
  | { edit: "add"; type: string; name: string; from: string }
  | { edit: "remove"; component: string }
  | ({ edit: "link" | "unlink" } & GraphLink);

export type GraphRequest = GraphEdit & { path: string; label?: string; transient?: boolean };

/** What is missing is not known any more. */
export interface Parent {
  identity: string;
  symbol?: string;
  text?: string;
  born?: number;
  module?: number;
}

export interface Place {
  file: string;
  line: number;
  column: number;
}

/** What is missing is not recorded for this plant. */
export interface Picked {
  plant: string;
  symbol: string;
  text: string;
  names: string[];
  parameters: number[];
  identity?: string;
  born?: number;
  parent?: Parent | null;
  children?: number;
  history?: { steps: number[]; parameters: number[][] };
  places?: Place[];
  siblings?: number[];
}

export interface ChangeRequest {
  texts?: Record<string, string>;
  settings?: Record<string, string | null>;
  seed?: number;
  steps?: number;
  label?: string;
  transient?: boolean;
}

/** A file is told by its content, or named if it is one of the library. */
export interface SharedFile {
  path: string;
  content?: string;
  library?: string;
  digest?: string;
}

export interface SharedModel {
  main: string;
  files: SharedFile[];
  seed: number;
  steps: number;
}

/** What a link would write, and where. */
export interface LinkContents {
  folder: string;
  files: { path: string; bytes: number; library: string | null }[];
}

export interface ExportRequest {
  format: string;
  step: number;
  film: boolean;
  smooth: boolean;
  instances: boolean;
  triangles?: number;
}

/** What each request sends and gets. */
export interface Requests {
  hello: { send: { token: string }; get: { version: string; opened: string } };
  library: { send: object; get: Library };
  help: { send: object; get: Help };
  open: { send: { path: string }; get: object };
  share: { send: object; get: SharedModel };
  "read-link": { send: SharedModel; get: LinkContents };
  "open-text": { send: SharedModel; get: object };
  change: { send: ChangeRequest; get: { version: number } };
  graph: { send: GraphRequest; get: { version: number } };
  undo: { send: object; get: { version: number } };
  redo: { send: object; get: { version: number } };
  grow: { send: { to: number }; get: object };
  stop: { send: object; get: object };
  look: { send: { step: number | "last"; held?: number }; get: { step: number } };
  frame: { send: { growth: number; step: number }; get: object };
  column: { send: { growth: number; step: number; name: string }; get: object };
  pick: { send: { growth: number; step: number; module: number }; get: Picked };
  field: { send: { growth: number; step: number; name: string }; get: object };
  limbs: { send: { skin: null } | { growth: number; step: number; skin: "tubes" | "smooth" }; get: object };
  "new-file": { send: { name: string; content: string }; get: { path: string } };
  save: { send: { path?: string }; get: { path: string; files: string[] } };
  settle: { send: { path: string; take: "disk" | "mine" }; get: { version: number } };
  export: { send: ExportRequest; get: object };
  dismiss: { send: { message: number }; get: object };
}

export type Cell = number | string | null;

export interface Statistics {
  growth: number;
  columns: string[];
  rows: Cell[][];
}

export interface HandedFile {
  number: number;
  name: string;
  bytes: number;
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
  | { say: "textures"; growth: number; files: (number | null)[]; reliefs: (number | null)[] }
  | { say: "view"; growth: number; view: AuthorView | null }
  | { say: "exported"; files: HandedFile[] }
  | { say: "progress"; what: string; done: number };
