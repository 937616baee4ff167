/** Where places of a plane lie in its picture, and the axes around them. */
import { svg } from "../elements.js";
import type { PointCurve } from "../protocol.js";
import type { Vector } from "../view/index.js";
import { ticksOf, tickStep, widened, type Tick } from "./axis.js";

export const [width, height] = [360, 240];
const most = { x: 6, y: 6 }; // ticks
const edge = { top: 10, right: 12, bottom: 20 };
const digit = 5.6; // its width in the letters of the axes

/** What a plane shows: the least and the largest x and y. */
export interface Extent {
  x: [number, number];
  y: [number, number];
}

function spanOf(values: number[], ...more: number[]): [number, number] {
  return [Math.min(...values, ...more), Math.max(...values, ...more)];
}

/** The extent of a curve with its zero; x of a function goes from 0 to 1 at the least. */
export function extentOf({ kind, points }: PointCurve): Extent {
  const x = spanOf(points.map((point) => point.x), 0, ...(kind === "function" ? [1] : []));
  return { x, y: spanOf(points.map((point) => point.y), 0) };
}

export function united(extents: readonly Extent[]): Extent {
  return { x: spanOf(extents.flatMap(({ x }) => x)), y: spanOf(extents.flatMap(({ y }) => y)) };
}

/** Whether the one can be edited where the other shows, too: neither is flat in the other's range. */
export function comparable(one: Extent, other: Extent): boolean {
  const size = ({ y }: Extent) => Math.max(y[1] - y[0], 1e-30);
  const ratio = size(united([one, other])) / Math.min(size(one), size(other));
  return ratio <= 4;
}

export class PlaneView {
  readonly left: number;
  private readonly from: [number, number];
  private readonly per: [number, number];
  private readonly ticks: { x: Tick[]; y: Tick[] };
  /** How far an arrow moves a point. */
  readonly steps: [number, number];

  /** `even`: a unit is as long in x as in y, and there is room around. */
  constructor(extent: Extent, even: boolean) {
    const x = even ? extent.x : widened(...extent.x, most.x);
    const y = even ? extent.y : widened(...extent.y, most.y);
    const longest = Math.max(...ticksOf(y[0], y[1], most.y).map(({ text }) => text.length));
    this.left = 12 + digit * (even ? longest + 1 : longest);
    const room = [width - this.left - edge.right, height - edge.top - edge.bottom] as const;
    this.per = [room[0] / Math.max(x[1] - x[0], 1e-9), room[1] / Math.max(y[1] - y[0], 1e-9)];
    if (even) this.per = [0.8 * Math.min(...this.per), 0.8 * Math.min(...this.per)];
    this.from = [(x[0] + x[1] - room[0] / this.per[0]) / 2, (y[0] + y[1] - room[1] / this.per[1]) / 2];
    const [right, top] = [this.from[0] + room[0] / this.per[0], this.from[1] + room[1] / this.per[1]];
    this.ticks = { x: ticksOf(this.from[0], right, most.x), y: ticksOf(this.from[1], top, most.y) };
    const step = tickStep(this.from[0], right, most.x) / 20;
    this.steps = [step, even ? step : tickStep(this.from[1], top, most.y) / 20];
  }

  toPicture(x: number, y: number): [number, number] {
    return [this.left + (x - this.from[0]) * this.per[0], height - edge.bottom - (y - this.from[1]) * this.per[1]];
  }

  /** The place under the pointer. */
  fromPicture(picture: Element, event: MouseEvent): [number, number] {
    const box = picture.getBoundingClientRect();
    const [px, py] = [((event.clientX - box.left) / box.width) * width, ((event.clientY - box.top) / box.height) * height];
    return [(px - this.left) / this.per[0] + this.from[0], (height - edge.bottom - py) / this.per[1] + this.from[1]];
  }

  path(places: readonly Vector[], close = false): string {
    const parts = places.map(([x, y]) =>
      this.toPicture(x, y)
        .map((value) => value.toFixed(2))
        .join(" "),
    );
    return parts.length > 0 ? `M${parts.join("L")}${close ? "Z" : ""}` : "";
  }

  /** Lines and numbers; what is drawn is no text for readers of screens, which are told the place of each point. */
  axes(): SVGElement {
    const [bottom, right] = [height - edge.bottom, width - edge.right];
    const x = this.ticks.x.map((tick) => ({ ...tick, at: this.toPicture(tick.value, 0)[0] }));
    const y = this.ticks.y.map((tick) => ({ ...tick, at: this.toPicture(0, tick.value)[1] }));
    const grid = [...x.map(({ at }) => `M${at} ${edge.top}V${bottom + 4}`), ...y.map(({ at }) => `M${this.left - 4} ${at}H${right}`)];
    const [zeroX, zeroY] = this.toPicture(0, 0);
    const zero = `${x.some(({ value }) => value === 0) ? `M${zeroX} ${edge.top}V${bottom}` : ""}${y.some(({ value }) => value === 0) ? `M${this.left} ${zeroY}H${right}` : ""}`;
    return svg(
      "g",
      { "aria-hidden": "true" },
      svg("path", { class: "grid", d: grid.join("") }),
      svg("path", { class: "axes", d: `M${this.left} ${edge.top}V${bottom}H${right}${zero}` }),
      ...x.map(({ at, text }) => svg("text", { class: "tick across", x: at, y: bottom + 15 }, text)),
      ...y.map(({ at, text }) => svg("text", { class: "tick", x: this.left - 6, y: at + 3.5 }, text)),
    );
  }

  /** Lines to the axes from a place. */
  cross(x: number, y: number): string {
    const [px, py] = this.toPicture(x, y);
    const inside = px >= this.left && px <= width - edge.right && py >= edge.top && py <= height - edge.bottom;
    return inside ? `M${px} ${edge.top}V${height - edge.bottom}M${this.left} ${py}H${width - edge.right}` : "";
  }
}
