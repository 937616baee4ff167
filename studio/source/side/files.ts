/** Reads the points of functions, contours and curves, and writes them back without touching the rest of the file. */
import { at } from "../lists.js";
import type { Vector } from "../view/index.js";
import { clampedSpline, uniformSpline, type Point } from "./spline.js";

export interface PointFile {
  name: string;
  /** Functions have x from 0 to 1, growing; the others a plane with equal scales. */
  kind: "function" | "contour";
  closed: boolean;
  points: Point[];
  curve: (points: readonly Point[]) => Vector[];
  /** The whole text with other points. */
  write: (points: readonly Point[]) => string;
}

function numbersOf(line: string): number[] {
  return line.trim().split(/\s+/).map(Number);
}

function settingIn(lines: readonly string[], from: number, key: string): { line: number; value: string } | null {
  const line = lines.findIndex((text, index) => index >= from && text.startsWith(key));
  return line < 0 ? null : { line, value: at(lines, line).slice(key.length).trim() };
}

/** The first line of numbers behind another line. */
function firstNumbers(lines: readonly string[], behind: number): number {
  const first = lines.findIndex((text, index) => index > behind && /^\s*[-+.\d]/.test(text));
  return first < 0 ? lines.length : first;
}

function decimals(value: number): string {
  return value.toFixed(6).replace(/(\.\d*?[1-9])0+$|\.0+$/, "$1");
}

/** Everything of a file but the lines of its points. */
interface Body {
  lines: string[];
  countLine: number;
  first: number;
  count: number;
}

function writer(body: Body, countText: (points: readonly Point[]) => string, lineOf: (point: Point) => string) {
  return (points: readonly Point[]): string => {
    const lines = [...body.lines];
    lines[body.countLine] = countText(points);
    lines.splice(body.first, body.count, ...points.map(lineOf));
    return lines.join("\n");
  };
}

function readFunction(lines: string[], from: number): PointFile | null {
  const found = settingIn(lines, from, "points:");
  if (!found) return null;
  const count = Number(found.value);
  const rows = lines.slice(found.line + 1, found.line + 1 + count).map(numbersOf);
  if (rows.length < count || rows.some((row) => row.length < 2 || row.some(Number.isNaN))) return null;
  const body = { lines, countLine: found.line, first: found.line + 1, count };
  const withTimes = rows.some((row) => row.length > 2);
  return {
    name: settingIn(lines, from, "name:")?.value || "function",
    kind: "function",
    closed: false,
    points: rows.map(([x = 0, y = 0, times = 1]) => ({ x, y, z: 0, times })),
    curve: (points) => clampedSpline(points),
    write: writer(
      body,
      (points) => `points: ${points.length}`,
      ({ x, y, times }) => `${decimals(x)} ${decimals(y)}${withTimes || times > 1 ? ` ${times}` : ""}`,
    ),
  };
}

function readContour(lines: string[]): PointFile | null {
  const found = settingIn(lines, 0, "points:");
  const type = settingIn(lines, 0, "type:");
  if (!found || !type) return null;
  const [count = 0] = numbersOf(found.value);
  const first = firstNumbers(lines, type.line);
  const rows = lines.slice(first, first + count).map(numbersOf);
  if (rows.length < count || rows.some((row) => row.length < 3 || row.some(Number.isNaN))) return null;
  const closed = type.value.startsWith("c");
  const total = (points: readonly Point[]) => points.reduce((sum, { times }) => sum + times, 0);
  return {
    name: settingIn(lines, 0, "name:")?.value || "contour",
    kind: "contour",
    closed,
    points: rows.map(([x = 0, y = 0, z = 0, times = 1]) => ({ x, y, z, times })),
    curve: (points) => uniformSpline(points, closed),
    write: writer(
      { lines, countLine: found.line, first, count },
      (points) => `points: ${points.length} ${total(points)}`,
      ({ x, y, z, times }) => `${decimals(x)} ${decimals(y)} ${decimals(z)} ${times}`,
    ),
  };
}

function readCurve(lines: string[]): PointFile | null {
  const found = settingIn(lines, 0, "points:");
  const type = settingIn(lines, 0, "type:");
  if (!found || !type) return null;
  const dimension = Number((settingIn(lines, 0, "dimension:") ?? settingIn(lines, 0, "dim:"))?.value ?? 2);
  const count = Number(found.value);
  const first = firstNumbers(lines, type.line);
  const rows = lines.slice(first, first + count).map(numbersOf);
  if (rows.length < count || rows.some((row) => row.length !== dimension || row.some(Number.isNaN))) return null;
  const closed = type.value === "bspline-closed";
  return {
    name: "curve",
    kind: "contour",
    closed,
    points: rows.map(([x = 0, y = 0, z = 0, times = 1]) => ({ x, y, z, times })),
    curve: (points) => (type.value === "bspline-endpoint" ? clampedSpline(points) : uniformSpline(points, closed)),
    write: writer(
      { lines, countLine: found.line, first, count },
      (points) => `points: ${points.length}`,
      ({ x, y, z, times }) => [x, y, z, times].slice(0, dimension).map(decimals).join(" "),
    ),
  };
}

/** The functions, the contour or the curve of a file; none if it is something else or has a mistake. */
export function readPoints(path: string, content: string): PointFile[] {
  const lines = content.split(/\r?\n/);
  const found: (PointFile | null)[] = [];
  if (/\.(func|fset)$/.test(path)) {
    const starts = lines.flatMap((line, index) => (line.startsWith("fver") ? [index] : []));
    for (const start of starts.length > 0 ? starts : [0]) found.push(readFunction(lines, start));
  } else if (lines[0]?.startsWith("cver")) found.push(readContour(lines));
  else if (lines.some((line) => /^type:\s*bspline/.test(line))) found.push(readCurve(lines));
  return found.filter((file) => file !== null);
}
