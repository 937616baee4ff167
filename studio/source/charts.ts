/** Charts of the statistics over steps, beside those of a growth that was pinned before. */
import type uPlot from "uplot";
import type { Comparison } from "./compare.js";
import { h, icon, remember, remembered } from "./elements.js";
import { plotOverSteps, showStep, type Curve } from "./plot.js";
import type { Statistics } from "./protocol.js";
import type { Studio } from "./state.js";
import { sameTexts } from "./tables.js";
import type { Timeline } from "./timeline.js";

const mostCharts = 6;
const mostPlants = 6;

export class ChartsPanel {
  readonly element = h("div", "charts");
  private readonly choice = h("div", "chips", { role: "group", "aria-label": "Columns" });
  private readonly place = h("div", "chart-list");
  private readonly pinButton: HTMLButtonElement;
  private chips = new Map<string, HTMLButtonElement>();
  private plots: uPlot[] = [];
  private chosen = remembered<string[]>("charts", []);
  private offered: string[] = [];
  private stale = false;

  constructor(
    private readonly studio: Studio,
    private readonly timeline: Timeline,
    private readonly comparison: Comparison,
    /** Columns that the author of a page asks for; none: those that were chosen last. */
    wanted: string[] = [],
  ) {
    if (wanted.length > 0) this.chosen = wanted;
    this.pinButton = h(
      "button",
      "button small",
      { type: "button", "aria-pressed": "false", onclick: () => comparison.toggle() },
      icon("pin"),
      "Pin this growth",
    );
    this.element.append(
      h(
        "div",
        "chart-bar",
        {},
        this.pinButton,
        h("button", "button small", { type: "button", onclick: () => this.save() }, "Copy as CSV"),
      ),
      this.choice,
      this.place,
    );
    studio.on("statistics", () => this.later());
    studio.on("theme", () => this.later());
    studio.on("measured", () => this.later());
    studio.on("compared", () => this.showPin());
    studio.on("shown", () => this.plots.forEach(showStep));
    new ResizeObserver(() => this.later()).observe(this.element);
  }

  /** Draws once for many rows that come together. */
  private later(): void {
    if (this.stale) return;
    this.stale = true;
    setTimeout(() => {
      this.stale = false;
      this.offer();
      this.draw();
    }, 120);
  }

  private offer(): void {
    const columns = this.studio.statistics.columns.slice(1).filter((name) => name !== "plant" && name !== "name");
    if (sameTexts(columns, this.offered)) return;
    this.offered = columns;
    const usual = ["height", "internodes", "length"].filter((name) => columns.includes(name));
    const known = this.chosen.filter((name) => columns.includes(name));
    this.chosen = known.length > 0 ? known : usual.length > 0 ? usual : columns.slice(0, 2);
    this.chips = new Map(
      columns.map((name) => [
        name,
        h("button", "chip", { type: "button", onclick: () => this.toggle(name) }, name.replaceAll("_", " ")),
      ]),
    );
    this.choice.replaceChildren(...this.chips.values());
    this.showChosen();
  }

  private toggle(name: string): void {
    const others = this.chosen.filter((other) => other !== name);
    this.chosen = others.length < this.chosen.length ? others : [...others, name].slice(-mostCharts);
    remember("charts", this.chosen);
    this.showChosen();
    this.draw();
  }

  private showChosen(): void {
    for (const [name, chip] of this.chips) chip.setAttribute("aria-pressed", String(this.chosen.includes(name)));
  }

  private get pinned(): Statistics | null {
    return this.comparison.pinned?.statistics ?? null;
  }

  private showPin(): void {
    this.pinButton.setAttribute("aria-pressed", String(this.pinned !== null));
    this.pinButton.replaceChildren(icon("pin"), this.pinned ? "Remove the pin" : "Pin this growth");
    this.later();
  }

  private draw(): void {
    for (const plot of this.plots) plot.destroy();
    this.plots = [];
    const width = this.element.clientWidth - 8;
    if (width < 60) return;
    const { statistics } = this.studio;
    if (statistics.rows.length === 0) {
      this.place.replaceChildren(h("p", "hint", {}, "Charts appear when the plant has grown a step."));
      return;
    }
    this.place.replaceChildren();
    for (const name of this.chosen) this.chart(name, width);
  }

  private chart(name: string, width: number): void {
    const measured = measuredOf(this.studio, name);
    const steps = [
      ...new Set([...stepsOf(this.studio.statistics), ...(this.pinned ? stepsOf(this.pinned) : []), ...measured.keys()]),
    ].sort((a, b) => a - b);
    const curves = [
      ...curvesOf(this.studio.statistics, name, steps, false),
      ...(this.pinned ? curvesOf(this.pinned, name, steps, true) : []),
      ...(measured.size > 0 ? [{ name: "measured", dots: true, colour: 5, values: steps.map((step) => measured.get(step) ?? null) }] : []),
    ];
    const unit = this.studio.statistics.units[name];
    const place = h("figure", "chart", {}, h("figcaption", "", {}, name.replaceAll("_", " "), unit ? h("small", "", {}, ` ${unit}`) : ""));
    this.place.append(place);
    this.plots.push(
      plotOverSteps(place, steps, curves, {
        width,
        height: 150,
        step: () => this.timeline.step,
        clicked: (step) => this.timeline.goTo(step),
      }),
    );
  }

  private save(): void {
    const { columns, rows } = this.studio.statistics;
    const text = [columns, ...rows].map((row) => row.join(",")).join("\n");
    navigator.clipboard.writeText(`${text}\n`).then(
      () => this.studio.tell("note", "The statistics of all steps are in the clipboard."),
      () => this.studio.tell("error", "The browser refused the clipboard. Export the run to get statistics.csv."),
    );
  }
}

function stepsOf({ rows }: Statistics): number[] {
  return rows.map((row) => Number(row[0]));
}

/** What was measured of a column, by steps; a time lies between two of them. */
function measuredOf({ measured, statistics }: Studio, column: string): Map<number, number> {
  const time = statistics.columns.indexOf("time");
  const times = statistics.rows.map((row) => [Number(row[time]), Number(row[0])] as const);
  const values = new Map<number, number>();
  for (const { by, course } of measured) {
    for (const one of course) {
      if (one.column !== column) continue;
      const step = by === "step" ? one.at : stepAt(times, one.at);
      if (step !== null) values.set(step, one.value);
    }
  }
  return values;
}

function stepAt(times: (readonly [number, number])[], time: number): number | null {
  const next = times.findIndex(([of]) => of >= time);
  const after = times[next];
  const before = times[next - 1] ?? after;
  if (!after || !before) return null;
  const span = after[0] - before[0];
  return span > 0 ? before[1] + ((time - before[0]) / span) * (after[1] - before[1]) : after[1];
}

/** One curve, or one for each plant if the statistics tell plants apart. */
function curvesOf(statistics: Statistics, name: string, steps: number[], pinned: boolean): Curve[] {
  const at = statistics.columns.indexOf(name);
  if (at < 0) return [];
  const plant = statistics.columns.indexOf("plant");
  const names = statistics.columns.indexOf("name");
  const plants = [...new Set(statistics.rows.map((row) => row[plant] ?? 0))].slice(0, mostPlants);
  return plants.map((which, index) => {
    const rows = statistics.rows.filter((row) => (row[plant] ?? 0) === which);
    const values = new Map(rows.map((row) => [Number(row[0]), typeof row[at] === "number" ? row[at] : null]));
    const label = plants.length === 1 ? name.replaceAll("_", " ") : String(rows[0]?.[names] ?? `plant ${which}`);
    return {
      name: pinned ? `${label}, pinned` : label,
      dashed: pinned,
      colour: pinned && plants.length === 1 ? 1 : index,
      values: steps.map((step) => values.get(step) ?? null),
    };
  });
}
