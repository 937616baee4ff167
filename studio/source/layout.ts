/** The arrangement of the page: panels beside the picture, whose sizes are remembered. */
import { h, remember, remembered } from "./elements.js";

interface Sizes {
  left: number;
  right: number;
  leftOpen: boolean;
  rightOpen: boolean;
}

/** Where the page is too narrow for panels beside the picture, one may stand below it, none at first. */
const narrow = matchMedia("(max-width: 720px)");

const narrowest = 220; // pixels of a panel

const usual: Sizes = { left: 400, right: 330, leftOpen: true, rightOpen: true };

export class Layout {
  readonly element: HTMLElement;
  readonly left = h("aside", "panel left", { "aria-label": "Texts" });
  readonly right = h("aside", "panel right", { "aria-label": "Settings and measurements" });
  readonly centre = h("main", "centre");
  private sizes: Sizes = { ...usual, ...remembered<Partial<Sizes>>("sizes", {}) };
  private readonly handles: { left?: HTMLElement; right?: HTMLElement } = {};
  private below: "left" | "right" | null = null;
  /** Called when the picture may have another size. */
  changed: () => void = () => undefined;

  constructor() {
    this.element = h("div", "columns", {}, this.left, this.handle("left"), this.centre, this.handle("right"), this.right);
    narrow.addEventListener("change", () => this.apply());
    this.apply();
  }

  toggle(side: "left" | "right"): void {
    this.setOpen(side, !this.isOpen(side));
  }

  isOpen(side: "left" | "right"): boolean {
    if (narrow.matches) return this.below === side;
    return side === "left" ? this.sizes.leftOpen : this.sizes.rightOpen;
  }

  setOpen(side: "left" | "right", open: boolean): void {
    if (narrow.matches) this.below = open ? side : null;
    else if (side === "left") this.sizes.leftOpen = open;
    else this.sizes.rightOpen = open;
    this.apply();
  }

  private apply(): void {
    const { left, right } = this.sizes;
    this.left.hidden = !this.isOpen("left");
    this.right.hidden = !this.isOpen("right");
    // The picture keeps two fifths of the width.
    this.element.style.setProperty("--left", this.left.hidden ? "0px" : `min(${left}px, 32vw)`);
    this.element.style.setProperty("--right", this.right.hidden ? "0px" : `min(${right}px, 28vw)`);
    remember("sizes", this.sizes);
    this.changed();
  }

  private resize(side: "left" | "right", width: number): void {
    const most = Math.max(240, window.innerWidth - (side === "left" ? this.sizes.right : this.sizes.left) - 320);
    const size = Math.round(Math.min(most, Math.max(narrowest, width)));
    this.sizes[side] = size;
    this.handles[side]?.setAttribute("aria-valuenow", String(size));
    this.apply();
  }

  private handle(side: "left" | "right"): HTMLElement {
    const label = side === "left" ? "Width of the texts" : "Width of the settings";
    const handle = h("div", "handle", {
      role: "separator",
      tabindex: 0,
      "aria-orientation": "vertical",
      "aria-label": label,
      "aria-valuemin": narrowest,
      "aria-valuenow": this.sizes[side],
    });
    this.handles[side] = handle;
    handle.addEventListener("pointerdown", (event) => handle.setPointerCapture(event.pointerId));
    handle.addEventListener("pointermove", (event) => {
      if (!handle.hasPointerCapture(event.pointerId)) return;
      const box = this.element.getBoundingClientRect();
      this.resize(side, side === "left" ? event.clientX - box.left : box.right - event.clientX);
    });
    handle.addEventListener("keydown", (event) => {
      const step = event.key === "ArrowLeft" ? -24 : event.key === "ArrowRight" ? 24 : 0;
      if (step === 0) return;
      event.preventDefault();
      this.resize(side, this.sizes[side] + (side === "left" ? step : -step));
    });
    handle.addEventListener("dblclick", () => this.resize(side, usual[side]));
    return handle;
  }
}

export interface Tab {
  name: string;
  content: HTMLElement;
}

/** Panels of which one shows, chosen by tabs. */
export class Tabs {
  readonly element: HTMLElement;
  private readonly tabs: (Tab & { button: HTMLButtonElement })[];

  constructor(
    label: string,
    tabs: readonly [Tab, ...Tab[]],
    private readonly key: string,
  ) {
    this.tabs = tabs.map((tab) => {
      const button = h("button", "tab", { type: "button", role: "tab", onclick: () => this.show(tab.name) }, tab.name);
      tab.content.setAttribute("role", "tabpanel");
      tab.content.setAttribute("aria-label", tab.name);
      return { ...tab, button };
    });
    const bar = h("div", "tabs", { role: "tablist", "aria-label": label }, ...this.tabs.map(({ button }) => button));
    bar.addEventListener("keydown", (event) => this.step(event));
    this.element = h("div", "tabbed", {}, bar, ...tabs.map(({ content }) => content));
    this.show(remembered(key, tabs[0].name));
  }

  /** A name that is no tab shows the first one. */
  show(name: string): void {
    const chosen = this.tabs.find((tab) => tab.name === name) ?? this.tabs[0];
    for (const tab of this.tabs) {
      tab.content.hidden = tab !== chosen;
      tab.button.setAttribute("aria-selected", String(tab === chosen));
      tab.button.tabIndex = tab === chosen ? 0 : -1;
    }
    remember(this.key, chosen?.name ?? name);
  }

  /** Shows or hides a tab whose panel may have nothing to show. */
  offer(name: string, offered: boolean): void {
    const tab = this.tabs.find((one) => one.name === name);
    if (!tab) return;
    tab.button.hidden = !offered;
    if (!offered && tab.button.getAttribute("aria-selected") === "true") this.show("");
  }

  private step(event: KeyboardEvent): void {
    const by = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (by === 0) return;
    const from = this.tabs.findIndex(({ button }) => button === document.activeElement);
    const next = this.tabs[(from + by + this.tabs.length) % this.tabs.length];
    next?.button.focus();
    next?.button.click();
  }
}
