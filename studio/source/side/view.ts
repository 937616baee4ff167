/** The form of a view file: its settings with what they mean, as the program says it. To change one changes the text. */
import { decimalField, fillSlider, h, iconButton, numberIn } from "../elements.js";
import type { Help, ViewSetting, ViewValue } from "../protocol.js";
import { bytesOf, hexOf } from "./colours.js";
import type { SideEditor, SideText } from "./side.js";
import { byLetter, without, withValues, writtenSettings, type Written } from "./view-text.js";

type Send = (values: string, lasting: boolean) => void;

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
  box.addEventListener("change", () => send(value.kind === "flag" ? (box.checked ? " " : "") : box.checked ? "on" : "off", true));
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

  constructor(
    private readonly text: SideText,
    private readonly help: () => Help | null,
  ) {
    this.elements = [this.place];
    this.draw();
  }

  /** A control that is in use keeps its place. */
  refresh(): void {
    if (!this.place.contains(document.activeElement)) this.draw();
  }

  private draw(): void {
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

  private written(setting: ViewSetting, index: number): Written | null {
    return writtenSettings(this.text.content(), setting).at(index) ?? null;
  }

  private row(setting: ViewSetting): HTMLElement {
    const label = setting.name.replace(/:$/, "");
    const written = this.written(setting, -1);
    const row = h("div", `setting ${layoutOf(setting)}${written ? " changed" : ""}`);
    const reset = iconButton("reset", `Take "${label}" out of the file: ${setting.standard || "nothing"} holds then`, () => {
      const now = this.written(setting, -1);
      if (now) this.text.change(without(this.text.content(), now), true);
      this.draw();
    });
    reset.hidden = !written;
    const send: Send = (values, lasting) => {
      row.classList.add("changed");
      reset.hidden = false;
      this.text.change(withValues(this.text.content(), setting, this.written(setting, -1), values), lasting);
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
    const count = writtenSettings(this.text.content(), setting).length;
    const first = setting.letters.find(({ kind }) => kind === "vector" || kind === "file");
    const add = h(
      "button",
      "button small",
      {
        type: "button",
        title: setting.help,
        onclick: () => {
          const start = first ? `${first.letter} ${first.kind === "file" ? "FILE" : "0 1 0"}` : "";
          this.text.change(withValues(this.text.content(), setting, null, start), true);
          this.draw();
        },
      },
      `Add ${label}`,
    );
    const rows = Array.from({ length: count }, (_, index) => this.line(setting, index, count));
    return [...rows, h("div", "plane-tools", {}, add, h("small", "hint", {}, setting.help))];
  }

  private line(setting: ViewSetting, index: number, count: number): HTMLElement {
    const label = `${setting.name.replace(/:$/, "")}${count > 1 ? ` ${index + 1}` : ""}`;
    const values = byLetter(this.written(setting, index)?.values ?? []);
    const remove = iconButton("close", `Remove ${label}`, () => {
      const now = this.written(setting, index);
      if (now) this.text.change(without(this.text.content(), now), true);
      this.draw();
    });
    return h(
      "fieldset",
      "letters",
      {},
      h("legend", "", {}, capital(label), remove),
      ...setting.letters.map((letter) => {
        const send: Send = (text, lasting) => this.setLetter(setting, index, letter, text, lasting);
        const name = h("span", "letter-name", { title: `${letter.letter} in the file` }, capital(letter.help));
        const controls = controlOf(letter, letterValues(letter, values), `${label}: ${letter.help}`, send);
        return h("div", `letter-row ${layoutOf(letter)}`, {}, name, h("div", "control slider", {}, ...controls));
      }),
    );
  }

  private setLetter(setting: ViewSetting, index: number, letter: ViewValue, text: string, lasting: boolean): void {
    const written = this.written(setting, index);
    const values = byLetter(written?.values ?? []);
    if (text === "") values.delete(letter.letter);
    else values.set(letter.letter, text.trim() === "" ? [] : [text]);
    // A light stands at a place or comes from a direction.
    if (setting.name === "light:" && "OV".includes(letter.letter)) values.delete(letter.letter === "O" ? "V" : "O");
    const line = [...values].map(([name, words]) => [name, ...words].join(" ")).join(" ");
    this.text.change(withValues(this.text.content(), setting, written, line), lasting);
  }
}

/** A flag that stands without values is on. */
function letterValues(letter: ViewValue, values: Map<string, string[]>): string[] {
  const own = values.get(letter.letter) ?? [];
  return letter.kind === "flag" && values.has(letter.letter) ? ["on"] : own;
}
