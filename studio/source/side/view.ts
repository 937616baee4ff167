/** The form of a view file: its settings with what they mean, as the program reads and writes them. */
import { decimalField, fillSlider, h, iconButton, numberIn } from "../elements.js";
import type { Help, ViewEntry, ViewSetting, ViewValue } from "../protocol.js";
import { bytesOf, hexOf } from "./colours.js";
import type { SideEditor, SideText } from "./side.js";

/** Sends other values; null takes the setting out. */
type Send = (values: string | null, lasting: boolean) => void;

const groups: [ViewSetting["group"], string][] = [
  ["picture", "Light and picture"],
  ["shape", "Materials and shapes"],
  ["growth", "Turtle"],
];

/** Lights, textures and colours stand first. */
function rank({ kind }: ViewSetting): number {
  return kind === "letters" ? 0 : kind === "colour" ? 1 : 2;
}

function hexOfWords(values: readonly string[]): string {
  const numbers = values.map(Number);
  const most = Math.max(...numbers) > 1 ? 255 : 1;
  return hexOf(numbers.map((value) => Math.round((255 * Math.min(most, Math.max(0, value || 0))) / most)));
}

function colourOf(hex: string): string {
  return bytesOf(hex).map((byte) => String(Number((byte / 255).toFixed(3)))).join(" ");
}

function isNumber(text: string): boolean {
  return text !== "" && Number.isFinite(Number(text));
}

function numberControl(value: ViewValue, text: string, label: string, send: Send): HTMLElement[] {
  const field = decimalField({ "aria-label": label, placeholder: value.standard });
  field.value = text;
  field.addEventListener("change", () => field.value.trim() && send(numberIn(field), true));
  const unit = h("span", "unit", {}, value.unit);
  if (value.lowest === null || value.highest === null || (text !== "" && !isNumber(text))) return [field, unit];
  const step = value.kind === "whole" ? 1 : 10 ** Math.floor(Math.log10((value.highest - value.lowest) / 150));
  const now = text || value.standard || "0";
  const slider = h("input", "", { type: "range", min: value.lowest, max: value.highest, step, value: now, "aria-label": label });
  fillSlider(slider);
  const moved = (lasting: boolean) => () => {
    fillSlider(slider);
    field.value = String(Number(Number(slider.value).toPrecision(8)));
    send(field.value, lasting);
  };
  slider.addEventListener("input", moved(false));
  slider.addEventListener("change", moved(true));
  return [slider, field, unit];
}

function vectorControl(value: ViewValue, values: readonly string[], label: string, send: Send): HTMLElement[] {
  const standard = value.standard.split(/[\s,]+/);
  const fields = ["x", "y", "z"].map((axis, k) => {
    const field = decimalField({ "aria-label": `${label} ${axis}`, title: axis });
    field.value = values[k] ?? "";
    field.placeholder = standard[k] || "0";
    field.addEventListener("change", () =>
      send(fields.map((one, i) => numberIn(one) || standard[i] || "0").join(" "), true),
    );
    return field;
  });
  return fields;
}

function colourControl(value: ViewValue, values: readonly string[], label: string, send: Send): HTMLElement[] {
  const shown = values.length === 3 && values.every(isNumber) ? values : value.standard.split(" ");
  const input = h("input", "", { type: "color", "aria-label": label, value: hexOfWords(shown) });
  input.addEventListener("input", () => send(colourOf(input.value), false));
  input.addEventListener("change", () => send(colourOf(input.value), true));
  return [input];
}

function wordControl(value: ViewValue, text: string, label: string, send: Send): HTMLElement[] {
  const words = value.words.includes(text) || text === "" ? value.words : [...value.words, text];
  const select = h("select", "", { "aria-label": label }, ...words.map((word) => h("option", "", { value: word }, word)));
  select.value = text || value.standard;
  select.addEventListener("change", () => send(select.value, true));
  return [select];
}

function switchControl(value: ViewValue, text: string, label: string, send: Send): HTMLElement[] {
  const box = h("input", "switch", { type: "checkbox", role: "switch", "aria-label": label });
  box.checked = value.kind === "flag" ? text !== "" : (text || value.standard) === "on";
  box.addEventListener("change", () => send(value.kind === "flag" ? (box.checked ? "" : null) : box.checked ? "on" : "off", true));
  return [box];
}

function fileControl(text: string, label: string, send: Send): HTMLElement[] {
  const field = h("input", "wide", { type: "text", "aria-label": label, placeholder: "file" });
  field.value = text;
  field.addEventListener("change", () => field.value.trim() && send(field.value.trim(), true));
  return [field];
}

function controlOf(value: ViewValue, values: readonly string[], label: string, send: Send): HTMLElement[] {
  const text = values.join(" ");
  switch (value.kind) {
    case "number":
    case "whole":
      return numberControl(value, text, label, send);
    case "vector":
      return vectorControl(value, values, label, send);
    case "colour":
      return colourControl(value, values, label, send);
    case "word":
      return wordControl(value, text, label, send);
    case "switch":
    case "flag":
      return switchControl(value, text, label, send);
    default:
      return fileControl(text, label, send);
  }
}

/** Small controls stand beside their names, wide ones below. */
function layoutOf({ kind }: ViewValue): string {
  return ["colour", "switch", "flag", "word"].includes(kind) ? "beside" : "";
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

export class ViewForm implements SideEditor {
  readonly elements: Node[];
  private readonly place = h("div", "view-form");
  private readonly open = new Set<string>(["picture"]);
  /** Whether a button has changed which rows there are: they are drawn anew once the program has read the text. */
  private isOutdated = false;

  constructor(
    private readonly text: SideText,
    private readonly help: () => Help | null,
  ) {
    this.elements = [this.place];
    this.draw();
  }

  /** A control that is in use keeps its place. */
  reread(): void {
    if (this.text.isAhead()) return;
    if (this.isOutdated || !this.place.contains(document.activeElement)) this.draw();
  }

  private draw(): void {
    this.isOutdated = false;
    const settings = this.help()?.view ?? [];
    this.place.replaceChildren(
      ...groups.map(([group, title]) => {
        const own = settings
          .filter((setting) => setting.group === group && setting.kind !== "other")
          .sort((a, b) => rank(a) - rank(b));
        const details = h(
          "details",
          "group",
          { open: this.open.has(group) },
          h("summary", "", {}, title),
          ...own.flatMap((setting) => (setting.kind === "letters" ? this.lines(setting) : [this.row(setting)])),
        );
        details.addEventListener("toggle", () => (details.open ? this.open.add(group) : this.open.delete(group)));
        return details;
      }),
    );
  }

  /** The places of the text that say a setting, in their order. */
  private entries(setting: ViewSetting): ViewEntry[] {
    return this.text.viewEntries().filter(({ name }) => name === setting.name);
  }

  private set(setting: ViewSetting, number: number, values: string | null, lasting: boolean): void {
    this.text.setView({ name: setting.name, number, values }, lasting);
  }

  /** Adds a line or takes one out. */
  private redraw(setting: ViewSetting, number: number, values: string | null): void {
    this.isOutdated = true;
    this.set(setting, number, values, true);
  }

  private row(setting: ViewSetting): HTMLElement {
    const label = setting.name.replace(/:$/, "");
    const written = this.entries(setting).at(-1);
    const number = Math.max(0, this.entries(setting).length - 1); // the last holds
    const row = h("div", `setting ${layoutOf(setting)}${written ? " changed" : ""}`);
    const reset = iconButton("reset", `Take "${label}" out of the file: ${setting.standard || "nothing"} holds then`, () =>
      this.redraw(setting, number, null),
    );
    reset.hidden = !written;
    const send: Send = (values, lasting) => {
      row.classList.add("changed");
      reset.hidden = false;
      this.set(setting, number, values, lasting);
    };
    const name = h("label", "", { title: setting.values }, capital(label), h("small", "", {}, ` ${setting.help}`));
    row.append(
      h("div", "setting-head", {}, name, reset),
      h("div", "control slider", {}, ...controlOf(setting, written?.values ?? [], label, send)),
    );
    return row;
  }

  /** The lines of a setting that consists of letters, and a button for one more. */
  private lines(setting: ViewSetting): HTMLElement[] {
    const label = setting.name.replace(/:$/, "");
    const entries = this.entries(setting);
    const first = setting.letters.find(({ kind }) => kind === "vector" || kind === "file");
    const add = h(
      "button",
      "button small",
      {
        type: "button",
        title: setting.help,
        onclick: () => {
          const start = first ? `${first.letter} ${first.kind === "file" ? "FILE" : "0 1 0"}` : "";
          this.redraw(setting, entries.length, start);
        },
      },
      `Add ${label}`,
    );
    const rows = entries.map((entry, index) => this.line(setting, entry, index, entries.length));
    return [...rows, h("div", "plane-tools", {}, add, h("small", "hint", {}, setting.help))];
  }

  private line(setting: ViewSetting, entry: ViewEntry, index: number, count: number): HTMLElement {
    const label = `${setting.name.replace(/:$/, "")}${count > 1 ? ` ${index + 1}` : ""}`;
    const remove = iconButton("close", `Remove ${label}`, () => this.redraw(setting, index, null));
    return h(
      "fieldset",
      "letters",
      {},
      h("legend", "", {}, capital(label), remove),
      ...setting.letters.map((letter) => {
        const send: Send = (values, lasting) =>
          this.text.setView({ name: setting.name, number: index, letter: letter.letter, values }, lasting);
        const name = h("span", "letter-name", { title: `${letter.letter} in the file` }, capital(letter.help));
        const controls = controlOf(letter, letterValues(letter, entry), `${label}: ${letter.help}`, send);
        return h("div", `letter-row ${layoutOf(letter)}`, {}, name, h("div", "control slider", {}, ...controls));
      }),
    );
  }
}

/** A flag that stands without values is on. */
function letterValues(letter: ViewValue, { letters }: ViewEntry): string[] {
  const own = letters[letter.letter];
  return letter.kind === "flag" && own ? ["on"] : (own ?? []);
}
