/** A plane with a curve and points that are dragged with the pointer or moved with keys. */
import { decimalField, h, numberIn } from "../elements.js";
import { at } from "../lists.js";
import type { Vector } from "../view/index.js";
import { arrowStep } from "./arrows.js";
import type { PointFile } from "./files.js";
import type { Point } from "./spline.js";

const space = "http://www.w3.org/2000/svg";
const [width, height, border] = [360, 230, 22];

function svg<Tag extends keyof SVGElementTagNameMap>(
  tag: Tag,
  attributes: Record<string, string | number>,
): SVGElementTagNameMap[Tag] {
  const element = document.createElementNS(space, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
}

interface View {
  left: number;
  bottom: number;
  perX: number;
  perY: number;
}

function viewOf(file: PointFile): View {
  const xs = file.points.map(({ x }) => x);
  const ys = file.points.map(({ y }) => y);
  const isFunction = file.kind === "function";
  const [left, right] = isFunction ? [0, 1] : [Math.min(0, ...xs), Math.max(0, ...xs)];
  const [bottom, top] = [Math.min(0, ...ys), Math.max(isFunction ? 1 : 0, ...ys)];
  let perX = (width - 2 * border) / Math.max(right - left, 1e-9);
  let perY = (height - 2 * border) / Math.max(top - bottom, 1e-9);
  if (file.kind === "contour") perX = perY = 0.8 * Math.min(perX, perY);
  return {
    left: (left + right) / 2 - width / 2 / perX,
    bottom: (bottom + top) / 2 - height / 2 / perY,
    perX,
    perY,
  };
}

export class PointPlane {
  readonly element: HTMLElement;
  private readonly picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "point-plane" });
  private readonly fields: Record<"x" | "y" | "z" | "times", HTMLInputElement>;
  private points: Point[];
  private view: View;
  private chosen = 0;

  constructor(
    private file: PointFile,
    private readonly changed: (text: string, lasting: boolean) => void,
  ) {
    this.points = file.points.map((point) => ({ ...point }));
    this.view = viewOf(file);
    const field = (label: string) => decimalField({ "aria-label": label, title: label });
    this.fields = {
      x: field("x of the point"),
      y: field("y of the point"),
      z: field("z of the point"),
      times: field("How often the point counts: 3 makes a corner"),
    };
    for (const [name, input] of Object.entries(this.fields))
      input.addEventListener("change", () => this.setField(name as keyof typeof this.fields, Number(numberIn(input))));
    const add = h("button", "button small", { type: "button", onclick: () => this.add() }, "Add point");
    const remove = h("button", "button small", { type: "button", onclick: () => this.remove() }, "Remove");
    this.element = h(
      "div",
      "plane",
      {},
      this.picture,
      h(
        "div",
        "plane-tools",
        {},
        h("label", "", {}, "x ", this.fields.x),
        h("label", "", {}, "y ", this.fields.y),
        h("label", "", { hidden: file.points.every(({ z }) => z === 0) }, "z ", this.fields.z),
        h("label", "", {}, "× ", this.fields.times),
        add,
        remove,
      ),
    );
    this.picture.addEventListener("dblclick", (event) => this.addAt(event));
    this.draw();
  }

  /** Another version of the same file, unless a point is being dragged. */
  refresh(file: PointFile): void {
    if (this.picture.querySelector(".dragged")) return;
    this.file = file;
    this.points = file.points.map((point) => ({ ...point }));
    this.chosen = Math.min(this.chosen, this.points.length - 1);
    this.draw();
  }

  private toPicture(x: number, y: number): [number, number] {
    return [(x - this.view.left) * this.view.perX, height - (y - this.view.bottom) * this.view.perY];
  }

  private fromPicture(event: MouseEvent): [number, number] {
    const box = this.picture.getBoundingClientRect();
    const [px, py] = [((event.clientX - box.left) / box.width) * width, ((event.clientY - box.top) / box.height) * height];
    return [px / this.view.perX + this.view.left, (height - py) / this.view.perY + this.view.bottom];
  }

  private path(places: readonly Vector[], close: boolean): string {
    const parts = places.map(([x, y]) =>
      this.toPicture(x, y)
        .map((value) => value.toFixed(2))
        .join(" "),
    );
    return parts.length > 0 ? `M${parts.join("L")}${close ? "Z" : ""}` : "";
  }

  private draw(): void {
    const [zeroX, zeroY] = this.toPicture(0, 0);
    const [oneX, oneY] = this.toPicture(1, 1);
    const axes = svg("path", { class: "axes", d: `M0 ${zeroY}H${width}M${zeroX} 0V${height}` });
    const unit = svg("path", { class: "unit-box", d: `M${zeroX} ${oneY}H${oneX}V${zeroY}` });
    const frame = svg("path", {
      class: "frame",
      d: this.path(
        this.points.map(({ x, y, z }) => [x, y, z]),
        this.file.closed,
      ),
    });
    const curve = svg("path", { class: "curve", d: this.path(this.file.curve(this.points), this.file.closed) });
    this.picture.replaceChildren(axes, unit, frame, curve, ...this.points.map((point, index) => this.handle(point, index)));
    this.showFields();
  }

  private handle({ x, y, times }: Point, index: number): SVGElement {
    const [cx, cy] = this.toPicture(x, y);
    const circle = svg("circle", {
      cx,
      cy,
      r: times > 1 ? 7 : 5.5,
      tabindex: 0,
      role: "slider",
      "aria-label": `Point ${index + 1}`,
      "aria-valuetext": `${x.toFixed(3)}, ${y.toFixed(3)}`,
      class: `point${index === this.chosen ? " chosen" : ""}${times > 1 ? " corner" : ""}`,
    });
    circle.addEventListener("focus", () => this.choose(index));
    circle.addEventListener("pointerdown", (event) => this.drag(circle, index, event));
    circle.addEventListener("keydown", (event) => this.key(event, index));
    return circle;
  }

  private choose(index: number): void {
    this.chosen = index;
    this.picture.querySelectorAll(".point").forEach((point, i) => point.classList.toggle("chosen", i === index));
    this.showFields();
  }

  /** The picture is drawn anew while the point moves, so the moves are heard on the picture. */
  private drag(circle: SVGElement, index: number, event: PointerEvent): void {
    event.preventDefault();
    circle.focus();
    this.picture.setPointerCapture(event.pointerId);
    const stop = new AbortController();
    const { signal } = stop;
    this.picture.addEventListener(
      "pointermove",
      (move) => {
        const [x, y] = this.fromPicture(move);
        this.move(index, x, y, false);
        this.picture.querySelectorAll(".point")[index]?.classList.add("dragged");
      },
      { signal },
    );
    this.picture.addEventListener(
      "pointerup",
      () => {
        stop.abort();
        this.draw();
        this.focusPoint(index);
        this.send(true);
      },
      { signal },
    );
  }

  private key(event: KeyboardEvent, index: number): void {
    const by = (event.shiftKey ? 10 : 1) / 100;
    const step = arrowStep(event.key, by);
    if (event.key === "Delete" || event.key === "Backspace") this.remove();
    else if (event.key === "Insert") this.add();
    else if (step) {
      const span = this.file.kind === "function" ? 1 : width / this.view.perX / 3;
      const { x, y } = at(this.points, index);
      this.move(index, x + step[0] * span, y - step[1] * span, true);
      this.focusPoint(index);
    } else return;
    event.preventDefault();
  }

  private focusPoint(index: number): void {
    (this.picture.querySelectorAll(".point")[index] as SVGElement | undefined)?.focus();
  }

  /** The x of a function grows from 0 to 1. */
  private move(index: number, x: number, y: number, lasting: boolean): void {
    const point = at(this.points, index);
    if (this.file.kind === "function") {
      const [before, after] = [this.points[index - 1]?.x ?? 0, this.points[index + 1]?.x ?? 1];
      const end = index === 0 ? 0 : index === this.points.length - 1 ? 1 : null;
      point.x = end ?? Math.min(after, Math.max(before, x));
    } else point.x = x;
    point.y = y;
    this.draw();
    this.send(lasting);
  }

  private setField(name: keyof typeof this.fields, value: number): void {
    const point = this.points[this.chosen];
    if (!point || !Number.isFinite(value)) return;
    if (name === "times") {
      point.times = Math.max(1, Math.round(value));
      this.draw();
      this.send(true);
    } else if (name === "z") {
      point.z = value;
      this.send(true);
    } else this.move(this.chosen, name === "x" ? value : point.x, name === "y" ? value : point.y, true);
  }

  private add(): void {
    const from = Math.min(this.chosen, this.points.length - 2);
    const [a, b] = [at(this.points, from), at(this.points, from + 1)];
    this.insert({ x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, z: (a.z + b.z) / 2, times: 1 }, from + 1);
  }

  private addAt(event: MouseEvent): void {
    const [x, y] = this.fromPicture(event);
    if (this.file.kind === "function") {
      const index = this.points.findIndex((point) => point.x > x);
      if (index > 0) this.insert({ x, y, z: 0, times: 1 }, index);
      return;
    }
    // Between the two neighbours that are nearest together with the new point.
    const away = (i: number) => {
      const [a, b] = [at(this.points, i), at(this.points, (i + 1) % this.points.length)];
      return Math.hypot(a.x - x, a.y - y) + Math.hypot(b.x - x, b.y - y) - Math.hypot(a.x - b.x, a.y - b.y);
    };
    const spans = this.points.map((_, i) => i).slice(0, this.file.closed ? undefined : -1);
    const nearest = spans.reduce((best, i) => (away(i) < away(best) ? i : best), 0);
    this.insert({ x, y, z: 0, times: 1 }, nearest + 1);
  }

  private insert(point: Point, index: number): void {
    this.points.splice(index, 0, point);
    this.chosen = index;
    this.draw();
    this.focusPoint(index);
    this.send(true);
  }

  private remove(): void {
    const isEnd = this.file.kind === "function" && (this.chosen === 0 || this.chosen === this.points.length - 1);
    if (this.points.length <= 4 || isEnd) return;
    this.points.splice(this.chosen, 1);
    this.chosen = Math.min(this.chosen, this.points.length - 1);
    this.draw();
    this.focusPoint(this.chosen);
    this.send(true);
  }

  private showFields(): void {
    const point = this.points[this.chosen];
    if (!point) return;
    for (const name of ["x", "y", "z", "times"] as const)
      if (document.activeElement !== this.fields[name]) this.fields[name].value = String(Number(point[name].toFixed(4)));
  }

  private send(lasting: boolean): void {
    this.changed(this.file.write(this.points), lasting);
  }
}
