/** Small helpers to build the page. */

type Attributes = Record<string, string | number | boolean | ((event: Event) => void) | null | undefined>;
type Child = Node | string | null | undefined | false;

/**
 * Makes an element: `h("button.primary", { onclick }, "Open")`. An attribute that is a function is a listener; true is present,
 * false and null are absent.
 */
export function h<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  classes: string,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  if (classes) element.className = classes;
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name.replace(/^on/, ""), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, String(value));
  }
  for (const child of children) if (child) element.append(child);
  return element;
}

/** Paths of the icons, drawn in a square of 24. */
const icons = {
  play: "M8 5v14l11-7z",
  pause: "M7 5h3.5v14H7zM13.5 5H17v14h-3.5z",
  stop: "M6 6h12v12H6z",
  first: "M6 5h2.5v14H6zM19 5v14l-9-7z",
  last: "M15.5 5H18v14h-2.500zM5 5v14l9-7z",
  forward: "M7 5v14l8-7zM15.5 5H18v14h-2.500z",
  back: "M17 5v14l-8-7zM6 5h2.500v14H6z",
  grow: "M12 3l6 7h-4v5h-4v-5H6zM5 18h14v2.500H5z",
  undo: "M9 14L4 9l5-5M4 9h10a6 6 0 0 1 0 12h-3",
  redo: "M15 14l5-5-5-5M20 9H10a6 6 0 0 0 0 12h3",
  gallery: "M4 4h7v7H4zM13 4h7v7h-7zM4 13h7v7H4zM13 13h7v7h-7z",
  save: "M5 4h11l3 3v13H5zM8 4v5h7V4M8 20v-6h8v6",
  share: "M12 15V4M8 7.500L12 3.500l4 4M6 11H5v9h14v-9h-1",
  camera: "M4 8h4l1.5-2.500h5L16 8h4v11H4zM12 10.200a3.2 3.2 0 1 0 0 6.400 3.2 3.2 0 1 0 0-6.400",
  film: "M4 6h11v12H4zM15 10.500l5-3v9l-5-3",
  fit: "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5",
  home: "M4 11.500L12 4l8 7.500M6.5 10v10h11V10",
  dice: "M5 4.5h14v15H5zM8.7 8.5h.6M14.700 8.500h.6M11.700 12h.6M8.700 15.500h.6M14.700 15.500h.6",
  sun: "M12 7.500a4.5 4.5 0 1 0 0 9 4.5 4.5 0 1 0 0-9M12 2v2.500M12 19.500V22M2 12h2.500M19.5 12H22M5 5l1.700 1.700M17.300 17.300L19 19M5 19l1.700-1.700M17.300 6.700L19 5",
  close: "M6 6l12 12M18 6L6 18",
  reset: "M5 12a7 7 0 1 1 2 5M5 12V7M5 12h5",
  help: "M9 9a3 3 0 1 1 4.5 2.600c-1 .6-1.5 1.100-1.5 2.400M12 17.500h.01M12 3a9 9 0 1 0 0 18 9 9 0 1 0 0-18",
  left: "M4 5h16v14H4zM9.5 5v14",
  right: "M4 5h16v14H4zM14.5 5v14",
  plus: "M12 5v14M5 12h14",
  pin: "M9 3h6l-1 6 4 4H6l4-4zM12 13v8",
  search: "M10.5 4a6.5 6.5 0 1 0 0 13 6.5 6.5 0 1 0 0-13M15.5 15.500L20 20",
  curve: "M4 19C9 19 9 5 20 5M4 19h.01M20 5h.01",
  layers: "M12 4l8 4-8 4-8-4zM4 12l8 4 8-4M4 16l8 4 8-4",
} as const;

export type IconName = keyof typeof icons;
const solid = new Set<IconName>(["play", "pause", "stop", "first", "last", "forward", "back", "grow"]);

/** Makes an element of a drawing, as `h` makes one of the page. */
export function svg<Tag extends keyof SVGElementTagNameMap>(
  tag: Tag,
  attributes: Record<string, string | number>,
  ...children: (Node | string)[]
): SVGElementTagNameMap[Tag] {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

export function icon(name: IconName): SVGElement {
  const style = solid.has(name) ? "solid" : "line";
  return svg("svg", { viewBox: "0 0 24 24", "aria-hidden": "true", class: `icon ${style}` }, svg("path", { d: icons[name] }));
}

/** A button with an icon, whose name shows as a tip. */
export function iconButton(name: IconName, label: string, onclick: () => void): HTMLButtonElement {
  return h("button", "icon-button", { type: "button", title: label, "aria-label": label, onclick }, icon(name));
}

export function setIcon(button: HTMLButtonElement, name: IconName, label: string): void {
  setLabel(button, label);
  button.replaceChildren(icon(name));
}

export function setLabel(element: HTMLElement, label: string): void {
  element.title = label;
  element.setAttribute("aria-label", label);
}

/** Colours the track of a slider up to its thumb. */
export function fillSlider(slider: HTMLInputElement): void {
  const [least, most] = [Number(slider.min), Number(slider.max)];
  slider.style.setProperty("--part", String((Number(slider.value) - least) / Math.max(most - least, 1e-30)));
}

const numberFormat = new Intl.NumberFormat("en", { maximumFractionDigits: 0 });

/** 12,345 */
export function whole(value: number): string {
  return numberFormat.format(value);
}

/** A field for a number, which may be written with a decimal comma; `numberIn` reads it. */
export function decimalField(attributes: Attributes): HTMLInputElement {
  return h("input", "number", { type: "text", inputmode: "decimal", ...attributes });
}

/** What a field says, with a decimal point. */
export function numberIn(field: HTMLInputElement): string {
  return field.value.trim().replace(/^([-+]?\d*),(\d+)$/, "$1.$2");
}

/** A number with about four digits that matter. */
export function short(value: number): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "none" : String(value);
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(2);
  return String(Number(value.toPrecision(4)));
}

export function download(blob: Blob, name: string): void {
  const address = URL.createObjectURL(blob);
  const link = h("a", "", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** What stays from visit to visit, such as sizes of panels. */
export function remembered<T>(key: string, otherwise: T): T {
  try {
    const text = localStorage.getItem(`espalier.${key}`);
    return text === null ? otherwise : (JSON.parse(text) as T);
  } catch {
    return otherwise;
  }
}

export function remember(key: string, value: unknown): void {
  try {
    localStorage.setItem(`espalier.${key}`, JSON.stringify(value));
  } catch {
    // A browser that keeps nothing still shows the page.
  }
}
