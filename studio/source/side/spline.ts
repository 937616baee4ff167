/** Cubic B-splines as the side files define them (docs/side-files.md). */
import { at } from "../lists.js";
import type { CurvePoint, PointCurve } from "../protocol.js";
import { vectorOf, type Vector } from "../view/index.js";

function expanded(points: readonly CurvePoint[]): Vector[] {
  return points.flatMap(({ x, y, z, times }) => Array.from({ length: Math.max(1, times) }, (): Vector => [x, y, z]));
}

function mixed(points: readonly Vector[], weights: readonly number[]): Vector {
  return vectorOf((k) => points.reduce((total, point, i) => total + point[k] * at(weights, i), 0));
}

/** Uniform: four points make a segment, which does not reach the outer ones. */
export function uniformSpline(points: readonly CurvePoint[], closed: boolean, perSegment = 12): Vector[] {
  const all = expanded(points);
  const segments = closed ? all.length : all.length - 3;
  const curve: Vector[] = [];
  for (let i = 0; i < segments; i++) {
    const four = [0, 1, 2, 3].map((k) => at(all, (i + k) % all.length));
    for (let j = 0; j <= perSegment; j++) {
      const u = j / perSegment;
      curve.push(
        mixed(four, [(1 - u) ** 3 / 6, (3 * u ** 3 - 6 * u * u + 4) / 6, (-3 * u ** 3 + 3 * u * u + 3 * u + 1) / 6, u ** 3 / 6]),
      );
    }
  }
  return curve;
}

/** One point of the spline that reaches its ends, by de Boor's algorithm; `part` from 0 to 1. */
function clampedPoint(all: readonly Vector[], part: number): Vector {
  const spans = all.length - 3;
  const u = Math.min(part * spans, spans - 1e-9);
  const span = Math.floor(u);
  const knot = (i: number) => Math.min(spans, Math.max(0, i - 3));
  let mixes = [0, 1, 2, 3].map((k) => at(all, span + k));
  for (let level = 1; level <= 3; level++)
    mixes = mixes.slice(1).map((point, k) => {
      const from = knot(span + level + k);
      const width = knot(span + k + 4) - from;
      const share = width > 0 ? (u - from) / width : 0;
      return mixed([at(mixes, k), point], [1 - share, share]);
    });
  return at(mixes, 0);
}

/** The spline of functions: it begins in the first and ends in the last point. */
export function clampedSpline(points: readonly CurvePoint[], samples = 160): Vector[] {
  const all = expanded(points);
  if (all.length < 4) return all;
  return Array.from({ length: samples + 1 }, (_, i) => clampedPoint(all, i / samples));
}

/** Places along a curve; none of one that is no such spline. */
export function curveOf({ spline, points }: PointCurve): Vector[] {
  if (spline === "clamped") return clampedSpline(points);
  return spline === "other" ? [] : uniformSpline(points, spline === "closed");
}

/** y of a curve whose x grows, where it is x; its ends hold beyond them. */
export function heightAt(curve: readonly Vector[], x: number): number {
  const after = curve.findIndex((place) => place[0] >= x);
  if (after <= 0) return at(curve, after < 0 ? curve.length - 1 : 0)[1];
  const [a, b] = [at(curve, after - 1), at(curve, after)];
  return b[0] > a[0] ? a[1] + ((x - a[0]) / (b[0] - a[0])) * (b[1] - a[1]) : b[1];
}
