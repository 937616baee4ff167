/** Fits the settings of the document to what was measured: files, ranges, the search while it goes on, and what it found. */
import type uPlot from "uplot";
import type { Changes } from "./changes.js";
import { decimalField, h, iconButton, numberIn, short, whole } from "./elements.js";
import type { FitEnd, FitState, MeasuredFile, Setting, SoughtSetting } from "./protocol.js";
import { plotOverSteps } from "./plot.js";
import { partsOf } from "./settings.js";
import { errorText, type Studio } from "./state.js";
import { toBase64 } from "./view/index.js";

const mostBytes = 5_000_000; // that are sent
const mostRows = 40; // of the table
const pause = 700; // milliseconds between two plants that are shown while it seeks

/** A setting that may be sought. */
interface Row {
  element: HTMLElement;
  box: HTMLInputElement;
  low: HTMLInputElement;
  high: HTMLInputElement;
}

function mayBeSought({ kind }: Setting): boolean {
  return kind === "number";
}

function isSoughtAtFirst({ whole: isWhole, lowest, highest }: Setting): boolean {
  return !isWhole && lowest !== null && highest !== null;
}

/** A bound that the text does not give. */
function bound(given: number | null, value: number, factor: number): string {
  return short(given ?? (value === 0 ? factor - 1 : value * (value > 0 ? factor : 2 - factor)));
}

export class FitPanel {
  readonly element = h("div", "fit");
  private readonly files = h("ul", "fit-files");
  private readonly place = h("input", "wide", { type: "text", id: "fit-place", placeholder: "plants.csv" });
  private readonly rowsPlace = h("div", "fit-rows", { role: "group", "aria-label": "Settings that are sought" });
  private readonly search = h("input", "number", { type: "number", min: 1, step: 1, id: "fit-search", placeholder: "usual" });
  private readonly begin = h("button", "button primary", { type: "button", onclick: () => void this.start() }, "Fit");
  private readonly stop = h("button", "button", { type: "button", onclick: () => void this.studio.ask("stop-fit", {}) }, "Stop");
  private readonly bar = h("progress", "wide", { max: 1, value: 0, hidden: true, "aria-label": "Comparisons made" });
  private readonly told = h("p", "hint", { role: "status" });
  private readonly found = h("div", "fit-found");
  private rows = new Map<string, Row>();
  private layout = "";
  private running = false;
  /** This page has begun it: it shows the plants and keeps the best. */
  private own = false;
  private best: Record<string, number> = {};
  private shownAt = 0;
  /** Comparisons, and the residual of the best after them. */
  private course: [number, number][] = [];
  private readonly chart = h("figure", "chart", { hidden: true }, h("figcaption", "", {}, "residual over comparisons"));
  private plot: uPlot | null = null;

  constructor(
    private readonly studio: Studio,
    private readonly changes: Changes,
  ) {
    const chooser = h("input", "", { type: "file", multiple: true, hidden: true, id: "fit-file" });
    chooser.addEventListener("change", () => {
      for (const file of chooser.files ?? []) void this.send(file);
      chooser.value = "";
    });
    this.stop.hidden = true;
    this.element.append(
      h("h3", "", {}, "What was measured"),
      h("p", "hint", {}, "Traits or a course (.csv), points of a scanner (.ply, .xyz, .csv), marks on a picture (.svg), measured plants (RSML, MTG, …)."),
      this.files,
      h(
        "form",
        "fit-place",
        {
          onsubmit: (event) => {
            event.preventDefault();
            if (this.place.value.trim()) void this.studio.ask("measure", { name: this.place.value.trim() });
          },
        },
        h("button", "button", { type: "button", onclick: () => chooser.click() }, "Choose files …"),
        h("label", "", { for: "fit-place" }, "or one below the folder"),
        this.place,
        h("button", "button small", { type: "submit" }, "Read"),
      ),
      chooser,
      h("h3", "", {}, "What is sought"),
      this.rowsPlace,
      h("div", "form-end", {}, h("label", "check", { for: "fit-search", title: "Comparisons over the whole ranges; usually 50 for each setting" }, "Search", this.search), this.stop, this.begin),
      this.bar,
      this.told,
      this.chart,
      this.found,
    );
    this.element.addEventListener("dragover", (event) => event.preventDefault());
    this.element.addEventListener("drop", (event) => {
      event.preventDefault();
      for (const file of event.dataTransfer?.files ?? []) void this.send(file);
    });
    studio.on("document", ({ settings }) => this.offer(settings.filter(mayBeSought)));
    studio.on("measured", (files) => this.list(files));
    studio.on("fitting", (state) => this.watch(state));
    studio.on("fitted", (end) => this.end(end));
    this.list([]);
  }

  private async send(file: File): Promise<void> {
    if (file.size > mostBytes) {
      this.studio.tell("error", `${file.name} has ${whole(file.size / 1e6)} MB: put it below the opened folder, and write its place there.`);
      return;
    }
    const content = toBase64(new Uint8Array(await file.arrayBuffer()));
    await this.studio.ask("measure", { name: file.name, content });
  }

  private list(files: MeasuredFile[]): void {
    this.files.replaceChildren(
      ...files.map(({ number, name, values, notes, points }) =>
        h(
          "li",
          "",
          {},
          h("strong", "", {}, name),
          ` ${points.length > 0 ? "points, " : ""}${whole(values.length)} numbers are compared`,
          iconButton("close", `Forget ${name}`, () => void this.studio.ask("forget-measured", { number })),
          ...notes.map((note) => h("small", "", {}, note)),
        ),
      ),
    );
    this.begin.disabled = files.length === 0 || this.running;
  }

  private offer(settings: Setting[]): void {
    const layout = JSON.stringify([this.studio.document?.path, settings.map(({ name, lowest, highest }) => [name, lowest, highest])]);
    if (layout === this.layout) return;
    this.layout = layout;
    this.found.replaceChildren();
    this.told.textContent = "";
    this.rows = new Map(settings.map((setting) => [setting.name, rowOf(setting)]));
    if (settings.length === 0) this.rowsPlace.replaceChildren(h("p", "hint", {}, "This document has no settings to seek."));
    else this.rowsPlace.replaceChildren(...[...this.rows.values()].map(({ element }) => element));
  }

  private sought(): SoughtSetting[] {
    return [...this.rows]
      .filter(([, { box }]) => box.checked)
      .map(([name, { low, high }]) => ({ name, lowest: Number(numberIn(low)), highest: Number(numberIn(high)) }));
  }

  private async start(): Promise<void> {
    const settings = this.sought();
    if (settings.some(({ lowest, highest }) => !Number.isFinite(lowest) || !Number.isFinite(highest))) {
      this.told.textContent = "A bound is no number.";
      return;
    }
    this.best = {};
    this.course = [];
    this.found.replaceChildren();
    await this.changes.settle();
    try {
      this.own = true;
      await this.studio.connection.request("fit", { settings, ...(this.search.value ? { search: Number(this.search.value) } : {}) });
      this.run(true);
      this.told.textContent = "The first plants grow …";
    } catch (error) {
      this.own = false;
      this.told.textContent = errorText(error);
    }
  }

  private run(running: boolean): void {
    this.running = running;
    this.begin.disabled = running || this.studio.measured.length === 0;
    this.stop.hidden = !running;
    this.bar.hidden = !running;
  }

  private watch({ done, all, residual, best }: FitState): void {
    this.run(true);
    this.bar.max = Math.max(all, 1);
    this.bar.value = done;
    this.told.textContent = `${whole(done)} of at most ${whole(all)} comparisons; residual ${short(residual)}`;
    this.course.push([done, residual]);
    const changed = Object.entries(best).some(([name, value]) => this.best[name] !== value);
    this.best = best;
    const now = performance.now();
    if (!this.own || !changed || now - this.shownAt < pause) return;
    this.shownAt = now;
    this.draw();
    this.changes.transient("fit", { settings: textsOf(best) }, "Fit");
  }

  private draw(): void {
    this.plot?.destroy();
    const width = this.element.clientWidth - 8;
    this.chart.hidden = width < 60 || this.course.length < 2;
    if (this.chart.hidden) return;
    const steps = this.course.map(([done]) => done);
    const curve = { name: "residual", values: this.course.map(([, residual]) => residual) };
    const still = { step: () => NaN, clicked: () => undefined };
    this.plot = plotOverSteps(this.chart, steps, [curve], { width, height: 110, small: true, ...still });
  }

  private end(end: FitEnd): void {
    this.run(false);
    this.draw();
    const { own } = this;
    this.own = false;
    const best = end.end === "done" ? Object.fromEntries(end.settings.map(({ name, value }) => [name, value])) : this.best;
    if (own && Object.keys(best).length > 0) this.changes.lasting("fit", { settings: textsOf(best) }, "Fit");
    if (end.end === "done") this.show(end);
    else this.told.textContent = end.end === "stopped" ? "Stopped; the best so far stays. Undo takes it back." : "It failed.";
  }

  private show({ settings, predicted, remarks, residual, worlds }: FitEnd): void {
    this.told.textContent = `Residual ${short(residual)} of the scales; ${whole(worlds)} plants grown. Undo takes it back.`;
    const values = this.studio.measured.flatMap((file) => file.values);
    const rows = values.slice(0, mostRows).map(({ name, value }, i) => [name, short(value), numberOf(predicted[i] ?? null)]);
    this.found.replaceChildren(
      table(
        ["setting", "best", "standard error"],
        settings.map(({ name, value, error }) => [name, short(value), numberOf(error)]),
      ),
      ...remarks.map((remark) => h("p", "hint", {}, remark)),
      h("h3", "", {}, "Measured, and grown"),
      table(["", "measured", "grown"], rows),
      values.length > mostRows ? h("p", "hint", {}, `… and ${whole(values.length - mostRows)} more`) : "",
    );
  }
}

function rowOf(setting: Setting): Row {
  const id = `fit-${setting.name}`;
  const box = h("input", "", { type: "checkbox", id, checked: isSoughtAtFirst(setting) });
  const low = decimalField({ "aria-label": `${setting.label}, lowest`, value: bound(setting.lowest, setting.value, 0.5) });
  const high = decimalField({ "aria-label": `${setting.label}, highest`, value: bound(setting.highest, setting.value, 1.5) });
  const element = h("div", "fit-row", {}, h("label", "check", { for: id, title: `${setting.name}: ${setting.label}` }, box, partsOf(setting)[0]), low, "to", high);
  return { element, box, low, high };
}

function numberOf(value: number | null): string {
  return value === null ? "–" : short(value);
}

function textsOf(values: Record<string, number>): Record<string, string> {
  return Object.fromEntries(Object.entries(values).map(([name, value]) => [name, String(Number(value.toPrecision(6)))]));
}

function table(head: string[], rows: string[][]): HTMLElement {
  return h(
    "table",
    "fit-table",
    {},
    h("tr", "", {}, ...head.map((text) => h("th", "", { scope: "col" }, text))),
    ...rows.map((cells) => h("tr", "", {}, ...cells.map((text) => h("td", "", {}, text)))),
  );
}
