/** Cubic B-splines as the side files define them (docs/side-files.md). */

export interface Point {
  x: number;
  y: number;
  z: number;
  /** How often the point counts: three make a corner. */
  times: number;
}

export type Place = readonly [number, number, number];

function expanded(points: readonly Point[]): Place[] {
  return points.flatMap(({ x, y, z, times }) => Array.from({ length: Math.max(1, times) }, (): Place => [x, y, z]));
}

function mixed(points: readonly Place[], weights: readonly number[]): Place {
  const sum = (k: 0 | 1 | 2) => points.reduce((total, point, i) => total + point[k] * weights[i], 0);
  return [sum(0), sum(1), sum(2)];
}

/** Uniform: four points make a segment, which does not reach the outer ones. */
export function uniformSpline(points: readonly Point[], closed: boolean, perSegment = 12): Place[] {
  const all = expanded(points);
  const segments = closed ? all.length : all.length - 3;
  const curve: Place[] = [];
  for (let i = 0; i < segments; i++) {
    const four = [0, 1, 2, 3].map((k) => all[(i + k) % all.length]);
    for (let j = 0; j <= perSegment; j++) {
      const u = j / perSegment;
      curve.push(
        mixed(four, [(1 - u) ** 3 / 6, (3 * u ** 3 - 6 * u * u + 4) / 6, (-3 * u ** 3 + 3 * u * u + 3 * u + 1) / 6, u ** 3 / 6]),
      );
    }
  }
  return curve;
}

/** One point of the spline that reaches its ends, by de Boor's algorithm; `at` from 0 to 1. */
function clampedPoint(all: readonly Place[], at: number): Place {
  const spans = all.length - 3;
  const u = Math.min(at * spans, spans - 1e-9);
  const span = Math.floor(u);
  const knot = (i: number) => Math.min(spans, Math.max(0, i - 3));
  const four = [0, 1, 2, 3].map((k) => all[span + k]);
  for (let level = 1; level <= 3; level++)
    for (let k = 3; k >= level; k--) {
      const i = span + k;
      const from = knot(i);
      const width = knot(i + 4 - level) - from;
      const part = width > 0 ? (u - from) / width : 0;
      four[k] = mixed([four[k - 1], four[k]], [1 - part, part]);
    }
  return four[3];
}

/** The spline of functions: it begins in the first and ends in the last point. */
export function clampedSpline(points: readonly Point[], samples = 160): Place[] {
  const all = expanded(points);
  if (all.length < 4) return all;
  return Array.from({ length: samples + 1 }, (_, i) => clampedPoint(all, i / samples));
}
