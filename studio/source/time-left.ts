/** How long a growth still takes. */

/** A step that has grown. */
export interface Moment {
  step: number;
  /** From the beginning of the growth. */
  seconds: number;
  modules: number;
}

const looksBack = 4; // steps

/**
 * Seconds, of moments in their order. A step takes as long as its string is large, and strings multiply as they have over the last
 * steps: of modules that double, the last step takes half of all time.
 */
export function secondsLeft(moments: readonly Moment[], last: number): number | null {
  const now = moments.at(-1);
  const before = moments.findLast(({ step }) => now !== undefined && step <= now.step - looksBack) ?? moments[0];
  if (!now || !before || now.step <= before.step || before.modules === 0) return null;
  const steps = now.step - before.step;
  const factor = Math.max(1, (now.modules / before.modules) ** (1 / steps));
  let known = 0; // of the steps between, as parts of the last one
  for (let k = 0; k < steps; k++) known += factor ** -k;
  const each = (now.seconds - before.seconds) / known;
  let left = 0;
  for (let k = 1; k <= last - now.step && Number.isFinite(left); k++) left += each * factor ** k;
  return left;
}
