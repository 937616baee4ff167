/** The settings of the document: sliders, switches, choices and numbers, in groups. */
import type { Changes } from "./changes.js";
import { decimalField, fillSlider, h, icon, iconButton, numberIn, short } from "./elements.js";
import { asLaidOut, byHeading, type Group, type ShownSetting } from "./panels.js";
import type { Setting, StudioDocument } from "./protocol.js";
import type { Studio } from "./state.js";

/** A row of the panel that can be brought up to date without losing the pointer that drags it. */
interface Row {
  element: HTMLElement;
  update: (setting: ShownSetting) => void;
}

/** The name of a setting, and what it says beside: "crown width: of the ellipsoid" has both. */
export function partsOf({ label, name }: Setting): [string, string] {
  const at = label.indexOf(": ");
  const own = (at < 0 ? label : label.slice(0, at)) || name;
  return [own.charAt(0).toUpperCase() + own.slice(1), at < 0 ? "" : label.slice(at + 2)];
}

type Send = (text: string | null, lasting: boolean) => void;

function isSwitch(setting: Setting): boolean {
  return setting.kind === "switch" || (setting.whole && setting.lowest === 0 && setting.highest === 1);
}

/** The ends of a slider: those of the setting, or a span around its default. */
export function span(setting: ShownSetting): { lowest: number; highest: number; step: number } {
  const usual = Number(setting.default);
  const base = Number.isFinite(usual) && usual !== 0 ? usual : setting.value || 1;
  // A place may lie on either side of the origin.
  const reach = /\bpositions?(\.\d+)?\.[xyz]$/.test(setting.name) ? Math.max(5, 2 * Math.abs(base)) : null;
  const lowest = setting.lowest ?? (reach === null ? Math.min(0, 2 * base) : -reach);
  const highest = setting.highest ?? reach ?? Math.max(lowest + 1e-9, 2 * base, 0);
  const step = setting.step ?? (setting.whole ? 1 : 10 ** Math.floor(Math.log10((highest - lowest) / 150)));
  return { lowest, highest, step };
}

function sliderRow(setting: ShownSetting, send: Send): Row {
  const { lowest, highest, step } = span(setting);
  const id = `setting-${setting.name}`;
  const slider = h("input", "", { type: "range", min: lowest, max: highest, step, id });
  const number = decimalField({ "aria-label": `${setting.label}, as a number` });
  const show = (now: Setting) => {
    if (document.activeElement !== number) number.value = now.text;
    if (!slider.matches(":active")) slider.value = String(now.value);
    fillSlider(slider);
  };
  slider.addEventListener("input", () => {
    number.value = String(Number(Number(slider.value).toPrecision(8)));
    fillSlider(slider);
    send(number.value, false);
  });
  slider.addEventListener("change", () => send(String(Number(Number(slider.value).toPrecision(8))), true));
  number.addEventListener("change", () => send(numberIn(number) || null, true));
  show(setting);
  return { element: h("div", "control slider", {}, slider, number, unitOf(setting)), update: show };
}

function switchRow(setting: Setting, send: Send): Row {
  const box = h("input", "switch", { type: "checkbox", role: "switch", id: `setting-${setting.name}` });
  box.addEventListener("change", () => send(textOf(box.checked), true));
  const textOf = (on: boolean) => (setting.kind === "switch" ? String(on) : on ? "1" : "0");
  const show = (now: Setting) => (box.checked = now.text === textOf(true));
  show(setting);
  return { element: h("div", "control", {}, box), update: show };
}

function unitOf(setting: Setting): HTMLElement {
  return h("span", "unit", {}, setting.unit);
}

function controlOf(setting: ShownSetting, send: Send): Row {
  return isSwitch(setting) ? switchRow(setting, send) : sliderRow(setting, send);
}

export class SettingsPanel {
  readonly element = h("div", "settings");
  private rows = new Map<string, Row>();
  private layout = "";
  /** Whether it shows all settings of a document whose author has laid out some. */
  private showsAll = false;
  private updateSimulation: () => void = () => undefined;

  constructor(
    private readonly studio: Studio,
    private readonly changes: Changes,
    /** Names of those that it shows, in their order, and nothing else; null: all, with seed and steps. */
    private readonly chosen: string[] | null = null,
    /** Called to sweep a number through a range. */
    private readonly sweep: ((setting: Setting) => void) | null = null,
  ) {
    studio.on("document", (document) => this.show(document));
  }

  /** As the author of the document laid them out, unless all are asked for. */
  private groupsOf(document: StudioDocument): Group[] {
    if (this.chosen !== null) return byHeading(this.choose(document, this.chosen));
    return document.panels.length > 0 && !this.showsAll ? asLaidOut(document) : byHeading(document.settings);
  }

  private choose({ settings }: StudioDocument, chosen: readonly string[]): Setting[] {
    const known = chosen.flatMap((name) => settings.filter((setting) => setting.name === name));
    const groups = new Set(known.map(({ group }) => group)).size;
    return known.map((setting) => ({ ...setting, group: "", label: groups > 1 ? `${setting.label}: ${setting.group}` : setting.label }));
  }

  private show(document: StudioDocument): void {
    const groups = this.groupsOf(document);
    const layout = JSON.stringify([
      document.path,
      document.panels.length > 0,
      groups.map(({ title, columns, open, settings }) => [
        title,
        columns,
        open,
        settings.map(({ name, label, kind, lowest, highest, step, whole, unit }) => [
          name,
          label,
          kind,
          lowest,
          highest,
          step,
          whole,
          unit,
        ]),
      ]),
    ]);
    if (layout !== this.layout) this.build(document, groups);
    this.layout = layout;
    this.updateSimulation();
    for (const setting of groups.flatMap(({ settings }) => settings)) this.rows.get(setting.name)?.update(setting);
  }

  private build(document: StudioDocument, groups: readonly Group[]): void {
    this.rows = new Map();
    const parts = groups.map((group) => this.group(group, groups.length));
    if (parts.length === 0 && this.chosen === null)
      parts.push(
        h("p", "hint", {}, "This document has no settings. A line such as #define ANGLE 25 in the model becomes a slider here."),
      );
    if (this.chosen === null && document.panels.length > 0) parts.push(this.allSwitch());
    this.element.replaceChildren(...(this.chosen === null ? [this.simulation(document)] : []), ...parts);
  }

  /** Those that the author left out are there, too. */
  private allSwitch(): HTMLElement {
    const box = h("input", "switch", { type: "checkbox", role: "switch", id: "settings-all" });
    box.checked = this.showsAll;
    box.addEventListener("change", () => {
      this.showsAll = box.checked;
      if (this.studio.document) this.show(this.studio.document);
      this.element.querySelector<HTMLElement>("#settings-all")?.focus();
    });
    return h("div", "settings-all", {}, h("label", "", { for: "settings-all" }, "All settings"), box);
  }

  private group({ title, columns, open, settings }: Group, count: number): HTMLElement {
    const rows = h("div", `rows columns-${columns}`, {}, ...settings.map((setting) => this.row(setting)));
    if (count === 1 && !title) return h("section", "group", {}, rows);
    return h("details", "group", { open }, h("summary", "", {}, title || "Settings"), rows);
  }

  private row(setting: ShownSetting): HTMLElement {
    const send: Send = (text, lasting) => {
      const change = { settings: { [setting.name]: text } };
      const label = text === null ? `Reset ${setting.label}` : `${setting.label} = ${text}`;
      this.studio.emit("sliding", !lasting);
      if (lasting) this.changes.lasting(`setting ${setting.name}`, change, label);
      else this.changes.transient(`setting ${setting.name}`, change, label);
    };
    const control = controlOf(setting, send);
    const reset = iconButton("reset", `Back to ${setting.default}`, () => send(null, true));
    let latest: Setting = setting;
    const [own, more] = partsOf(setting);
    const sweep = iconButton("gallery", `Sweep ${own} …`, () => this.sweep?.(latest));
    sweep.hidden = isSwitch(setting) || this.sweep === null;
    const name = h(
      "label",
      "",
      { for: `setting-${setting.name}`, title: setting.name },
      own,
      h("small", "", {}, more ? ` ${more}` : ""),
    );
    const row = h("div", "setting", {}, h("div", "setting-head", {}, name, reset, sweep), control.element);
    this.rows.set(setting.name, {
      element: row,
      update: (now) => {
        latest = now;
        row.classList.toggle("changed", now.changed);
        reset.hidden = !now.changed;
        control.update(now);
      },
    });
    return row;
  }

  /** Seed and steps, which every document has. */
  private simulation(document: StudioDocument): HTMLElement {
    const seed = h("input", "number", { type: "number", min: 0, step: 1, id: "setting-seed" });
    const steps = h("input", "number", { type: "number", min: 0, step: 1, id: "setting-steps" });
    seed.addEventListener("change", () => this.setSeed(Number(seed.value)));
    steps.addEventListener("change", () =>
      this.changes.lasting("steps", { steps: Number(steps.value) }, `Steps = ${steps.value}`),
    );
    const dice = h(
      "button",
      "button small",
      {
        type: "button",
        title: "Another seed: another plant of the same kind",
        onclick: () => this.setSeed(Math.floor(Math.random() * 10_000)),
      },
      icon("dice"),
      "Dice",
    );
    const show = () => {
      const now = this.studio.document ?? document;
      if (window.document.activeElement !== seed) seed.value = String(now.seed);
      if (window.document.activeElement !== steps) steps.value = String(now.steps);
    };
    this.updateSimulation = show;
    show();
    return h(
      "div",
      "simulation",
      {},
      h("label", "", { for: "setting-seed" }, "Seed"),
      seed,
      dice,
      h("label", "", { for: "setting-steps" }, "Steps"),
      steps,
    );
  }

  private setSeed(seed: number): void {
    this.changes.lasting("seed", { seed }, `Seed = ${short(seed)}`);
  }
}
