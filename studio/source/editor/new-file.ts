/** New side files: each begins with something that can be seen, and the view file names it. */
import { openDialog } from "../dialog.js";
import { h } from "../elements.js";
import { panelText } from "../panels.js";
import type { TextFile } from "../protocol.js";
import type { Studio } from "../state.js";
import { toBase64 } from "../view/index.js";

interface Kind {
  title: string;
  hint: string;
  extension: string;
  content: (name: string, studio: Studio) => string;
  /** What names it in the view file, whose text is given; "" if nothing there does. */
  line: (file: string, view: string) => string;
}

/** What new files need of the editor. */
export interface FileHolder {
  show: (path: string) => void;
  replace: (path: string, content: string) => void;
  contentOf: (path: string) => string;
}

/** A blade: narrow at its foot and its tip. */
const controlPoints = [0, 1, 2, 3]
  .map((row) => {
    const width = Math.sin((Math.PI * (row + 0.4)) / 4);
    return [-0.5, -0.17, 0.17, 0.5].map((x) => `${(x * width).toFixed(2)} ${(row / 3).toFixed(2)} 0`).join("  ");
  })
  .join("\n");

function surface(): string {
  return `-0.5 0.5 0 1 -0.1 0.1
CONTACT POINT X: 0 Y: 0 Z: 0
END POINT X: 0 Y: 1 Z: 0
HEADING X: 0 Y: 1 Z: 0
UP X: 0 Y: 0 Z: -1
SIZE: 1
blade
TOP COLOR: 0 DIFFUSE: 0 BOTTOM COLOR: 0 DIFFUSE: 0
AL: ~ A: ~ AR: ~
L: ~ R: ~
BL: ~ B: ~ BR: ~
${controlPoints}
`;
}

/** Grey from dark to light. */
function colours(): string {
  return toBase64(new Uint8Array(768).map((_, i) => Math.floor(i / 3)));
}

/** The first of some names that a text does not use; `most` if it uses all. */
function free(candidates: readonly string[], most: string, used: RegExp, text: string): string {
  const taken = new Set([...text.matchAll(used)].map((match) => match[1]));
  return candidates.find((candidate) => !taken.has(candidate)) ?? most;
}

const numbers = Array.from({ length: 99 }, (_, i) => String(i + 1));
const letters = [..."abcdefghijklmnopqrstuvwxyz"];

const viewFile: Kind = {
  title: "View file",
  hint: "settings of the turtle, light, shapes",
  extension: ".v",
  content: () => "line style: cylinder\n",
  line: () => "",
};

const kinds: Kind[] = [
  viewFile,
  {
    title: "Function",
    hint: "func(number, x) in the model",
    extension: ".func",
    content: (name) => `fver 1 1\nname: ${name}\nsamples: 20\nflip: off\npoints: 4\n0 0\n0.3 0.5\n0.7 0.5\n1 1\n`,
    line: (file) => `function: ${file}`,
  },
  {
    title: "Contour",
    hint: "@#(number): the cross-section of cylinders",
    extension: ".con",
    content: (name) => `cver 1 3\nname: ${name}\npoints: 4 4\ntype: cr\nsamples: 20\n1 0 0 1\n0 1 0 1\n-1 0 0 1\n0 -1 0 1\n`,
    line: (file, view) => `contour: ${free(numbers, "1", /contour:\s*(\d+)/g, view)} ${file}`,
  },
  {
    title: "Surface",
    hint: "~ and its letter: a leaf or petal",
    extension: ".s",
    content: surface,
    line: (file, view) => `surface: ${free(letters, "a", /surface:\s*(\S)/g, view)} ${file} 1`,
  },
  {
    title: "Bark",
    hint: "@Tx(number): a relief on limbs",
    extension: ".bark",
    content: () => "stripes = 10\nwaviness = 0.25\nroughness = 0.04\ndepth = 0.03\ndarkness = 0.55\n",
    line: (file) => `texture: F: ${file}`,
  },
  {
    title: "Panels",
    hint: "the sliders as you lay them out",
    extension: ".panel",
    content: (_, studio) => panelText(studio.document?.settings ?? []),
    line: () => "",
  },
  { title: "Colour map", hint: "colours of ; and ,", extension: ".map", content: colours, line: () => "" },
  {
    title: "Materials",
    hint: "colours that shine or let light through",
    extension: ".mat",
    content: () => toBase64(new Uint8Array([1, 0, 40, 50, 20, 90, 140, 60, 0, 0, 0, 0, 0, 0, 0])),
    line: () => "",
  },
];

/** The entries of the menu; what cannot be used here is left out. */
export function newFileEntries(studio: Studio, holder: FileHolder): { name: string; hint: string; run: () => void }[] {
  const left = new Set([...(viewOf(studio) ? [".v"] : []), ...(takesPanels(studio) ? [] : [".panel"])]);
  return kinds
    .filter(({ extension }) => !left.has(extension))
    .map((kind) => ({ name: kind.title, hint: kind.hint, run: () => ask(studio, holder, kind) }));
}

function viewOf(studio: Studio): TextFile | undefined {
  return studio.document?.texts.find(({ language }) => language === "view");
}

/** A scene has its panels in its own text. */
function takesPanels({ document }: Studio): boolean {
  return document?.kind === "model" && document.settings.length > 0 && !document.texts.some(({ path }) => path.endsWith(".panel"));
}

/** Models read the view file and the panels of their own name, and the colour map of their folder. */
function suggestion(studio: Studio, kind: Kind): string {
  const stem = (studio.document?.name ?? "plant").replace(/\.[^.]*$/, "");
  if (kind.extension === ".v" || kind.extension === ".panel") return stem;
  if (kind.extension === ".map" && studio.document?.kind === "model") return "plants";
  const taken = new Set(studio.document?.texts.map(({ path }) => path.slice(path.lastIndexOf("/") + 1)));
  const word = kind.title.toLowerCase();
  const names = [word, ...numbers.slice(1).map((number) => `${word}-${number}`)];
  return names.find((name) => !taken.has(name + kind.extension)) ?? word;
}

function ask(studio: Studio, holder: FileHolder, kind: Kind): void {
  const field = h("input", "wide", { type: "text", id: "new-file-name", value: suggestion(studio, kind) + kind.extension });
  const form = h(
    "form",
    "form",
    {
      onsubmit: (event) => {
        event.preventDefault();
        dialog.close();
        const name = field.value.trim();
        void make(studio, holder, kind, name.endsWith(kind.extension) ? name : name + kind.extension);
      },
    },
    h("label", "", { for: "new-file-name" }, "Name of the file, beside the model"),
    field,
    h("div", "form-end", {}, h("button", "button primary", { type: "submit" }, "Make the file")),
  );
  const dialog = openDialog(`New: ${kind.title.toLowerCase()}`, form);
  field.focus();
  field.select();
}

async function make(studio: Studio, holder: FileHolder, kind: Kind, file: string): Promise<void> {
  const made = await studio.ask("new-file", { name: file, content: kind.content(file.slice(0, -kind.extension.length), studio) });
  if (!made) return;
  const view = viewOf(studio);
  if (view) {
    const text = holder.contentOf(view.path);
    const line = kind.line(file, text);
    if (line) holder.replace(view.path, `${text}${text === "" || text.endsWith("\n") ? "" : "\n"}${line}\n`);
  } else if (kind.line(file, "")) {
    const name = `${suggestion(studio, viewFile)}.v`;
    await studio.ask("new-file", { name, content: `${viewFile.content(name, studio)}${kind.line(file, "")}\n` });
  }
  explain(studio, kind, file);
  holder.show(made.path);
}

/** Scenes name their files themselves, and no view file names colours. */
function explain(studio: Studio, kind: Kind, file: string): void {
  const inScene = studio.document?.kind === "scene";
  if (kind.extension === ".map" && (inScene || file !== "plants.map"))
    studio.tell("warning", `Write colour_map = "${file}" into the [[plant]] table of a scene: then its colours are used.`);
  else if (kind.extension === ".mat")
    studio.tell("warning", `Write materials = "${file}" into the [[plant]] table of a scene: then its materials are used.`);
  else if (inScene && !viewOf(studio))
    studio.tell("warning", `Write view = "${suggestion(studio, viewFile)}.v" into the [[plant]] table: then the view file is used.`);
}
