/** A growth that was pinned, beside what is changed then: its plant in the picture, what it was, and differences from it. */
import { columnBetween, differencesBetween, fieldBetween } from "./differences.js";
import { h, remember, remembered } from "./elements.js";
import type { Statistics, StudioDocument } from "./protocol.js";
import type { Studio } from "./state.js";
import { readMessage, sameBox, sameVector, type Column, type Field, type Packet, type PlantScene, type Shape } from "./view/index.js";

const mostValues = 8e6; // of columns that are kept
const mostNamed = 4; // differences that are told

interface Pinned {
  growth: number;
  document: StudioDocument;
  statistics: Statistics;
  /** The step that was looked at: its columns and fields are kept. */
  shown: Packet;
  packets: ReadonlyMap<number, Packet>;
  shapes: Shape[];
  columns: Map<string, Column>;
  fields: Map<string, Field>;
}

/** A column as it is painted, and what the legend says of it. */
export interface Painted<Data> {
  data: Data;
  name: string;
  note: string;
  range: [number, number];
}

export class Comparison {
  readonly element = h("div", "compare", { hidden: true });
  pinned: Pinned | null = null;
  private readonly words = h("span", "", { role: "status" });
  private readonly place = h(
    "select",
    "",
    { "aria-label": "Pinned plant" },
    ...["beside", "on it, grey", "hidden"].map((name) => h("option", "", { value: name }, name)),
  );
  private readonly difference = h("input", "", { type: "checkbox" });

  constructor(
    private readonly studio: Studio,
    private readonly scene: () => PlantScene,
  ) {
    this.place.value = remembered("pinned-place", "beside");
    this.place.addEventListener("change", () => {
      remember("pinned-place", this.place.value);
      studio.emit("compared", null);
    });
    this.difference.addEventListener("change", () => studio.emit("compared", null));
    this.element.append(
      this.words,
      h("div", "", {}, this.place, h("label", "check", {}, this.difference, "Colour and field by the difference")),
    );
    studio.on("document", () => this.tell());
    studio.on("compared", () => this.show());
    studio.on("shapes", ({ growth, shapes }) => {
      if (this.pinned?.growth === growth) this.pinned.shapes.push(...shapes);
    });
    studio.on("column", (column) => {
      if (this.isPinned(column)) this.pinned?.columns.set(column.name, column);
    });
    studio.on("field", (field) => {
      if (this.isPinned(field)) this.pinned?.fields.set(field.name, field);
    });
  }

  toggle(): void {
    const { document, frames, shapeMessages, statistics } = this.studio;
    const { shown } = frames;
    if (this.pinned || !document || !shown) this.pinned = null;
    else {
      const shapes = shapeMessages.map(readMessage).flatMap((message) => (message.kind === "shapes" ? message.shapes : []));
      const kept = { columns: new Map<string, Column>(), fields: new Map<string, Field>() };
      const { growth } = shown;
      this.pinned = { growth, document, statistics: structuredClone(statistics), shown, packets: frames.packets, shapes, ...kept };
      void this.keep(this.pinned);
    }
    this.begun = -1;
    this.tell();
    this.studio.emit("compared", null);
  }

  /** The growth whose shapes the picture has for the pinned plant. */
  private begun = -1;

  /** Asks for what is gone with the growth: columns and fields of the step that shows, and the picture of every step. */
  private async keep({ growth, shown: { step } }: Pinned): Promise<void> {
    const { columns, connection, fields, frames, growth: grown } = this.studio;
    const fits = columns.length * (grown?.modules ?? 0) <= mostValues;
    for (const name of fits ? columns : columns.filter((column) => column === remembered("colouring", "")))
      await connection.request("column", { growth, step, name }).catch(() => undefined);
    for (const { name } of fields) await connection.request("field", { growth, step, name }).catch(() => undefined);
    if (this.studio.growth?.growth === growth) frames.prefetch(Array.from({ length: frames.lastStep + 1 }, (_, k) => k));
  }

  private isPinned({ growth, step }: Column | Field): boolean {
    return this.pinned?.growth === growth && this.pinned.shown.step === step;
  }

  /** What the pinned growth was. */
  private tell(): void {
    const { document } = this.studio;
    this.element.hidden = !this.pinned;
    if (!this.pinned || !document) return;
    const differences = differencesBetween(this.pinned.document, document);
    const more = differences.length - mostNamed;
    this.words.textContent =
      differences.length === 0
        ? "Pinned: what you change now is compared with it."
        : `Pinned: ${differences.slice(0, mostNamed).join(", ")}${more > 0 ? ` and ${more} more` : ""}`;
  }

  /** The pinned plant of the step that shows, or its last. */
  show(): void {
    const { pinned } = this;
    const now = this.studio.frames.shown;
    const scene = this.scene();
    const isOther = pinned !== null && now !== null && now.growth !== pinned.growth;
    if (isOther && this.begun !== pinned.growth) {
      this.begun = pinned.growth;
      scene.beginBeside(pinned.shapes);
    }
    const packet = isOther && this.place.value !== "hidden" ? (pinned.packets.get(now.step) ?? pinned.shown) : null;
    scene.showBeside(packet, this.place.value === "beside");
    if (packet) scene.canvas.dataset.pinned = String(packet.step);
    else delete scene.canvas.dataset.pinned;
  }

  /** Colours the pinned plant as the other is, where it can. */
  colour(by: "order" | null): void {
    this.scene().colourBesideBy(this.place.value === "beside" ? by : "grey");
  }

  /** A column as it is painted: the values, or how much larger they are than those of the pinned growth. */
  column(column: Column): Painted<Column> {
    const before = this.pinned?.growth === column.growth ? undefined : this.pinned?.columns.get(column.name);
    const isBeside = this.place.value === "beside" && this.pinned?.shown.step === column.step;
    const note = column.values.some(Number.isNaN) ? "grey: no value" : "";
    const range: [number, number] = [column.lowest, column.highest];
    if (!this.pinned || !before || !this.difference.checked) {
      this.scene().colourBesideBy(isBeside && before ? before : "grey");
      return { data: column, name: column.name, note, range: before ? widest(range, before) : range };
    }
    this.scene().colourBesideBy("grey");
    if (before.step !== column.step || before.values.length !== column.values.length)
      return { data: column, name: column.name, note: `no difference: ${this.reason(before.step === column.step)}`, range };
    const data = columnBetween(before, column);
    return { data, name: `${column.name}, now − pinned`, note, range: [data.lowest, data.highest] };
  }

  field(field: Field): Painted<Field> {
    const before = this.pinned?.growth === field.growth ? undefined : this.pinned?.fields.get(field.name);
    const plain = { data: field, name: field.name, note: "", range: [field.lowest, field.highest] as [number, number] };
    if (!before || !this.difference.checked) return plain;
    const isSame = before.step === field.step && sameVector(before.size, field.size) && sameBox(before, field);
    if (!isSame) return { ...plain, note: `no difference: ${this.reason(before.step === field.step)}` };
    const data = fieldBetween(before, field);
    return { data, name: `${field.name}, now − pinned`, note: "", range: [data.lowest, data.highest] };
  }

  private reason(isSameStep: boolean): string {
    return isSameStep ? "the sizes differ" : `it was pinned at step ${this.pinned?.shown.step}`;
  }
}

function widest([low, high]: [number, number], { lowest, highest }: Column): [number, number] {
  return [Math.min(low, lowest), Math.max(high, highest)];
}
