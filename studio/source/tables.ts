/** Tables of statistics and lists of names. */
import type { Cell } from "./protocol.js";

/** Rows of the same step replace earlier ones: a page that connects again hears all of them again. */
export function withRows(rows: Cell[][], more: Cell[][]): Cell[][] {
  const first = more[0];
  if (!first) return rows;
  return [...rows.filter((row) => Number(row[0]) < Number(first[0])), ...more];
}

/** Whether two lists hold the same texts in the same order. */
export function sameTexts(a: readonly string[], b: readonly string[]): boolean {
  return a.length === b.length && a.every((text, i) => text === b[i]);
}
