/** The text messages of the studio's protocol. `./dev protocol` makes this file from the declarations in
 *  src/studio: do not edit it. */

/** A cell of a table. */
export type Cell = number | string | null;

/** changes of the document that are made as one. */
export interface ChangeRequest {
  /** contents of texts, by paths. */
  texts?: Record<string, string>;
  /** numbers as texts write them, by names; null: as the file on disk says. */
  settings?: Record<string, string | null>;
  /** null: what the files say. */
  seed?: number | null;
  /** null: what the files say; 0 to 100000000. */
  steps?: number | null;
  /** what undo calls it. */
  label?: string;
  /** the next change replaces it. */
  transient?: boolean;
}

/** the version of the document. */
export interface NewVersion {
  /** version of the document. */
  version: number;
}

/** a column or a field of a step. */
export interface NamedRequest {
  /** number of the growth. */
  growth: number;
  /** a step that has grown; at least 0. */
  step: number;
  /** as `columns` or `fields` tells it. */
  name: string;
}

/** a note. */
export interface DismissRequest {
  /** number of the note. */
  message: number;
}

/** a format and what it is to hold. */
export interface ExportRequest {
  /** name of an exporter. */
  format: string;
  /** null: the last; at least 0. */
  step?: number | null;
  /** every step. */
  film?: boolean;
  /** limbs with one skin. */
  smooth?: boolean;
  /** organs that look alike are one shape. */
  instances?: boolean;
  /** at most so many; at least 1. */
  triangles?: number;
}

/** the settings that are sought. */
export interface FitRequest {
  /** one at least. */
  settings: SoughtSetting[];
  /** comparisons over the whole ranges; without it 50 for each setting; 1 to 1000000. */
  search?: number;
}

/** a setting that is sought. */
export interface SoughtSetting {
  /** of a number. */
  name: string;
  /** that it may be. */
  lowest: number;
  /** that it may be. */
  highest: number;
}

/** a file of what was measured. */
export interface ForgetRequest {
  /** as `measured` tells it. */
  number: number;
}

/** a step of a growth. */
export interface StepRequest {
  /** number of the growth. */
  growth: number;
  /** a step that has grown; at least 0. */
  step: number;
}

/** how far it has grown. */
export interface NewestStep {
  /** the last step that can be shown; -1: none; at least -1. */
  step: number;
}

/** an edit of a graph of components. */
export interface GraphRequest {
  /** path of its text. */
  path: string;
  /** `set` with `component`, `key`, `text`; `add` with `type`, `name`, `from`; `remove` with `component`; `link` and `unlink` with `from`, `to`, `kind`. */
  edit: "set" | "add" | "remove" | "link" | "unlink";
  /** name of a component. */
  component?: string;
  /** name of a key of its type. */
  key?: string;
  /** the value as the file writes it; null takes it out. */
  text?: string | null;
  /** type of the new component. */
  type?: string;
  /** name of the new component. */
  name?: string;
  /** component from which the link leads. */
  from?: string;
  /** component to which the link leads. */
  to?: string;
  /** kind of the link. */
  kind?: "child" | "branch" | "leaf";
  /** what undo calls it. */
  label?: string;
  /** the next change replaces it. */
  transient?: boolean;
}

/** a step to grow to. */
export interface GrowRequest {
  /** a step; 0 to 100000000. */
  to: number;
}

/** a page and its token. */
export interface HelloRequest {
  /** of the studio's address; another one ends the connection. */
  token?: string;
}

/** who answers. */
export interface Greeting {
  /** of the program. */
  version: string;
  /** path of the document; empty: nothing is open. */
  opened: string;
  /** it can fit what is open to what was measured. */
  fits: boolean;
}

/** what the manual says of the parts of the program. */
export interface Help {
  /** symbols of the turtle. */
  symbols: HelpEntry[];
  /** functions of expressions. */
  functions: HelpEntry[];
  /** environment processes. */
  processes: HelpEntry[];
  /** geometry stages. */
  stages: HelpEntry[];
  /** recorders of runs. */
  recorders: HelpEntry[];
  /** notations of models. */
  notations: HelpEntry[];
  /** formats of exports. */
  exporters: HelpEntry[];
  /** the tables of a scene file. */
  keys: HelpEntry[];
  /** types of components of graphs. */
  components: ComponentType[];
  /** words of the languages `cpfg`, `sdl` and `species`, by name. */
  words: Record<string, HelpEntry[]>;
  /** settings of view files. */
  view: ViewSetting[];
}

/** a name and what the manual says of it. */
export interface HelpEntry {
  /** as texts write it. */
  name: string;
  /** one phrase; may be empty. */
  summary: string;
  /** more; may be empty. */
  help: string;
}

/** a type of components. */
export interface ComponentType {
  /** as files write it. */
  name: string;
  /** what it is. */
  summary: string;
  /** in the order of the manual. */
  keys: ComponentKey[];
}

/** a value that components of a type have. */
export interface ComponentKey {
  /** as files write it. */
  name: string;
  /** what it is. */
  summary: string;
  /** empty for a pure number. */
  unit: string;
  /** null if there is no bound. */
  lowest: number | null;
  /** null if there is no bound. */
  highest: number | null;
  /** what holds without it, as a file would say it. */
  standard: string;
  /** `number` also stands for a range. */
  kind: "number" | "whole" | "list" | "word";
}

/** a setting of view files. */
export interface ViewSetting {
  /** a vector has three numbers, a colour three from 0 to 1, a switch is on or off, a flag is a letter alone. */
  kind: "number" | "whole" | "switch" | "word" | "vector" | "colour" | "file" | "flag" | "letters" | "other";
  /** one phrase. */
  help: string;
  /** what holds without it; may be empty. */
  standard: string;
  /** empty for a pure number. */
  unit: string;
  /** null if there is no bound. */
  lowest: number | null;
  /** null if there is no bound. */
  highest: number | null;
  /** of kind `word`: what it can be. */
  words: string[];
  /** that stands before it; may be empty. */
  letter: string;
  /** with its colon. */
  name: string;
  /** what follows it, in words. */
  values: string;
  /** `window`: without meaning outside a window. */
  group: "growth" | "shape" | "picture" | "window";
  /** values of a line of letters. */
  letters: ViewValue[];
}

/** what stands behind a setting, or behind a letter of its line. */
export interface ViewValue {
  /** a vector has three numbers, a colour three from 0 to 1, a switch is on or off, a flag is a letter alone. */
  kind: "number" | "whole" | "switch" | "word" | "vector" | "colour" | "file" | "flag" | "letters" | "other";
  /** one phrase. */
  help: string;
  /** what holds without it; may be empty. */
  standard: string;
  /** empty for a pure number. */
  unit: string;
  /** null if there is no bound. */
  lowest: number | null;
  /** null if there is no bound. */
  highest: number | null;
  /** of kind `word`: what it can be. */
  words: string[];
  /** that stands before it; may be empty. */
  letter: string;
}

/** what can be opened. */
export interface Library {
  /** what comes with the program, in the order of the shelves. */
  library: LibraryEntry[];
  /** what lies in the opened folder. */
  files: LibraryEntry[];
}

/** a model, a scene or a run that can be opened. */
export interface LibraryEntry {
  /** absolute path. */
  path: string;
  /** heading under which people find it. */
  shelf: string;
  /** for people. */
  name: string;
  /** first line of its text. */
  summary: string;
  /** number for `/file/`; null: none. */
  picture: number | null;
}

/** limbs as pictures have them. */
export interface LimbsRequest {
  /** null stops what was asked for before. */
  skin: "tubes" | "smooth" | null;
  /** number of the growth. */
  growth?: number;
  /** a step that has been drawn; at least 0. */
  step?: number;
}

/** a step that a page looks at. */
export interface LookRequest {
  /** null: the last; at least 0. */
  step: number | null;
  /** the growth whose packet of this step the page has. */
  held?: number | null;
}

/** a file of what was measured. */
export interface MeasureRequest {
  /** of the file; without `content`, its place below the opened folder. */
  name: string;
  /** its bytes in base64. */
  content?: string;
}

/** a side file. */
export interface NewFileRequest {
  /** of a model, a scene or a side file, without hidden parts. */
  name: string;
  /** its text, or its bytes in base64 if it is a colour map or materials. */
  content: string;
}

/** where it stands. */
export interface NewFile {
  /** beside the document. */
  path: string;
}

/** a document. */
export interface OpenRequest {
  /** of the library, or below the opened folder. */
  path: string;
}

/** what a link holds. */
export interface SharedModel {
  /** path of the file to open. */
  main: string;
  /** the document and what it reads. */
  files: SharedFile[];
  /** instead of what the files say. */
  seed?: number;
  /** instead of what the files say; 0 to 100000000. */
  steps?: number;
}

/** a file of a link, told by its content or named if the library has it. */
export interface SharedFile {
  /** below one folder. */
  path: string;
  /** its text, or its bytes in base64 if it is a colour map or materials. */
  content?: string;
  /** its name in the library. */
  library?: string;
  /** of the library's file, in hexadecimal. */
  digest?: string;
}

/** what a link has written. */
export interface OpenedLink {
  /** version of the document. */
  version: number;
  /** of the document. */
  path: string;
}

/** a module of a step. */
export interface PickRequest {
  /** number of the growth. */
  growth: number;
  /** a step that has grown; at least 0. */
  step: number;
  /** counted through all plants. */
  module: number;
}

/** what is known of a module; what is missing is not recorded. */
export interface Picked {
  /** name of its plant. */
  plant: string;
  /** its letter. */
  symbol: string;
  /** the module with its parameters. */
  text: string;
  /** names of its parameters. */
  names: string[];
  /** values of its parameters. */
  parameters: (number | null)[];
  /** 16 hexadecimal digits. */
  identity?: string;
  /** step of its birth. */
  born?: number;
  /** order of branching, of recorded runs. */
  order?: number;
  /** null for modules of the axiom. */
  parent?: Parent | null;
  /** modules of this step that were born of it. */
  children?: number;
  /** its parameters since its birth. */
  history?: History;
  /** the course of its day, where steps are shorter than a quarter of one. */
  day?: Day;
  /** the productions that may have made it. */
  places?: Place[];
  /** modules of this step that were born with it. */
  siblings?: number[];
}

/** the module that a module was born of. */
export interface Parent {
  /** 16 hexadecimal digits. */
  identity: string;
  /** missing if it was born before the first step that is known. */
  symbol?: string;
  /** with its parameters, before the birth. */
  text?: string;
  /** step of its own birth. */
  born?: number;
  /** its number in this step, if it is still there. */
  module?: number;
}

/** parameters of a module over time. */
export interface History {
  /** at most a hundred since its birth. */
  steps: number[];
  /** a row for each step; null if a value is not known. */
  parameters: ((number | null)[])[];
}

/** what processes know of a module within the day of the step. */
export interface Day {
  /** steps of the day in which there was the module. */
  steps: number[];
  /** since the midnight before, at the end of each step. */
  hours: number[];
  /** what is known, such as leaves.assimilation. */
  names: string[];
  /** of each; empty: none is known. */
  units: string[];
  /** a row for each name, a value for each step; null where there is none. */
  values: ((number | null)[])[];
}

/** a place in a text. */
export interface Place {
  /** path of the text. */
  file: string;
  /** from 1 on. */
  line: number;
  /** from 1 on. */
  column: number;
}

/** other control points of a curve. */
export interface PointsRequest {
  /** path of its text. */
  path: string;
  /** of the curve among those of its text, from 0 on; at least 0. */
  number: number;
  /** all that the curve is to have; a patch has 16. */
  points: CurvePoint[];
  /** what undo calls it. */
  label?: string;
  /** the next change replaces it. */
  transient?: boolean;
}

/** a control point. */
export interface CurvePoint {
  /** coordinate. */
  x: number;
  /** coordinate. */
  y: number;
  /** coordinate; 0 where its file has none. */
  z: number;
  /** how often the point counts: three times make a corner; at least 1. */
  times: number;
}

/** what a link would write, and where. */
export interface LinkContents {
  /** a new one below the opened folder. */
  folder: string;
  /** pages show them and ask. */
  files: LinkedFile[];
}

/** a file that a link would write. */
export interface LinkedFile {
  /** below the folder. */
  path: string;
  /** its size. */
  bytes: number;
  /** its name in the library; null if it is not of it. */
  library: string | null;
}

/** where the document is to be saved. */
export interface SaveRequest {
  /** below the opened folder; without it, the files that have changed are written. */
  path?: string;
}

/** what has been written. */
export interface Saved {
  /** version of the document. */
  version: number;
  /** of the document. */
  path: string;
  /** all that were written. */
  files: string[];
}

/** which text of a disputed file stays. */
export interface SettleRequest {
  /** of a text that is `disputed`. */
  path: string;
  /** that on disk, or the unsaved one. */
  take: "disk" | "mine";
}

/** values of a setting, each of which grows a plant. */
export interface SweepRequest {
  /** of the setting. */
  name: string;
  /** as texts write them; 24 at most. */
  values: string[];
}

/** the growths of a sweep. */
export interface SweptGrowths {
  /** number of the first growth; those of the other values follow. */
  first: number;
}

/** another value for a setting of a view file. */
export interface ViewRequest {
  /** path of its text. */
  path: string;
  /** with its colon. */
  name: string;
  /** of the place among those that say this setting, from 0 on; their count: a new one; at least 0. */
  number: number;
  /** of a line of letters: which one is changed. */
  letter?: string;
  /** words that stand behind it then; null: it is taken out. */
  values: string | null;
  /** what undo calls it. */
  label?: string;
  /** the next change replaces it. */
  transient?: boolean;
}

/** what modules can be coloured by. */
export interface Columns {
  /** number of the growth. */
  growth: number;
  /** names for `column`. */
  columns: string[];
}

/** what is open. */
export interface StudioDocument {
  /** grows with every change, undo and redo. */
  version: number;
  /** absolute path of what is open; empty: nothing is. */
  path: string;
  /** name of its file or folder. */
  name: string;
  /** below which files are written. */
  folder: string;
  /** label of what undo would take back. */
  undo: string | null;
  /** label of what redo would bring back. */
  redo: string | null;
  /** of a `run`, texts and settings are those that it grew from, and a change of them opens that instead. */
  kind?: "model" | "scene" | "object" | "run";
  /** none of a run that does not tell what it grew from. */
  texts: TextFile[];
  /** numbers and switches that the texts write. */
  settings: Setting[];
  /** how the author has laid out the settings; none: in their groups. */
  panels: Panel[];
  /** texts in `pgraph` that can be read. */
  graphs: ComponentGraph[];
  /** control points of side files that can be read, in the order of their texts. */
  curves: PointCurve[];
  /** what view files say, setting after setting. */
  view_entries: ViewEntry[];
  /** that the plants grow with. */
  seed: number;
  /** to which they grow. */
  steps: number;
}

/** a text of the document. */
export interface TextFile {
  /** absolute path of the file. */
  path: string;
  /** what it is to the document. */
  role: "main" | "model" | "view" | "side";
  /** of `map` and `materials`, the content is the bytes of the file in base64. */
  language: "cpfg" | "toml" | "pgraph" | "sdl" | "species" | "view" | "map" | "materials" | "plain";
  /** with unsaved changes. */
  content: string;
  /** it has changes that are not saved. */
  changed: boolean;
  /** another program has written the file meanwhile: it is not saved before `settle`. */
  disputed: boolean;
  /** what the file then holds, if it is a text. */
  disk?: string;
}

/** a number or a switch that a text writes; to change it changes the text. */
export interface Setting {
  /** unique in the document. */
  name: string;
  /** what it is, for people. */
  label: string;
  /** a switch is `true` or `false`. */
  kind: "number" | "switch";
  /** the number. */
  value: number;
  /** as the text writes it. */
  text: string;
  /** as the file on disk writes it. */
  default: string;
  /** null if there is no bound. */
  lowest: number | null;
  /** null if there is no bound. */
  highest: number | null;
  /** it is a whole number. */
  whole: boolean;
  /** empty for a pure number. */
  unit: string;
  /** heading under which it stands. */
  group: string;
  /** it is not as on disk. */
  changed: boolean;
}

/** a group of sliders as the author laid it out. */
export interface Panel {
  /** its heading. */
  title: string;
  /** how many sliders stand side by side where there is room; at least 1. */
  columns: number;
  /** it is open at first. */
  open: boolean;
  /** in the order of the author. */
  sliders: Slider[];
}

/** a setting of a panel; what is null is as the setting has it. */
export interface Slider {
  /** of the setting. */
  name: string;
  /** what it is, for people. */
  label: string | null;
  /** empty for a pure number. */
  unit: string | null;
  /** left end; the number beside may be less. */
  lowest: number | null;
  /** right end; the number beside may be more. */
  highest: number | null;
  /** between two values, from the left end on. */
  step: number | null;
}

/** a text of the language pgraph that can be read. */
export interface ComponentGraph {
  /** path of its text. */
  path: string;
  /** in the order of the text. */
  components: GraphComponent[];
  /** in the order of the text. */
  links: GraphLink[];
}

/** a component of a graph. */
export interface GraphComponent {
  /** unique in the graph. */
  name: string;
  /** name of its type. */
  type: string;
  /** line of its text; null if another file defines it. */
  line: number | null;
  /** what its text says of its keys. */
  values: Record<string, string>;
}

/** a link between components. */
export interface GraphLink {
  /** name of a component. */
  from: string;
  /** name of a component. */
  to: string;
  /** how it is attached. */
  kind: "child" | "branch" | "leaf";
}

/** the control points of a function, a curve or a patch of a surface. */
export interface PointCurve {
  /** path of its text; several may stand in one. */
  path: string;
  /** as the file names it; may be empty. */
  name: string;
  /** x of a `function` grows from 0 to 1; a `patch` has 16 points in rows. */
  kind: "function" | "contour" | "patch";
  /** cubic B-spline, of which `clamped` reaches its ends; `other` is none. */
  spline: "open" | "closed" | "clamped" | "other";
  /** in the order of the text. */
  points: CurvePoint[];
}

/** a place where a view file says a setting. */
export interface ViewEntry {
  /** path of its text. */
  path: string;
  /** with its colon. */
  name: string;
  /** the words behind it, as the text writes them. */
  values: string[];
  /** of a line of letters: the words behind each. */
  letters: Record<string, string[]>;
}

/** the files of an export. */
export interface Exported {
  /** the first names the others, such as materials and textures; none if it failed. */
  files: HandedFile[];
}

/** a file that pages may fetch. */
export interface HandedFile {
  /** for `/file/`. */
  number: number;
  /** as it should be called. */
  name: string;
  /** its size. */
  bytes: number;
}

/** the fields of a growth. */
export interface Fields {
  /** number of the growth. */
  growth: number;
  /** none of a recorded run. */
  fields: FieldName[];
}

/** a field of a process. */
export interface FieldName {
  /** for `field`. */
  name: string;
  /** empty for a pure number. */
  unit: string;
  /** what its numbers are. */
  meaning: string;
}

/** what came of a fit. */
export interface FitEnd {
  /** a note says why it failed. */
  end: "done" | "stopped" | "failed";
  /** empty unless it is done. */
  settings: FittedSetting[];
  /** of the best, beside the values of all files; null: it has none. */
  predicted: (number | null)[];
  /** what cannot be told apart, or is not decided. */
  remarks: string[];
  /** as that of the state. */
  residual: number;
  /** that were grown. */
  worlds: number;
}

/** what a fit tells of a setting. */
export interface FittedSetting {
  /** of the setting. */
  name: string;
  /** the best. */
  value: number;
  /** standard error; null: a small change moves nothing. */
  error: number | null;
  /** by what was measured. */
  decided: boolean;
}

/** how far a fit has come. */
export interface FitState {
  /** comparisons that were made. */
  done: number;
  /** at most so many will be. */
  all: number;
  /** of the best, root mean square in the scales of what was measured. */
  residual: number;
  /** the best values so far, by the names of settings. */
  best: Record<string, number>;
}

/** how far a growth has come. */
export interface Growth {
  /** its number: another number is another growth. */
  growth: number;
  /** version of the document that grows. */
  version: number;
  /** `asks` before it becomes very large, `stopped` by a request, `failed` with a reason. */
  state: "growing" | "asks" | "done" | "stopped" | "failed";
  /** newest step; -1: none so far; at least -1. */
  step: number;
  /** step to which it grows. */
  last: number;
  /** of the newest step. */
  modules: number;
  /** of the newest step. */
  internodes: number;
  /** steps that were derived for it; the others are those of an earlier growth. */
  derived: number;
  /** from its beginning to the newest step. */
  seconds: number;
  /** why it failed, or what it asks. */
  reason: string;
  /** names of its plants. */
  plants: string[];
}

/** what the document is compared with. */
export interface MeasuredFiles {
  /** in the order in which they came. */
  files: MeasuredFile[];
}

/** what a file holds of measured plants. */
export interface MeasuredFile {
  /** to forget it. */
  number: number;
  /** of the file. */
  name: string;
  /** what is compared. */
  values: MeasuredNumber[];
  /** what is not used, what was guessed. */
  notes: string[];
  /** x, y, z one after the other, m, y upwards, the plant's foot at 0; some of many. */
  points: number[];
  /** axes, each as x, y, z one after the other. */
  lines: number[][];
  /** false: only ratios of lengths count. */
  has_scale: boolean;
  /** a growth that was followed. */
  course: MeasuredMoment[];
  /** what `at` of the course is. */
  by: "step" | "time";
}

/** a number that was measured. */
export interface MeasuredNumber {
  /** what was measured. */
  name: string;
  /** in its unit. */
  value: number;
  /** the difference that counts as 1. */
  scale: number;
}

/** a value of a growth that was followed. */
export interface MeasuredMoment {
  /** of the statistics. */
  column: string;
  /** a step or a time. */
  at: number;
  /** in the unit of the column. */
  value: number;
}

/** a note that stays until it is dismissed, or another of its number comes. */
export interface Note {
  /** of the note, to dismiss it. */
  number: number;
  /** how grave it is. */
  severity: "error" | "warning" | "note";
  /** what models print is a note, too. */
  text: string;
}

/** what is wrong with a version of the document. */
export interface Problems {
  /** version of the document. */
  version: number;
  /** in the order in which they were found. */
  problems: Problem[];
}

/** an error or a warning. */
export interface Problem {
  /** how grave it is. */
  severity: "error" | "warning";
  /** path of its text; may be empty. */
  file: string;
  /** from 1 on; 0: not known. */
  line: number;
  /** from 1 on; 0: not known. */
  column: number;
  /** what is wrong and what to do. */
  message: string;
  /** the line of the text. */
  source: string;
}

/** how much of some work is done. */
export interface Progress {
  /** the work, for people. */
  what: string;
  /** 0 to 1; 0 to 1. */
  done: number;
}

/** the light of a step. */
export interface SkyOfStep {
  /** number of the growth. */
  growth: number;
  /** that it falls on; at least 0. */
  step: number;
  /** of the first process of the scene that has a sky. */
  sky: Sky;
}

/** the light of a step, with one sun for all that shine during the step. */
export interface Sky {
  /** unit vector to the sun that brings most light to level ground; null if all light comes from the sky. */
  sun: [number, number, number] | null;
  /** of the sun behind the air: red, green and blue, linear, the largest 1. */
  colour: [number, number, number];
  /** share of the sky in the light on open level ground; 0 to 1. */
  diffuse: number;
  /** PAR there while there is light, umol m-2 s-1; 0: it is dark; at least 0. */
  par: number;
}

/** rows of a table over time. */
export interface Statistics {
  /** number of the growth. */
  growth: number;
  /** the first is `step`; `plants` names the plants. */
  columns: string[];
  /** of columns that have one. */
  units: Record<string, string>;
  /** rows to add; those of a step that is known replace it. */
  rows: Cell[][];
}

/** a plant of a sweep has grown. */
export interface Swept {
  /** its number. */
  growth: number;
  /** why it did not grow; empty otherwise. */
  reason: string;
}

/** pictures that plants wear. */
export interface Textures {
  /** number of the growth. */
  growth: number;
  /** numbers for `/file/` of the colours, PNG or JPEG; null: none. */
  files: (number | null)[];
  /** the same for their normals in tangent space. */
  reliefs: (number | null)[];
}

/** a page knows all that there is. */
export interface AllTold {
  /** the growth that was told; null if nothing grows yet. */
  growth: number | null;
}

/** how a growth was looked at. */
export interface View {
  /** number of the growth. */
  growth: number;
  /** of the first plant with a view file; null if there is none. */
  view: AuthorView | null;
}

/** how the author of a model looked at it, as in run.json. */
export interface AuthorView {
  /** from the point that is looked at. */
  towards_eye: [number, number, number];
  /** turn about the line of sight, degrees. */
  twist: number;
  /** false: a parallel projection. */
  perspective: boolean;
  /** of the field of view, degrees. */
  angle: number;
  /** missing if the view file says nothing of light. */
  towards_light?: [number, number, number];
  /** red, green and blue, 0 to 1. */
  background?: [number, number, number];
}

/** What each request sends and gets. */
export interface Requests {
  /** changes texts, numbers in them, seed or steps. */
  "change": { send: ChangeRequest; get: NewVersion };
  /** sends a number for each module. */
  "column": { send: NamedRequest; get: object };
  /** forgets a note. */
  "dismiss": { send: DismissRequest; get: object };
  /** writes what is open for another program: `progress` follows, then `exported`. */
  "export": { send: ExportRequest; get: object };
  /** sends a field after a step. */
  "field": { send: NamedRequest; get: object };
  /** seeks the settings that grow what was measured: `fitting` follows, then `fitted`. */
  "fit": { send: FitRequest; get: object };
  /** takes a file away from what the document is compared with. */
  "forget-measured": { send: ForgetRequest; get: object };
  /** sends the packet of a step, once it has been drawn. */
  "frame": { send: StepRequest; get: NewestStep };
  /** goes on with a growth whose state is `asks`; later growths of the document do not ask. */
  "go-on": { send: object; get: object };
  /** edits a graph of components; its text follows. */
  "graph": { send: GraphRequest; get: NewVersion };
  /** grows on to a step. */
  "grow": { send: GrowRequest; get: NewVersion };
  /** begins; then comes all that there is to tell, and `told` at its end. */
  "hello": { send: HelloRequest; get: Greeting };
  /** what the manual says. */
  "help": { send: object; get: Help };
  /** what can be opened. */
  "library": { send: object; get: Library };
  /** sends the limbs as pictures have them, after `progress`; what the page asked for before is stopped. */
  "limbs": { send: LimbsRequest; get: object };
  /** looks at a step: its packet follows, now unless the page holds it, and whenever it changes. */
  "look": { send: LookRequest; get: NewestStep };
  /** reads what was measured: `measured` follows, or a note why it cannot be used. */
  "measure": { send: MeasureRequest; get: object };
  /** writes a side file beside the document, which grows anew. */
  "new-file": { send: NewFileRequest; get: NewFile };
  /** starts another document; the old one stays in the history. */
  "open": { send: OpenRequest; get: NewVersion };
  /** opens what a link holds: its files are written to `shared/NAME` below the opened folder, and read nothing but that and the library. */
  "open-text": { send: SharedModel; get: OpenedLink };
  /** what is known of a module. */
  "pick": { send: PickRequest; get: Picked };
  /** moves, adds or takes out control points of a side file; its text follows. */
  "points": { send: PointsRequest; get: NewVersion };
  /** what `open-text` would write where. */
  "read-link": { send: SharedModel; get: LinkContents };
  /** brings back what was taken back. */
  "redo": { send: object; get: NewVersion };
  /** writes the document. Under another `path` the files that it reads come along, to the same places beside it; where those would lead out of the opened folder, it gets a folder of its own, named after it. */
  "save": { send: SaveRequest; get: Saved };
  /** settles which text stays: the unsaved one is dropped, or kept. */
  "settle": { send: SettleRequest; get: NewVersion };
  /** what a link holds: the files lie below one folder; one of the library that has not changed is only named. */
  "share": { send: object; get: SharedModel };
  /** ends the growth after the step at hand, which is dropped if it is not done within 0.4 s. */
  "stop": { send: object; get: object };
  /** ends a fit: `fitted` follows. */
  "stop-fit": { send: object; get: object };
  /** ends the sweep of this page; no more `swept` follows. */
  "stop-sweep": { send: object; get: object };
  /** grows the document with other values of a setting, one after the other: `swept` follows for each. */
  "sweep": { send: SweepRequest; get: SweptGrowths };
  /** takes back one lasting change. */
  "undo": { send: object; get: NewVersion };
  /** changes a setting of a view file; its text follows. */
  "view-value": { send: ViewRequest; get: NewVersion };
}

/** What the server says without being asked. */
export type Said =
  | ({ say: "columns" } & Columns)
  | ({ say: "document" } & StudioDocument)
  | ({ say: "exported" } & Exported)
  | ({ say: "fields" } & Fields)
  | ({ say: "fitted" } & FitEnd)
  | ({ say: "fitting" } & FitState)
  | ({ say: "growth" } & Growth)
  | ({ say: "measured" } & MeasuredFiles)
  | ({ say: "message" } & Note)
  | ({ say: "problems" } & Problems)
  | ({ say: "progress" } & Progress)
  | ({ say: "sky" } & SkyOfStep)
  | ({ say: "statistics" } & Statistics)
  | ({ say: "swept" } & Swept)
  | ({ say: "textures" } & Textures)
  | ({ say: "told" } & AllTold)
  | ({ say: "view" } & View);
