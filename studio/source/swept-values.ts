/** The values of a sweep. */

/** `count` values from the lower to the higher, each once; whole numbers if the setting is one. */
export function sweptValues(from: number, to: number, count: number, isWhole: boolean): number[] {
  const [low, high] = [Math.min(from, to), Math.max(from, to)];
  const many = Math.min(12, Math.max(3, Math.round(count)));
  const values = Array.from({ length: many }, (_, i) => low + ((high - low) * i) / (many - 1));
  return [...new Set(values.map((value) => (isWhole ? Math.round(value) : Number(value.toPrecision(6)))))];
}
