/** Completion and hover from the same help as `espalier list`. */
import type { Completion, CompletionContext, CompletionResult } from "@codemirror/autocomplete";
import { hoverTooltip, type Tooltip } from "@codemirror/view";
import { h } from "../elements.js";
import type { Help, HelpEntry } from "../protocol.js";

type Language = "cpfg" | "toml";

function listsOf(help: Help, language: Language): [Completion["type"], HelpEntry[]][] {
  if (language === "toml")
    return [
      ["property", help.keys],
      ["class", help.processes],
      ["class", help.stages],
    ];
  return [
    ["keyword", help.keywords ?? []],
    ["function", help.functions],
    ["class", help.symbols],
  ];
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
  for (const match of text.matchAll(/^[ \t]*#[ \t]*define[ \t]+(\w+)/gm)) names.add(match[1]);
  for (const match of text.matchAll(/\b([A-Z]\w*)\s*\(/g)) names.add(match[1]);
  return [...names].map((label) => ({ label, type: "variable", boost: 2 }));
}

export function completion(language: Language, help: () => Help | null) {
  return (context: CompletionContext): CompletionResult | null => {
    const word = context.matchBefore(language === "toml" ? /[\w-]+/ : /[@\w]+/);
    if (!word && !context.explicit) return null;
    const options = language === "cpfg" ? ownNames(context.state.doc.toString()) : [];
    const known = help();
    if (known)
      for (const [type, entries] of listsOf(known, language))
        for (const entry of entries)
          options.push({ label: entry.name, type, detail: entry.summary.slice(0, 60), info: () => describe(entry) });
    return { from: word ? word.from : context.pos, options, validFor: /^[@\w-]*$/ };
  };
}

/** The name at a place: a word, a keyword with its colon, or a sign of the turtle. */
function entryAt(
  line: string,
  at: number,
  entries: Map<string, HelpEntry>,
): { entry: HelpEntry; from: number; to: number } | null {
  let best: { entry: HelpEntry; from: number; to: number } | null = null;
  for (const [name, entry] of entries) {
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
      const entries = new Map<string, HelpEntry>();
      for (const [, list] of listsOf(known, language)) for (const entry of list) entries.set(entry.name, entry);
      const line = view.state.doc.lineAt(position);
      const found = entryAt(line.text, position - line.from, entries);
      if (!found) return null;
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
