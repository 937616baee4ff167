/** Numbers along an axis. */

/** The distance between ticks: 1, 2 or 5 times a power of ten, for `most` of them at the most. */
export function tickStep(low: number, high: number, most: number): number {
  const least = (high - low) / most;
  const power = 10 ** Math.floor(Math.log10(least));
  // What is a step but for rounding is one.
  const factor = [1, 2, 5, 10].find((times) => times * power >= least * (1 - 1e-9)) ?? 10;
  return factor * power;
}

/** A range that ends at ticks and holds another. */
export function widened(low: number, high: number, most: number): [number, number] {
  if (!(high > low)) return widened(low - 0.5, low + 0.5, most);
  const step = tickStep(low, high, most);
  return [Math.floor(low / step + 1e-9) * step, Math.ceil(high / step - 1e-9) * step];
}

export interface Tick {
  value: number;
  text: string;
}

/** The ticks within a range, with as many decimals as tell them apart. */
export function ticksOf(low: number, high: number, most: number): Tick[] {
  const step = tickStep(low, high, most);
  const digits = Math.floor(Math.log10(step) + 1e-9);
  const largest = Math.max(Math.abs(low), Math.abs(high));
  const text = (value: number) => {
    if (value === 0) return "0";
    if (largest >= 1e6 || digits < -4) return value.toExponential(Math.max(0, Math.floor(Math.log10(Math.abs(value))) - digits));
    return value.toFixed(Math.max(0, -digits));
  };
  const ticks: Tick[] = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i++) ticks.push({ value: i * step, text: text(i * step) });
  return ticks;
}
