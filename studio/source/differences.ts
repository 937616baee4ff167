/** How two growths differ: in words, and as numbers. */
import { short } from "./elements.js";
import { at } from "./lists.js";
import type { StudioDocument } from "./protocol.js";
import { partsOf } from "./settings.js";
import type { Column, Field } from "./view/index.js";

function farthestFromZero(values: Float32Array): number {
  let most = 0;
  for (const value of values) most = Math.max(most, Math.abs(value) || 0);
  return most;
}

/** The second minus the first, which have the same number of modules. */
export function columnBetween(before: Column, now: Column): Column {
  const values = now.values.map((value, i) => value - at(before.values, i));
  const most = farthestFromZero(values);
  return { ...now, values, lowest: -most, highest: most };
}

/** The second minus the first; they have one size, and as many steps between their lowest and highest as a byte. */
export function fieldBetween(before: Field, now: Field): Field {
  const scale = (field: Field) => (field.highest - field.lowest) / 255;
  const [a, b] = [scale(before), scale(now)];
  const differences = Float32Array.from(now.values, (value, i) => now.lowest + value * b - (before.lowest + at(before.values, i) * a));
  const most = farthestFromZero(differences);
  const values = Uint8Array.from(differences, (value) => (most > 0 ? 127.5 + (127.5 * value) / most : 127.5));
  return { ...now, values, lowest: -most, highest: most };
}

/** What a document was where another differs, in words. */
export function differencesBetween(before: StudioDocument, now: StudioDocument): string[] {
  if (before.path !== now.path) return [before.name];
  const told: string[] = [];
  const compare = (name: string, was: string, is: string) => was !== is && told.push(`${name} ${was} (now ${is})`);
  const known = new Map(now.settings.map((setting) => [setting.name, setting]));
  for (const setting of before.settings) compare(partsOf(setting)[0], setting.text, known.get(setting.name)?.text ?? "gone");
  compare("Seed", short(before.seed), short(now.seed));
  compare("Steps", short(before.steps), short(now.steps));
  const texts = new Map(now.texts.map(({ path, content }) => [path, content]));
  if (told.length === 0 && before.texts.some(({ path, content }) => texts.get(path) !== content)) told.push("another text");
  return told;
}
