/** What a shared page tells of the organ that was clicked at. */
import { at } from "../lists.js";

/** All organs of a recording, as columns: src/studio/server/shared_organs.h. */
export interface OrganTable {
  symbols: string[];
  plants: Record<string, string>;
  identity: string[];
  symbol: number[];
  plant: number[];
  born: number[];
  order: number[];
  parent: number[];
}

/** A step's modules: their organs and their parameters. */
export interface OrganMoment {
  organ: number[];
  parameters: Record<string, (number | null)[]>;
  units: Record<string, string>;
}

type Row = [string, string];

function element(name: string, className: string, ...children: (Node | string)[]): HTMLElement {
  const made = document.createElement(name);
  made.className = className;
  made.append(...children);
  return made;
}

function nameOf(table: OrganTable, organ: number): string {
  return at(table.symbols, at(table.symbol, organ));
}

function identityRows(table: OrganTable, organ: number): Row[] {
  const parent = at(table.parent, organ);
  const plant = at(table.plant, organ);
  return [
    ["Plant", table.plants[plant] || String(plant)],
    ["Born in step", String(at(table.born, organ))],
    ["Order", String(at(table.order, organ))],
    ...(parent < 0 ? [] : [["Parent", `${nameOf(table, parent)}, born in step ${at(table.born, parent)}`] satisfies Row]),
    ["Identity", at(table.identity, organ)],
  ];
}

function parameterRows(moment: OrganMoment, module: number): Row[] {
  return Object.entries(moment.parameters).flatMap(([name, values]) => {
    const value = values[module];
    const unit = moment.units[name];
    return value === null || value === undefined ? [] : [[name, unit ? `${value} ${unit}` : `${value}`] satisfies Row];
  });
}

function list(rows: Row[]): HTMLElement {
  return element("dl", "facts", ...rows.flatMap(([name, value]) => [element("dt", "", name), element("dd", "", value)]));
}

export class OrganCard {
  readonly element = element("aside", "organ-card");
  private readonly close: HTMLElement;

  constructor(closed: () => void) {
    this.close = element("button", "button", "Close");
    this.close.addEventListener("click", closed);
    this.element.hidden = true;
    this.element.setAttribute("aria-label", "Organ");
    this.element.setAttribute("aria-live", "polite");
  }

  hide(): void {
    this.element.hidden = true;
  }

  /** `moment` is null where the step at hand does not show the organ. */
  show(table: OrganTable, organ: number, moment: OrganMoment | null, module: number): void {
    const parts = [
      element("div", "pick-head", element("code", "", nameOf(table, organ)), this.close),
      list(identityRows(table, organ)),
    ];
    if (!moment) parts.push(element("p", "hint", "This step does not show the organ."));
    const rows = moment ? parameterRows(moment, module) : [];
    if (rows.length > 0) parts.push(element("h3", "", "Parameters and quantities"), list(rows));
    this.element.replaceChildren(...parts);
    this.element.hidden = false;
  }
}
