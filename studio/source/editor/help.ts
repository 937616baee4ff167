/** Completion and hover from the same help as `espalier list`. */
import type { Completion, CompletionContext, CompletionResult } from "@codemirror/autocomplete";
import { hoverTooltip, type Tooltip } from "@codemirror/view";
import { h } from "../elements.js";
import type { Help, HelpEntry } from "../protocol.js";

export type Language = "cpfg" | "toml" | "pgraph" | "sdl" | "species" | "view";

type Kind = Completion["type"];
interface Offer extends HelpEntry {
  kind: Kind;
}

function offers(kind: Kind, entries: readonly HelpEntry[] | undefined): Offer[] {
  return (entries ?? []).map((entry) => ({ ...entry, kind }));
}

/** The keys of a help text: lines of a name, blanks and what it means, with what stands further in below. */
function keysOf(help: string, part: string): Offer[] {
  const keys: Offer[] = [];
  let column = 0;
  for (const line of help.split("\n")) {
    const [, before, name, gap, summary] = /^(\s*)([a-z][\w-]*)( {2,})(\S.*)$/.exec(line) ?? [];
    const indentation = line.search(/\S/);
    const last = keys.at(-1);
    if (last && column > 0 && indentation >= column - 1) last.help += `\n${line.trim()}`;
    else if (before !== undefined && name && gap && summary) {
      column = before.length + name.length + gap.length;
      keys.push({ name, summary, help: "", kind: "property" });
    } else column = 0;
  }
  for (const key of keys) key.help = `${key.help}\n(${part})`.trim();
  return keys;
}

/** The block of the help of scenes that tells of a table: "[[plant]]" or "[environment.<name>]". */
function tableHelp(scene: string, header: string): string {
  const name = header.replace(/[[\]\s"]/g, "");
  const blocks = scene.split(/\n(?=\s*\[)/);
  const of = (block: string) => (/^\s*\[+([^\]]*)\]/.exec(block)?.[1] ?? "").trim();
  const exact = blocks.find((block) => of(block) === name);
  const wider = blocks.find((block) => of(block).includes("<") && name.startsWith(of(block).replace(/<.*/, "")));
  return (exact ?? wider ?? "").replace(/^\s*\[+[^\]]*\]+[^\n]*/, "");
}

/** What a scene may say at a line: the keys of its table and of the part that the table names. */
function sceneOffers(help: Help, lines: readonly string[], at: number): Offer[] {
  const headerAt = lines.slice(0, at + 1).findLastIndex((line) => /^\s*\[/.test(line));
  const header = (lines[headerAt] ?? "").trim();
  const next = lines.findIndex((line, index) => index > headerAt && /^\s*\[/.test(line));
  const table = lines.slice(Math.max(0, headerAt), next < 0 ? undefined : next).join("\n");
  const parts = offers("class", [...help.processes, ...help.stages, ...(help.recorders ?? [])]);
  const named = /\b(?:process|stage)\s*=\s*"([^"]*)"/.exec(table)?.[1] ?? /timeline\.([\w-]+)/.exec(header)?.[1];
  const own = parts.find(({ name }) => name === named);
  const scene = help.keys.find(({ name }) => name === "scene")?.help ?? "";
  return [...(own ? keysOf(own.help, own.name) : []), ...keysOf(tableHelp(scene, header), header || "scene"), ...parts];
}

/** What a graph may say at a line: further in the keys of the component above, elsewhere the types. */
function graphOffers(help: Help, lines: readonly string[], at: number): Offer[] {
  const types = help.components ?? [];
  const typeLine = lines.slice(0, at).findLast((line) => /^[A-Za-z]/.test(line));
  const type = types.find(({ name }) => typeLine?.startsWith(`${name} `));
  const range = (lowest: number | null, highest: number | null) =>
    lowest === null && highest === null ? "" : `; from ${lowest ?? "any"} to ${highest ?? "any"}`;
  const keys = (/^\s/.test(lines[at] ?? "") ? (type?.keys ?? []) : []).map(({ name, summary, unit, lowest, highest, standard }) => ({
    name,
    summary: unit ? `${summary} (${unit})` : summary,
    help: `${type?.name}: ${standard ?? "nothing"} by default${range(lowest, highest)}`,
    kind: "property",
  }));
  const named = types.map(({ name, summary, keys: own }) => ({
    name,
    summary,
    help: own.map((key) => key.name).join(", "),
    kind: "class",
  }));
  return keys.length > 0 ? keys : named;
}

function offersAt(language: Language, help: Help, lines: readonly string[], at: number): Offer[] {
  if (language === "toml") return sceneOffers(help, lines, at);
  if (language === "pgraph") return [...graphOffers(help, lines, at), ...offers("function", help.functions)];
  if (language === "view")
    return (help.view ?? []).map(({ name, help: summary, values, standard }) => ({
      name,
      summary,
      help: `${values}${standard ? `; ${standard} by default` : ""}`,
      kind: "property",
    }));
  const words = offers("keyword", help.words?.[language]);
  if (language !== "cpfg") return words;
  return [...words, ...offers("function", help.functions), ...offers("class", help.symbols)];
}

function describe(entry: HelpEntry): HTMLElement {
  return h(
    "div",
    "help-tip",
    {},
    h("strong", "", {}, entry.name),
    h("p", "", {}, entry.summary),
    entry.help && entry.help !== entry.summary ? h("pre", "", {}, entry.help) : null,
  );
}

/** The names that the text itself defines. */
function ownNames(text: string): Completion[] {
  const names = new Set<string>();
  for (const match of text.matchAll(/^[ \t]*#[ \t]*define[ \t]+(\w+)/gm)) names.add(match[1] ?? "");
  for (const match of text.matchAll(/\b([A-Z]\w*)\s*\(/g)) names.add(match[1] ?? "");
  return [...names].map((label) => ({ label, type: "variable", boost: 2 }));
}

/** What is typed of a name: names of settings of view files hold blanks. */
const typed: Record<Language, RegExp> = {
  cpfg: /[@\w]+/,
  toml: /[\w-]+/,
  pgraph: /\w+/,
  sdl: /\w+/,
  species: /\w+/,
  view: /(?<=^\s*)[A-Za-z][\w %]*/,
};

export function completion(language: Language, help: () => Help | null) {
  return (context: CompletionContext): CompletionResult | null => {
    const word = context.matchBefore(typed[language]);
    if (!word && !context.explicit) return null;
    const { doc } = context.state;
    const options = language === "cpfg" || language === "pgraph" ? ownNames(doc.toString()) : [];
    const known = help();
    if (known)
      for (const offer of offersAt(language, known, doc.toString().split("\n"), doc.lineAt(context.pos).number - 1))
        options.push({ label: offer.name, type: offer.kind, detail: offer.summary.slice(0, 60), info: () => describe(offer) });
    return { from: word ? word.from : context.pos, options, validFor: language === "view" ? /^[\w %:]*$/ : /^[@\w-]*$/ };
  };
}

/** The name at a place: a word, a keyword with its colon, or a sign of the turtle. */
function entryAt(line: string, at: number, entries: readonly Offer[]): { entry: HelpEntry; from: number; to: number } | null {
  let best: { entry: HelpEntry; from: number; to: number } | null = null;
  for (const entry of entries) {
    const { name } = entry;
    const from = line.lastIndexOf(name, at);
    if (from < 0 || from + name.length <= at) continue;
    const wordy = (text: string | undefined) => text !== undefined && /\w/.test(text);
    const cut = wordy(name.at(-1)) && (wordy(line[from + name.length]) || (wordy(name[0]) && wordy(line[from - 1])));
    if (cut && name.length > 1) continue;
    if (name.length === 1 && wordy(name) && (wordy(line[from - 1]) || wordy(line[from + 1]))) continue;
    if (!best || name.length > best.entry.name.length) best = { entry, from, to: from + name.length };
  }
  return best;
}

export function hoverHelp(language: Language, help: () => Help | null) {
  return hoverTooltip(
    (view, position): Tooltip | null => {
      const known = help();
      if (!known) return null;
      const line = view.state.doc.lineAt(position);
      const entries = offersAt(language, known, view.state.doc.toString().split("\n"), line.number - 1);
      const found = entryAt(line.text, position - line.from, entries);
      if (!found || !(found.entry.summary || found.entry.help)) return null;
      return {
        pos: line.from + found.from,
        end: line.from + found.to,
        above: true,
        create: () => ({ dom: describe(found.entry) }),
      };
    },
    { hoverTime: 350 },
  );
}
