/** Vectors of three numbers, and boxes. */

export type Vector = readonly [number, number, number];
export type Axis = 0 | 1 | 2;
export const axes = [0, 1, 2] as const;

export interface Box {
  lower: Vector;
  upper: Vector;
}

/** The vector with the values of a function of the axes. */
export function vectorOf(value: (axis: Axis) => number): [number, number, number] {
  return [value(0), value(1), value(2)];
}

/** Whether two vectors are equal, or both missing. */
export function sameVector(a: Vector | null, b: Vector | null): boolean {
  return a === b || (a !== null && b !== null && axes.every((k) => a[k] === b[k]));
}

export function sameBox(a: Box, b: Box): boolean {
  return sameVector(a.lower, b.lower) && sameVector(a.upper, b.upper);
}

/** The smallest box around two. */
export function around(a: Box, b: Box): Box {
  return {
    lower: vectorOf((k) => Math.min(a.lower[k], b.lower[k])),
    upper: vectorOf((k) => Math.max(a.upper[k], b.upper[k])),
  };
}
