/** The editor of material files (docs/side-files.md): entries of fifteen bytes, each a material by its colour index. */
import { fillSlider, h } from "../elements.js";
import { at } from "../lists.js";
import { fromBase64, toBase64 } from "../view/index.js";
import { bytesOf, hexOf } from "./colours.js";
import type { SideEditor, SideText } from "./side.js";

const entry = 15;
const most = 255;

/** Places of the parts of a material among its bytes. */
const colours: [string, number, string][] = [
  ["Diffuse", 5, "what it scatters: its colour in even light"],
  ["Emissive", 8, "what it emits, also in shadow"],
  ["Ambient", 2, "kept for other programs"],
  ["Specular", 11, "kept for other programs"],
];
const numbers: [string, number, string][] = [
  ["Transparency", 1, "0 is opaque, 255 cannot be seen"],
  ["Shininess", 14, "kept for other programs"],
];

export class MaterialEditor implements SideEditor {
  readonly elements: Node[];
  private readonly swatches = h("div", "swatches", { role: "listbox", "aria-label": "Materials" });
  private readonly form = h("div", "material-form");
  private bytes: Uint8Array;
  private chosen = 0;

  constructor(private readonly text: SideText) {
    this.bytes = fromBase64(text.content());
    const index = h("input", "number", {
      type: "number",
      min: 0,
      max: most,
      value: this.free(),
      "aria-label": "Index of a new material",
    });
    const add = h("button", "button small", { type: "button", onclick: () => this.add(Number(index.value)) }, "Add material");
    const remove = h("button", "button small", { type: "button", onclick: () => this.remove() }, "Remove");
    this.elements = [this.swatches, this.form, h("div", "plane-tools", {}, index, add, remove)];
    this.draw();
  }

  refresh(): void {
    this.bytes = fromBase64(this.text.content());
    this.chosen = Math.min(this.chosen, Math.max(0, this.count - 1));
    if (!this.form.contains(document.activeElement)) this.draw();
    else this.drawSwatches();
  }

  private get count(): number {
    return Math.floor(this.bytes.length / entry);
  }

  private free(): number {
    const taken = new Set(Array.from({ length: this.count }, (_, i) => this.bytes[i * entry]));
    let index = 1;
    while (taken.has(index) && index < most) index++;
    return index;
  }

  private hex(place: number): string {
    return hexOf(this.bytes, this.chosen * entry + place);
  }

  private draw(): void {
    this.drawSwatches();
    if (this.count === 0) {
      this.form.replaceChildren(h("p", "hint", {}, "This file has no material yet."));
      return;
    }
    this.form.replaceChildren(
      ...colours.map(([name, at, help]) => this.row(name, help, this.colour(name, at))),
      ...numbers.map(([name, at, help]) => this.row(name, help, ...this.number(name, at))),
    );
  }

  private row(name: string, help: string, ...controls: HTMLElement[]): HTMLElement {
    const label = h("span", "letter-name", {}, name, h("small", "", {}, ` ${help}`));
    return h("div", `letter-row${controls.length === 1 ? " beside" : ""}`, {}, label, h("div", "control slider", {}, ...controls));
  }

  private drawSwatches(): void {
    const shown = (i: number) => {
      const part = (k: number) => Math.min(most, at(this.bytes, i * entry + 5 + k) + at(this.bytes, i * entry + 8 + k));
      return `rgb(${part(0)}, ${part(1)}, ${part(2)})`;
    };
    this.swatches.replaceChildren(
      ...Array.from({ length: this.count }, (_, i) => {
        const sample = h("span", "sample");
        sample.style.background = shown(i);
        const index = this.bytes[i * entry];
        return h(
          "button",
          "swatch",
          {
            type: "button",
            role: "option",
            "aria-selected": String(i === this.chosen),
            "aria-label": `Material ${index}`,
            onclick: () => {
              this.chosen = i;
              this.draw();
            },
          },
          sample,
          String(index),
        );
      }),
    );
  }

  private colour(name: string, place: number): HTMLElement {
    const input = h("input", "", { type: "color", "aria-label": name, value: this.hex(place) });
    const send = (lasting: boolean) => () => {
      this.bytes.set(bytesOf(input.value), this.chosen * entry + place);
      this.send(lasting);
    };
    input.addEventListener("input", send(false));
    input.addEventListener("change", send(true));
    return input;
  }

  private number(name: string, place: number): HTMLElement[] {
    const value = this.bytes[this.chosen * entry + place];
    const slider = h("input", "", { type: "range", min: 0, max: most, step: 1, value, "aria-label": name });
    const field = h("output", "field-value", {}, String(value));
    const send = (lasting: boolean) => () => {
      fillSlider(slider);
      field.textContent = slider.value;
      this.put(place, Number(slider.value));
      this.send(lasting);
    };
    fillSlider(slider);
    slider.addEventListener("input", send(false));
    slider.addEventListener("change", send(true));
    return [slider, field];
  }

  private put(place: number, value: number): void {
    this.bytes[this.chosen * entry + place] = value;
  }

  private send(lasting: boolean): void {
    this.drawSwatches();
    this.text.change(toBase64(this.bytes), lasting);
  }

  /** A new material begins as the chosen one. */
  private add(index: number): void {
    const fresh = new Uint8Array(entry);
    fresh.set([0, 0, 90, 90, 90, 180, 180, 180]);
    if (this.count > 0) fresh.set(this.bytes.subarray(this.chosen * entry, (this.chosen + 1) * entry));
    fresh[0] = Math.min(most, Math.max(0, Math.round(index)));
    const bytes = new Uint8Array((this.count + 1) * entry);
    bytes.set(this.bytes.subarray(0, this.count * entry));
    bytes.set(fresh, this.count * entry);
    this.bytes = bytes;
    this.chosen = this.count - 1;
    this.text.change(toBase64(this.bytes), true);
    this.draw();
  }

  /** The last one stays: a file without entries is none. */
  private remove(): void {
    if (this.count <= 1) return;
    const at = this.chosen * entry;
    this.bytes = new Uint8Array([...this.bytes.subarray(0, at), ...this.bytes.subarray(at + entry)]);
    this.chosen = Math.max(0, this.chosen - 1);
    this.text.change(toBase64(this.bytes), true);
    this.draw();
  }
}
