/** The editor of Bézier surfaces: sixteen points a patch, dragged in the plane of the picture, which turns. */
import { h } from "../elements.js";
import { at } from "../lists.js";
import { axes, vectorOf, type Vector } from "../view/index.js";
import { arrowStep } from "./arrows.js";
import type { SideEditor, SideText } from "./side.js";

interface Patch {
  name: string;
  /** Where its 48 numbers stand in the text. */
  from: number;
  to: number;
  points: Vector[];
}

const number = String.raw`[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?`;
const blocks = new RegExp(String.raw`BR:\s*\S+\s+((?:${number}\s+){47}${number})`, "g");

function patchesOf(text: string): Patch[] {
  const patches: Patch[] = [];
  for (const match of text.matchAll(blocks)) {
    const [whole, block = ""] = match;
    const values = block.trim().split(/\s+/).map(Number);
    const from = match.index + whole.length - block.length;
    const before = text.slice(0, match.index);
    const name =
      /(\S+)\s+TOP COLOR:[\s\S]*$/.exec(before.slice(before.lastIndexOf("TOP COLOR:") - 80))?.[1] ?? `patch ${patches.length + 1}`;
    const points = Array.from({ length: 16 }, (_, i) => vectorOf((k) => at(values, 3 * i + k)));
    patches.push({ name, from, to: from + block.length, points });
  }
  return patches;
}

function written(points: readonly Vector[]): string {
  const rows = [0, 4, 8, 12].map((row) =>
    points
      .slice(row, row + 4)
      .map((point) => point.map((value) => value.toFixed(4)).join(" "))
      .join("  "),
  );
  return rows.join("\n");
}

function bernstein(t: number): [number, number, number, number] {
  const s = 1 - t;
  return [s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t];
}

function surfaceAt(points: readonly Vector[], s: number, t: number): Vector {
  const weights = bernstein(s).flatMap((row) => bernstein(t).map((column) => row * column));
  return vectorOf((k) => weights.reduce((sum, weight, i) => sum + weight * at(points, i)[k], 0));
}

const space = "http://www.w3.org/2000/svg";
const size = 300;

export class SurfaceEditor implements SideEditor {
  readonly elements: Node[];
  private readonly picture = document.createElementNS(space, "svg");
  private patches: Patch[];
  private azimuth = 0.5;
  private elevation = 0.4;
  private centre: Vector = [0, 0, 0];
  private scale = 1;
  private dragging = false;

  constructor(private readonly text: SideText) {
    this.patches = patchesOf(text.content());
    this.picture.setAttribute("viewBox", `0 0 ${size} ${size * 0.75}`);
    this.picture.classList.add("point-plane", "surface");
    this.picture.addEventListener("pointerdown", (event) => this.turn(event));
    const look = (name: string, azimuth: number, elevation: number) =>
      h(
        "button",
        "button small",
        {
          type: "button",
          onclick: () => {
            [this.azimuth, this.elevation] = [azimuth, elevation];
            this.draw();
          },
        },
        name,
      );
    this.elements =
      this.patches.length === 0
        ? []
        : [
            this.picture as unknown as Node,
            h(
              "div",
              "plane-tools",
              {},
              look("Front", 0, 0),
              look("Side", Math.PI / 2, 0),
              look("Top", 0, Math.PI / 2),
              look("Oblique", 0.5, 0.4),
            ),
          ];
    this.frame();
    this.draw();
  }

  refresh(): void {
    if (this.dragging) return;
    const patches = patchesOf(this.text.content());
    if (patches.length === 0) return;
    this.patches = patches;
    this.draw();
  }

  private frame(): void {
    const all = this.patches.flatMap(({ points }) => points);
    if (all.length === 0) return;
    const least = vectorOf((k) => Math.min(...all.map((point) => point[k])));
    const most = vectorOf((k) => Math.max(...all.map((point) => point[k])));
    this.centre = vectorOf((k) => (least[k] + most[k]) / 2);
    this.scale = (size * 0.55) / Math.max(Math.hypot(...vectorOf((k) => most[k] - least[k])), 1e-9);
  }

  /** The axes of the picture in space: right and up. */
  private picturePlane(): [Vector, Vector] {
    const [ca, sa, ce, se] = [Math.cos(this.azimuth), Math.sin(this.azimuth), Math.cos(this.elevation), Math.sin(this.elevation)];
    return [
      [ca, 0, -sa],
      [-sa * se, ce, -ca * se],
    ];
  }

  private project(point: Vector): [number, number] {
    const [right, up] = this.picturePlane();
    const dot = (axis: Vector) => axes.reduce<number>((sum, k) => sum + axis[k] * (point[k] - this.centre[k]), 0) * this.scale;
    return [size / 2 + dot(right), size * 0.375 - dot(up)];
  }

  private draw(): void {
    const parts: SVGElement[] = [];
    for (const patch of this.patches) {
      for (let i = 0; i <= 6; i++) {
        parts.push(
          this.line((t) => surfaceAt(patch.points, i / 6, t)),
          this.line((t) => surfaceAt(patch.points, t, i / 6)),
        );
      }
    }
    this.patches.forEach((patch, which) =>
      patch.points.forEach((point, index) => parts.push(this.handle(patch.name, point, which, index))),
    );
    this.picture.replaceChildren(...parts);
  }

  private line(point: (t: number) => Vector): SVGElement {
    const path = document.createElementNS(space, "path");
    const places = Array.from({ length: 13 }, (_, j) =>
      this.project(point(j / 12))
        .map((v) => v.toFixed(1))
        .join(" "),
    );
    path.setAttribute("d", `M${places.join("L")}`);
    path.classList.add("curve", "thin");
    return path;
  }

  private handle(patch: string, point: Vector, which: number, index: number): SVGElement {
    const circle = document.createElementNS(space, "circle");
    const [x, y] = this.project(point);
    const facts = {
      cx: x,
      cy: y,
      r: 4.5,
      tabindex: 0,
      role: "slider",
      class: "point",
      "data-at": `${which}-${index}`,
      "aria-label": `Point ${Math.floor(index / 4) + 1}, ${(index % 4) + 1} of ${patch}`,
      "aria-valuetext": point.map((value) => value.toFixed(2)).join(", "),
    };
    for (const [name, value] of Object.entries(facts)) circle.setAttribute(name, String(value));
    circle.addEventListener("pointerdown", (event) => this.drag(event, which, index));
    circle.addEventListener("keydown", (event) => this.key(event, which, index));
    return circle;
  }

  private move(which: number, index: number, dx: number, dy: number): void {
    const [right, up] = this.picturePlane();
    const { points } = at(this.patches, which);
    const point = at(points, index);
    points[index] = vectorOf((k) => point[k] + (right[k] * dx - up[k] * dy) / this.scale);
    this.draw();
  }

  private key(event: KeyboardEvent, which: number, index: number): void {
    const step = arrowStep(event.key, event.shiftKey ? 10 : 2);
    if (!step) return;
    event.preventDefault();
    this.move(which, index, ...step);
    this.send(true);
    this.picture.querySelector<SVGElement>(`[data-at="${which}-${index}"]`)?.focus();
  }

  private drag(event: PointerEvent, which: number, index: number): void {
    event.stopPropagation();
    event.preventDefault();
    this.dragging = true;
    this.follow(
      event,
      (dx, dy) => {
        this.move(which, index, dx, dy);
        this.send(false);
      },
      () => {
        this.dragging = false;
        this.send(true);
      },
    );
  }

  private turn(event: PointerEvent): void {
    this.follow(
      event,
      (dx, dy) => {
        this.azimuth -= dx * 0.012;
        this.elevation = Math.max(-1.57, Math.min(1.57, this.elevation + dy * 0.012));
        this.draw();
      },
      () => undefined,
    );
  }

  private follow(event: PointerEvent, moved: (dx: number, dy: number) => void, ended: () => void): void {
    this.picture.setPointerCapture(event.pointerId);
    const perPixel = size / this.picture.getBoundingClientRect().width;
    let [x, y] = [event.clientX, event.clientY];
    const stop = new AbortController();
    this.picture.addEventListener(
      "pointermove",
      (move) => {
        moved((move.clientX - x) * perPixel, (move.clientY - y) * perPixel);
        [x, y] = [move.clientX, move.clientY];
      },
      { signal: stop.signal },
    );
    this.picture.addEventListener(
      "pointerup",
      () => {
        stop.abort();
        ended();
      },
      { signal: stop.signal },
    );
  }

  /** Writes the points of all patches into the text, from the last to the first so that places stay right. */
  private send(lasting: boolean): void {
    let text = this.text.content();
    const places = patchesOf(text);
    if (places.length !== this.patches.length) return;
    for (const [i, { from, to }] of [...places.entries()].reverse())
      text = text.slice(0, from) + written(at(this.patches, i).points) + text.slice(to);
    this.text.change(text, lasting);
  }
}
