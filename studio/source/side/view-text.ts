/** Finds the settings of a view file in its text, and writes them without touching the rest. */
import type { ViewSetting } from "../protocol.js";

/** A setting where it is written. */
export interface Written {
  /** The place of its name and of what follows it. */
  from: number;
  valuesFrom: number;
  to: number;
  values: string[];
}

const separators = /[\s,]/;

/** The text with blanks instead of comments and lines of the preprocessor, so that places stay. */
function bare(text: string): string {
  const blank = (part: string) => part.replace(/[^\n]/g, " ");
  return text.replace(/\/\*[\s\S]*?\*\/|\/\/[^\n]*/g, blank).replace(/^[ \t]*#.*$/gm, blank);
}

function countOf(setting: ViewSetting): number {
  if (setting.kind === "vector" || setting.kind === "colour") return 3;
  return setting.kind === "letters" ? Infinity : 1;
}

/** The words behind a name: so many, or those of the line. */
function wordsFrom(text: string, at: number, count: number): { words: string[]; to: number } {
  const words: string[] = [];
  let to = at;
  while (words.length < count) {
    while (at < text.length && separators.test(text.charAt(at)) && (count < Infinity || text[at] !== "\n")) at++;
    if (at >= text.length || (count === Infinity && text[at] === "\n")) break;
    const begin = at;
    while (at < text.length && !separators.test(text.charAt(at))) at++;
    words.push(text.slice(begin, at));
    to = at;
  }
  return { words, to };
}

/** Every place where a setting is written, in their order. */
export function writtenSettings(text: string, setting: ViewSetting): Written[] {
  const plain = bare(text);
  const found: Written[] = [];
  for (let at = plain.indexOf(setting.name); at >= 0; at = plain.indexOf(setting.name, at + 1)) {
    // The name of another setting may end like this one: only blanks of a line, or the values of one before it, precede a name.
    const before = plain.slice(plain.lastIndexOf("\n", at) + 1, at);
    if (!/^\s*$|[\d\s]\s$|\b(?:on|off)\s+$/.test(before)) continue;
    const valuesFrom = at + setting.name.length;
    const { words, to } = wordsFrom(plain, valuesFrom, countOf(setting));
    found.push({ from: at, valuesFrom, to: Math.max(to, valuesFrom), values: words });
  }
  return found;
}

/** The text with other values for a setting that it has, or with the setting at its end. */
export function withValues(text: string, setting: ViewSetting, written: Written | null, values: string): string {
  if (written) return `${text.slice(0, written.valuesFrom)} ${values}${text.slice(written.to)}`;
  return `${text}${text === "" || text.endsWith("\n") ? "" : "\n"}${setting.name} ${values}\n`;
}

/** The text without a setting, and without its line if nothing else stands there. */
export function without(text: string, written: Written): string {
  let { from, to } = written;
  while (/[ \t]/.test(text.charAt(from - 1))) from--;
  while (/[ \t]/.test(text.charAt(to))) to++;
  const alone = (from === 0 || text[from - 1] === "\n") && (to === text.length || text[to] === "\n");
  return text.slice(0, from) + text.slice(alone ? to + 1 : to);
}

/** The values of a line of letters, by letter: "T 0,-1,0 E 0.1". */
export function byLetter(values: readonly string[]): Map<string, string[]> {
  const letters = new Map<string, string[]>();
  let last: string[] | null = null;
  for (const word of values.flatMap((value) => value.split(":")).filter(Boolean)) {
    if (/^[A-Z]$/.test(word)) letters.set(word, (last = []));
    else last?.push(word);
  }
  return letters;
}
