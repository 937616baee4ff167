/** The functions of a document in one plane: one is edited, and others show behind it. */
import { h, short, svg } from "../elements.js";
import { at } from "../lists.js";
import type { PointCurve } from "../protocol.js";
import { PointPlane, type PlaneLine } from "./plane.js";
import { comparable, extentOf } from "./plane-view.js";
import type { SideEditor, SideText } from "./side.js";
import { curveOf, heightAt } from "./spline.js";

const colours = 6;
const patterns = 3;

/** A function, its place in its file, and how its line looks. */
export interface FunctionEntry extends PlaneLine {
  number: number;
  name: string;
}

/** In the order of the document, which gives each its line. */
export function entriesOf(curves: readonly PointCurve[]): FunctionEntry[] {
  const counts = new Map<string, number>();
  return curves.map((curve, index) => {
    const number = counts.get(curve.path) ?? 0;
    counts.set(curve.path, number + 1);
    const line = `line-${(index % colours) + 1} pattern-${Math.floor(index / colours) % patterns}`;
    return { curve, number, line, name: curve.name || `function ${number + 1}` };
  });
}

function keyOf({ curve, number }: FunctionEntry): string {
  return `${number} of ${curve.path}`;
}

interface Row {
  element: HTMLElement;
  radio: HTMLInputElement;
  box: HTMLInputElement;
  value: HTMLOutputElement;
}

export class FunctionsEditor implements SideEditor {
  readonly elements: Node[];
  private entries: FunctionEntry[];
  private chosen: FunctionEntry;
  private plane: PointPlane;
  private rows: Row[] = [];
  private drawn = "";
  /** Where values are told. */
  private place: [number, number] | null = null;
  /** What the person has switched on or off. */
  private readonly switched = new Map<string, boolean>();
  private readonly holder = h("div", "");
  private readonly list = h("div", "functions", { role: "radiogroup", "aria-label": "Function that is edited" });

  constructor(private readonly text: SideText) {
    this.entries = entriesOf(text.functions());
    this.chosen = this.own(text.opened) ?? at(this.entries, 0);
    this.plane = this.newPlane();
    this.elements = [this.holder, this.list];
    this.update();
  }

  reread(): void {
    if (this.text.isAhead()) return;
    this.entries = entriesOf(this.text.functions());
    const now = this.own(this.chosen.number) ?? this.own(0);
    if (!now) return;
    this.chosen = now;
    this.plane.refresh(now.curve, this.behind());
    this.update();
  }

  focus(): void {
    this.rows[this.entries.indexOf(this.chosen)]?.radio.focus();
  }

  private own(number: number): FunctionEntry | undefined {
    return this.entries.find((entry) => entry.curve.path === this.text.path && entry.number === number);
  }

  private newPlane(): PointPlane {
    const { number } = this.chosen;
    const plane = new PointPlane(this.chosen.curve, this.chosen.line, this.behind(), {
      changed: (points, lasting) => this.text.move(number, points, lasting),
      pointed: (place) => this.showValues(place),
    });
    this.holder.replaceChildren(plane.element);
    return plane;
  }

  /** Without being switched, a function shows where neither is flat in the other's range. */
  private shows(entry: FunctionEntry): boolean {
    return this.switched.get(keyOf(entry)) ?? comparable(extentOf(entry.curve), extentOf(this.chosen.curve));
  }

  private behind(): PlaneLine[] {
    return this.entries.filter((entry) => entry !== this.chosen && this.shows(entry));
  }

  /** A function of another file is edited in the tab of that file. */
  private choose(entry: FunctionEntry): void {
    if (entry.curve.path !== this.text.path) {
      this.text.go(entry.curve.path, entry.number);
      return;
    }
    this.chosen = entry;
    this.plane = this.newPlane();
    this.update();
  }

  private update(): void {
    const drawn = JSON.stringify(this.entries.map((entry) => [keyOf(entry), entry.name]));
    if (drawn !== this.drawn) {
      this.rows = this.entries.map((_, index) => this.row(index));
      this.list.replaceChildren(...this.rows.map(({ element }) => element));
      this.drawn = drawn;
    }
    for (const [index, { radio, box }] of this.rows.entries()) {
      const entry = at(this.entries, index);
      radio.checked = entry === this.chosen;
      box.disabled = entry === this.chosen;
      box.checked = entry === this.chosen || this.shows(entry);
    }
    this.showValues(this.place);
  }

  /** What a row does is done with the entry that has its place by then. */
  private row(index: number): Row {
    const { name, line, curve } = at(this.entries, index);
    const alone = this.entries.length < 2;
    const radio = h("input", "", { type: "radio", name: "edited-function", hidden: alone, title: `Edit ${name}` });
    radio.addEventListener("change", () => this.choose(at(this.entries, index)));
    const box = h("input", "", { type: "checkbox", "aria-label": `Show ${name} behind`, title: `Show ${name} behind the one that is edited`, hidden: alone });
    box.addEventListener("change", () => {
      this.switched.set(keyOf(at(this.entries, index)), box.checked);
      this.plane.refresh(this.chosen.curve, this.behind());
    });
    const sample = svg("svg", { viewBox: "0 0 26 10", class: `sample ${line}`, "aria-hidden": "true" }, svg("path", { d: "M0 5H26" }));
    const value = h("output", "");
    const file = curve.path === this.text.path ? "" : ` ${curve.path.slice(curve.path.lastIndexOf("/") + 1)}`;
    const element = h("div", "function-row", {}, box, h("label", "", {}, radio, sample, h("span", "", {}, name, h("small", "", {}, file))), value);
    return { element, radio, box, value };
  }

  /** The values of all that show, where the pointer or the point with the focus is. */
  private showValues(place: [number, number] | null): void {
    this.place = place;
    for (const [index, { value }] of this.rows.entries()) {
      const entry = at(this.entries, index);
      const curve = entry === this.chosen ? this.plane.now : entry.curve;
      const shows = entry === this.chosen || this.shows(entry);
      value.textContent = place && shows ? short(heightAt(curveOf(curve), place[0])) : "";
    }
  }
}
