/** A setting swept through a range: small pictures of the plants that grow, a chart, and a click that takes a value. */
import type uPlot from "uplot";
import type { Changes } from "./changes.js";
import { openDialog } from "./dialog.js";
import { decimalField, h, numberIn, short } from "./elements.js";
import { plotOverSteps } from "./plot.js";
import type { Setting } from "./protocol.js";
import { partsOf, span } from "./settings.js";
import { errorText, type Studio, type SweptPlant } from "./state.js";
import { sweptValues } from "./swept-values.js";
import { around, PlantScene, themes, type Box } from "./view/index.js";

const [width, height] = [168, 150]; // of a small picture, in pixels

interface Tile {
  button: HTMLButtonElement;
  canvas: HTMLCanvasElement;
  plant: SweptPlant | null;
}

export class Sweep {
  private setting: Setting | null = null;
  private readonly low = decimalField({ id: "sweep-from" });
  private readonly high = decimalField({ id: "sweep-to" });
  private readonly count = h("input", "number", { type: "number", id: "sweep-count", min: 3, max: 12, step: 1, value: 6 });
  private readonly begin = h("button", "button primary", { type: "submit" }, "Grow");
  private readonly stopButton = h("button", "button", { type: "button", onclick: () => this.stop("Stopped.") }, "Stop");
  private readonly told = h("p", "hint", { role: "status" });
  private readonly grid = h("div", "sweep-grid");
  private readonly column = h("select", "", { id: "sweep-column", onchange: () => this.draw() });
  private readonly columnRow = h("div", "", { hidden: true }, h("label", "", { for: "sweep-column" }, "Chart of "), this.column);
  private readonly chart = h("figure", "chart");
  private plot: uPlot | null = null;
  private values: number[] = [];
  private tiles: Tile[] = [];
  /** The number of the first growth; -1: none is under way. */
  private first = -1;
  private dialog: HTMLDialogElement | null = null;
  private frame: Box | null = null;
  /** Draws one plant after the other. */
  private small: PlantScene | null = null;

  constructor(
    private readonly studio: Studio,
    private readonly changes: Changes,
    /** Whose direction the small pictures have. */
    private readonly scene: () => PlantScene,
  ) {
    studio.on("swept", (plant) => this.receive(plant));
  }

  open(setting: Setting): void {
    this.setting = setting;
    const { lowest, highest } = span(setting);
    this.low.value = short(lowest);
    this.high.value = short(highest);
    this.tiles = [];
    this.stop("The document stays as it is until you click a plant.");
    this.grid.replaceChildren();
    this.columnRow.hidden = true;
    this.plot?.destroy();
    this.plot = null;
    const labelled = (words: string, field: HTMLInputElement) => [h("label", "", { for: field.id }, words), field];
    const onsubmit = (event: Event) => {
      event.preventDefault();
      void this.start();
    };
    const form = h(
      "form",
      "sweep-form",
      { onsubmit },
      ...labelled("From", this.low),
      ...labelled("to", this.high),
      ...labelled("plants", this.count),
      this.begin,
      this.stopButton,
    );
    const dialog = openDialog(`Sweep ${partsOf(setting)[0]}`, form, this.told, this.grid, this.columnRow, this.chart);
    dialog.classList.add("wide-dialog");
    dialog.addEventListener("close", () => this.stop(""));
    this.dialog = dialog;
  }

  private async start(): Promise<void> {
    const { setting } = this;
    if (!setting) return;
    this.stop("");
    const [low, high] = [Number(numberIn(this.low)), Number(numberIn(this.high))];
    this.values = sweptValues(low, high, Number(this.count.value), setting.whole);
    this.frame = null;
    this.tiles = this.values.map((value) => this.tile(value));
    this.grid.replaceChildren(...this.tiles.map(({ button }) => button));
    await this.changes.settle();
    try {
      const values = this.values.map(String);
      this.first = (await this.studio.connection.request("sweep", { name: setting.name, values })).first;
      this.told.textContent = "The first plant grows …";
      this.stopButton.hidden = false;
    } catch (error) {
      this.grid.replaceChildren();
      this.told.textContent = errorText(error);
    }
  }

  private stop(words: string): void {
    if (this.first >= 0) void this.studio.ask("stop-sweep", {});
    this.first = -1;
    this.stopButton.hidden = true;
    this.told.textContent = words;
  }

  private tile(value: number): Tile {
    const canvas = h("canvas", "", { width, height, "aria-hidden": "true" });
    const button = h("button", "sweep-tile", { type: "button", disabled: true, onclick: () => this.take(value) }, canvas, short(value));
    return { button, canvas, plant: null };
  }

  private take(value: number): void {
    const { setting } = this;
    if (!setting) return;
    this.dialog?.close();
    this.changes.lasting(`setting ${setting.name}`, { settings: { [setting.name]: String(value) } }, `${setting.label} = ${value}`);
  }

  private receive(plant: SweptPlant): void {
    const index = this.first < 0 ? -1 : plant.growth - this.first;
    const tile = this.tiles[index];
    if (!tile) return;
    tile.plant = plant;
    tile.button.disabled = false;
    if (plant.reason) tile.button.append(h("small", "", {}, plant.reason));
    this.show(tile);
    const isLast = index + 1 === this.tiles.length;
    this.told.textContent = isLast ? "All have grown. A click takes a value." : `${index + 1} of ${this.tiles.length} have grown …`;
    if (isLast) this.first = -1;
    this.stopButton.hidden = isLast;
    this.draw();
  }

  /** Small pictures have one scale: those before are drawn again if a plant is larger. */
  private show(tile: Tile): void {
    const before = this.frame;
    this.paint(tile);
    if (before !== this.frame) for (const other of this.tiles) if (other.plant && other !== tile) this.paint(other);
  }

  private paint({ plant, canvas }: Tile): void {
    if (!plant?.packet) return;
    const small = (this.small ??= new PlantScene(h("canvas", "")));
    small.resize(width, height);
    small.theme = themes[this.studio.theme];
    small.setPictures(this.studio.pictures);
    small.learn(plant.shapes);
    small.show(plant.packet);
    const { box } = small;
    if (!box) return;
    const frame = this.frame ? around(this.frame, box) : box;
    if (!this.frame || JSON.stringify(frame) !== JSON.stringify(this.frame)) this.frame = frame;
    small.orbit.state = this.scene().orbit.state;
    small.orbit.fit(frame.lower, frame.upper);
    small.draw();
    canvas.getContext("2d")?.drawImage(small.canvas, 0, 0, width, height);
  }

  /** The chosen column over the swept values, a curve for each plant of the scene. */
  private draw(): void {
    const tables = this.tiles.map(({ plant }) => plant?.statistics ?? null);
    const columns = (tables.find((table) => table !== null)?.columns ?? []).filter((name) => !["step", "time", "plant", "name"].includes(name));
    this.plot?.destroy();
    this.plot = null;
    this.columnRow.hidden = columns.length === 0;
    if (columns.length === 0) return;
    const chosen = this.column.value || (columns.includes("height") ? "height" : columns[0]);
    this.column.replaceChildren(...columns.map((name) => h("option", "", { value: name, selected: name === chosen }, name.replaceAll("_", " "))));
    const plants = Math.max(...tables.map((table) => table?.rows.length ?? 0));
    const curves = Array.from({ length: Math.min(plants, 6) }, (_, k) => ({
      name: plants === 1 ? this.column.value : `plant ${k + 1}`,
      values: tables.map((table) => {
        const value = table?.rows[k]?.[table.columns.indexOf(this.column.value)];
        return typeof value === "number" ? value : null;
      }),
    }));
    this.plot = plotOverSteps(this.chart, this.values, curves, {
      width: Math.max(200, this.chart.clientWidth - 8),
      height: 170,
      along: "value",
      step: () => this.setting?.value ?? Number.NaN,
      clicked: (value) => this.take(value),
    });
  }
}
