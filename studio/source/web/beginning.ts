/** How the first session of a page begins, and those that follow. */
import type { Begin, Begun } from "./messages.js";

const firstTree = "/library/environments/tree.toml";

/** A page of one growth says its file, its seed and its steps. */
export function howToBegin(isFirst: boolean): Begin {
  const { open, seed, steps } = document.documentElement.dataset;
  if (!open) return { open: firstTree, seed: Math.floor(Math.random() * 1000) };
  const begin: Begin = { open, named: isFirst }; // those that follow begin with what is kept
  if (seed) begin.seed = Number(seed);
  if (steps) begin.steps = Number(steps);
  return begin;
}

declare global {
  interface Window {
    /** The first session, which the page's first script has begun. */
    espalierBegun?: Promise<Begun>;
  }
}
