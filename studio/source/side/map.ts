/** The editor of colour maps: 256 colours, of which ranges are blended from one colour to another. */
import { h } from "../elements.js";
import { fromBase64, toBase64, vectorOf } from "../view/index.js";
import { bytesOf, hexOf } from "./colours.js";
import type { SideEditor, SideText } from "./side.js";

const colours = 256;
const perRow = 32;

export class MapEditor implements SideEditor {
  readonly elements: Node[];
  private readonly grid = h("div", "colour-grid", { role: "group", "aria-label": "Colours of the map" });
  private readonly from = h("input", "number", {
    type: "number",
    min: 0,
    max: colours - 1,
    value: 0,
    "aria-label": "First colour of the range",
  });
  private readonly to = h("input", "number", {
    type: "number",
    min: 0,
    max: colours - 1,
    value: 0,
    "aria-label": "Last colour of the range",
  });
  private readonly first = h("input", "", { type: "color", "aria-label": "Colour at the beginning of the range" });
  private readonly last = h("input", "", { type: "color", "aria-label": "Colour at the end of the range" });
  private readonly cells: HTMLButtonElement[];
  private bytes: Uint8Array;

  constructor(private readonly text: SideText) {
    this.bytes = fromBase64(text.content());
    this.cells = Array.from({ length: colours }, (_, index) => this.cell(index));
    this.grid.append(...this.cells);
    for (const input of [this.from, this.to]) input.addEventListener("change", () => this.showRange());
    const blend = (lasting: boolean) => () => this.blend(lasting);
    for (const input of [this.first, this.last]) {
      input.addEventListener("input", blend(false));
      input.addEventListener("change", blend(true));
    }
    this.elements = [
      this.grid,
      h("div", "plane-tools", {}, "From ", this.from, this.first, " to ", this.to, this.last),
      h(
        "p",
        "hint",
        {},
        "Click a colour to begin a range, and another one with Shift to end it. A new colour at either end blends the range.",
      ),
    ];
    this.refresh();
  }

  refresh(): void {
    this.bytes = fromBase64(this.text.content());
    this.paint();
    this.showRange();
  }

  private paint(): void {
    this.cells.forEach((cell, index) => {
      cell.style.background = hexOf(this.bytes, 3 * index);
    });
  }

  private cell(index: number): HTMLButtonElement {
    return h("button", "", {
      type: "button",
      "aria-label": `Colour ${index}`,
      title: String(index),
      tabindex: index % perRow === 0 ? 0 : -1,
      onclick: (event) => this.choose(index, (event as MouseEvent).shiftKey),
      onkeydown: (event) => this.key(event as KeyboardEvent, index),
    });
  }

  private key(event: KeyboardEvent, index: number): void {
    const by = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -perRow, ArrowDown: perRow }[event.key];
    const next = by === undefined ? undefined : this.cells[index + by];
    if (!next) return;
    event.preventDefault();
    next.focus();
  }

  private choose(index: number, extend: boolean): void {
    if (extend) this.to.value = String(index);
    else this.from.value = this.to.value = String(index);
    if (Number(this.from.value) > Number(this.to.value)) [this.from.value, this.to.value] = [this.to.value, this.from.value];
    this.showRange();
  }

  private showRange(): void {
    const [from, to] = [Number(this.from.value), Number(this.to.value)];
    this.cells.forEach((cell, index) => cell.classList.toggle("chosen", index >= from && index <= to));
    this.first.value = hexOf(this.bytes, 3 * from);
    this.last.value = hexOf(this.bytes, 3 * to);
  }

  private blend(lasting: boolean): void {
    const [from, to] = [Number(this.from.value), Number(this.to.value)];
    const [start, end] = [bytesOf(this.first.value), bytesOf(this.last.value)];
    const last = from === to && document.activeElement === this.last ? this.last : null;
    for (let index = from; index <= to; index++) {
      const part = to > from ? (index - from) / (to - from) : last ? 1 : 0;
      this.bytes.set(
        vectorOf((k) => Math.round(start[k] * (1 - part) + end[k] * part)),
        3 * index,
      );
    }
    this.paint();
    this.text.change(toBase64(this.bytes), lasting);
  }
}
