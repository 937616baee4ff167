/** A plane with a curve and points that are dragged with the pointer or moved with keys; other curves may show behind it. */
import { decimalField, h, numberIn, short, svg } from "../elements.js";
import { at } from "../lists.js";
import type { CurvePoint, PointCurve } from "../protocol.js";
import { arrowStep } from "./arrows.js";
import { extentOf, height, PlaneView, united, width } from "./plane-view.js";
import { curveOf } from "./spline.js";

/** A curve and the class of its line. */
export interface PlaneLine {
  curve: PointCurve;
  line: string;
}

interface PlaneListener {
  changed: (points: CurvePoint[], lasting: boolean) => void;
  /** The place that the pointer, or the point that has the focus, is at; null: none. */
  pointed: (place: [number, number] | null) => void;
}

/** Without the last digits, which sums of steps leave. */
const even = (value: number) => Number(value.toPrecision(10));

export class PointPlane {
  readonly element: HTMLElement;
  private readonly picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "group" });
  private readonly cross = svg("path", { class: "cross" });
  private readonly place = h("div", "plane-place");
  private readonly fields: Record<"x" | "y" | "z" | "times", HTMLInputElement>;
  private points: CurvePoint[];
  private view: PlaneView;
  private chosen = 0;

  constructor(
    private curve: PointCurve,
    line: string,
    private behind: PlaneLine[],
    private readonly listener: PlaneListener,
  ) {
    this.points = curve.points.map((point) => ({ ...point }));
    this.view = this.newView();
    this.picture.setAttribute("class", `point-plane ${line}`);
    this.picture.setAttribute("aria-label", `Points of ${curve.name || "the curve"}`);
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
        h("label", "", { hidden: curve.points.every(({ z }) => z === 0) }, "z ", this.fields.z),
        h("label", "", {}, "× ", this.fields.times),
        add,
        remove,
      ),
      this.place,
    );
    this.picture.addEventListener("dblclick", (event) => this.addAt(event));
    this.picture.addEventListener("pointermove", (event) => this.point(this.view.fromPicture(this.picture, event)));
    this.picture.addEventListener("pointerleave", () => this.pointAtChosen());
    this.draw();
  }

  /** Another version of the same file and of what shows behind, unless a point is being dragged. */
  refresh(curve: PointCurve, behind: PlaneLine[]): void {
    if (this.picture.querySelector(".dragged")) return;
    this.curve = curve;
    this.behind = behind;
    this.points = curve.points.map((point) => ({ ...point }));
    this.chosen = Math.min(this.chosen, this.points.length - 1);
    const hasFocus = this.picture.contains(document.activeElement);
    this.view = this.newView();
    this.draw();
    if (hasFocus) this.focusPoint(this.chosen);
  }

  /** The curve as it lies now, also while a point is dragged. */
  get now(): PointCurve {
    return { ...this.curve, points: this.points };
  }

  private get isClosed(): boolean {
    return this.curve.spline === "closed";
  }

  /** Holds all that shows, as it lies now. */
  private newView(): PlaneView {
    const extents = [this.now, ...this.behind.map(({ curve }) => curve)].map(extentOf);
    return new PlaneView(united(extents), this.curve.kind !== "function");
  }

  private draw(): void {
    const { view } = this;
    const behind = this.behind.map(({ curve, line }) =>
      svg("path", { class: `curve behind ${line}`, d: view.path(curveOf(curve), curve.spline === "closed") }),
    );
    const places = view.path(
      this.points.map(({ x, y, z }) => [x, y, z]),
      this.isClosed,
    );
    const own = view.path(curveOf(this.now), this.isClosed);
    this.picture.replaceChildren(
      view.axes(),
      ...behind,
      this.cross,
      svg("path", { class: "frame", d: places }),
      svg("path", { class: "curve", d: own }),
      ...this.points.map((point, index) => this.handle(point, index)),
    );
    this.showFields();
  }

  private point(place: [number, number] | null): void {
    this.cross.setAttribute("d", place ? this.view.cross(...place) : "");
    this.place.textContent = place ? `x ${short(place[0])}   y ${short(place[1])}` : "";
    this.listener.pointed(place);
  }

  private pointAtChosen(): void {
    const point = this.picture.contains(document.activeElement) ? this.points[this.chosen] : undefined;
    this.point(point ? [point.x, point.y] : null);
  }

  private handle({ x, y, times }: CurvePoint, index: number): SVGElement {
    const [cx, cy] = this.view.toPicture(x, y);
    const circle = svg("circle", {
      cx,
      cy,
      r: times > 1 ? 7 : 5.5,
      tabindex: 0,
      role: "slider",
      "aria-label": `Point ${index + 1}`,
      "aria-valuenow": y,
      "aria-valuetext": `${short(x)}, ${short(y)}`,
      class: `point${index === this.chosen ? " chosen" : ""}${times > 1 ? " corner" : ""}`,
    });
    circle.addEventListener("focus", () => this.choose(index));
    circle.addEventListener("blur", () => this.point(null));
    circle.addEventListener("pointerdown", (event) => this.drag(circle, index, event));
    circle.addEventListener("keydown", (event) => this.key(event, index));
    return circle;
  }

  private choose(index: number): void {
    this.chosen = index;
    this.picture.querySelectorAll(".point").forEach((point, i) => point.classList.toggle("chosen", i === index));
    this.showFields();
    this.pointAtChosen();
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
        const [x, y] = this.view.fromPicture(this.picture, move);
        this.move(index, x, y, false);
        this.picture.querySelectorAll(".point")[index]?.classList.add("dragged");
      },
      { signal },
    );
    this.picture.addEventListener(
      "pointerup",
      () => {
        stop.abort();
        this.rest();
        this.focusPoint(index);
        this.send(true);
      },
      { signal },
    );
  }

  private key(event: KeyboardEvent, index: number): void {
    const step = arrowStep(event.key, event.shiftKey ? 10 : 1);
    if (event.key === "Delete" || event.key === "Backspace") this.remove();
    else if (event.key === "Insert") this.add();
    else if (step) {
      const { x, y } = at(this.points, index);
      const [right, up] = this.view.steps;
      this.move(index, even(x + step[0] * right), even(y - step[1] * up), true);
      this.rest();
      this.focusPoint(index);
    } else return;
    event.preventDefault();
  }

  private focusPoint(index: number): void {
    (this.picture.querySelectorAll(".point")[index] as SVGElement | undefined)?.focus();
  }

  /** Draws what lies outside of the axes within new ones. */
  private rest(): void {
    this.view = this.newView();
    this.draw();
  }

  /** The x of a function grows from 0 to 1, or as far as the file goes beyond. */
  private move(index: number, x: number, y: number, lasting: boolean): void {
    const point = at(this.points, index);
    if (this.curve.kind === "function") {
      const [before, after] = [this.points[index - 1]?.x ?? 0, this.points[index + 1]?.x ?? 1];
      const end = index === 0 ? Math.min(0, point.x) : index === this.points.length - 1 ? Math.max(1, point.x) : null;
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
    } else {
      this.move(this.chosen, name === "x" ? value : point.x, name === "y" ? value : point.y, true);
      this.rest();
    }
  }

  private add(): void {
    const from = Math.min(this.chosen, this.points.length - 2);
    const [a, b] = [at(this.points, from), at(this.points, from + 1)];
    this.insert({ x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, z: (a.z + b.z) / 2, times: 1 }, from + 1);
  }

  private addAt(event: MouseEvent): void {
    const [x, y] = this.view.fromPicture(this.picture, event);
    if (this.curve.kind === "function") {
      const index = this.points.findIndex((point) => point.x > x);
      if (index > 0) this.insert({ x, y, z: 0, times: 1 }, index);
      return;
    }
    // Between the two neighbours that are nearest together with the new point.
    const away = (i: number) => {
      const [a, b] = [at(this.points, i), at(this.points, (i + 1) % this.points.length)];
      return Math.hypot(a.x - x, a.y - y) + Math.hypot(b.x - x, b.y - y) - Math.hypot(a.x - b.x, a.y - b.y);
    };
    const spans = this.points.map((_, i) => i).slice(0, this.isClosed ? undefined : -1);
    const nearest = spans.reduce((best, i) => (away(i) < away(best) ? i : best), 0);
    this.insert({ x, y, z: 0, times: 1 }, nearest + 1);
  }

  private insert(point: CurvePoint, index: number): void {
    this.points.splice(index, 0, point);
    this.chosen = index;
    this.draw();
    this.focusPoint(index);
    this.send(true);
  }

  private remove(): void {
    const isEnd = this.curve.kind === "function" && (this.chosen === 0 || this.chosen === this.points.length - 1);
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
    this.listener.changed(
      this.points.map((point) => ({ ...point })),
      lasting,
    );
  }
}
