/** The gallery: models and scenes of the library with pictures, one's own files, and a search. */
import { h, icon, iconButton } from "./elements.js";
import type { Library, LibraryEntry } from "./protocol.js";
import { hasModel, openLink } from "./links.js";
import type { Studio } from "./state.js";

type Shelf = keyof Library;
const shelves: { key: Shelf; name: string }[] = [
  { key: "models", name: "Models" },
  { key: "scenes", name: "Scenes" },
  { key: "files", name: "My files" },
];

export class Gallery {
  readonly element = h("section", "gallery", { "aria-label": "Gallery", hidden: true });
  private readonly search = h("input", "search", {
    type: "search",
    placeholder: "Search, or paste a link",
    "aria-label": "Search the gallery",
  });
  private readonly list = h("div", "cards", { role: "tabpanel", "aria-label": "Models and scenes" });
  /** What had the focus before. */
  private before: Element | null = null;
  /** What it covers, which keys must not reach meanwhile. */
  behind: HTMLElement[] = [];
  private readonly close: HTMLButtonElement;
  private library: Library | null = null;
  private shelf: Shelf = "models";
  private readonly pictures = new Map<number, Promise<string>>();
  private readonly lazily: IntersectionObserver;
  private readonly buttons: Map<Shelf, HTMLButtonElement>;

  constructor(
    private readonly studio: Studio,
    private readonly opened: () => void,
  ) {
    this.close = iconButton("close", "Back to the plant", () => this.hide());
    this.buttons = new Map(
      shelves.map(({ key, name }) => [key, h("button", "tab", { type: "button", role: "tab", onclick: () => this.choose(key) }, name)]),
    );
    this.element.append(
      h(
        "header",
        "",
        {},
        h(
          "div",
          "",
          {},
          h("h1", "", {}, "What shall grow?"),
          h("p", "", {}, "Open a model or a scene: it grows at once, and you can change everything in it."),
        ),
        this.close,
      ),
      h(
        "div",
        "gallery-bar",
        {},
        h("div", "tabs", { role: "tablist", "aria-label": "Shelves" }, ...this.buttons.values()),
        h("label", "search-box", {}, icon("search"), this.search),
      ),
      this.list,
    );
    this.search.addEventListener("input", () => {
      if (hasModel(this.search.value)) void this.openLink(this.search.value);
      else this.draw();
    });
    this.element.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && this.studio.document) this.hide();
    });
    this.lazily = new IntersectionObserver(
      (entries) => {
        for (const entry of entries) if (entry.isIntersecting) void this.fill(entry.target as HTMLElement);
      },
      { rootMargin: "300px" },
    );
  }

  async show(): Promise<void> {
    if (this.element.hidden) this.before = document.activeElement;
    this.element.hidden = false;
    for (const element of this.behind) element.inert = true;
    this.close.hidden = !this.studio.document;
    this.library = (await this.studio.ask("library", {})) ?? this.library;
    this.draw();
    this.search.focus({ preventScroll: true });
  }

  hide(): void {
    this.element.hidden = true;
    for (const element of this.behind) element.inert = false;
    if (this.before instanceof HTMLElement) this.before.focus();
  }

  private choose(shelf: Shelf): void {
    this.shelf = shelf;
    this.search.value = "";
    this.draw();
  }

  private draw(): void {
    for (const [key, button] of this.buttons) button.setAttribute("aria-selected", String(key === this.shelf));
    const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const fits = (entry: LibraryEntry) => {
      const text = `${entry.name} ${entry.summary} ${entry.path}`.toLowerCase();
      return words.every((word) => text.includes(word));
    };
    // A search looks on every shelf.
    const all = this.library ?? { models: [], scenes: [], files: [] };
    const entries = words.length > 0 ? [...all.models, ...all.scenes, ...all.files].filter(fits) : all[this.shelf];
    const folders = new Map<string, LibraryEntry[]>();
    for (const entry of entries) folders.set(entry.folder, [...(folders.get(entry.folder) ?? []), entry]);
    const pictured = (list: LibraryEntry[]) => list.filter(({ picture }) => picture !== null);
    const ordered = [...folders].sort(([, a], [, b]) => Number(pictured(b).length > 0) - Number(pictured(a).length > 0));
    this.list.replaceChildren(
      ...ordered.map(([folder, inside]) =>
        h(
          "section",
          "",
          {},
          h("h2", "", {}, folder || "Folder"),
          h("div", "card-grid", {}, ...pictured(inside).map((entry) => this.card(entry))),
          h("div", "card-grid plain", {}, ...inside.filter(({ picture }) => picture === null).map((entry) => this.card(entry))),
        ),
      ),
    );
    if (entries.length === 0)
      this.list.append(h("p", "hint", {}, words.length > 0 ? "Nothing has these words." : "There is nothing here."));
  }

  private card(entry: LibraryEntry): HTMLElement {
    const picture = entry.picture === null ? null : h("div", "card-picture", { "data-picture": entry.picture }, icon("layers"));
    if (picture) this.lazily.observe(picture);
    return h(
      "button",
      "card",
      { type: "button", title: entry.path, onclick: () => void this.open(entry) },
      picture,
      h("strong", "", {}, entry.name),
      h("span", "", {}, entry.summary),
    );
  }

  private async fill(place: HTMLElement): Promise<void> {
    this.lazily.unobserve(place);
    const number = Number(place.dataset.picture);
    const address = this.pictures.get(number) ?? this.studio.connection.file(number).then((blob) => URL.createObjectURL(blob));
    this.pictures.set(number, address);
    try {
      const picture = h("img", "", { src: await address, alt: "" });
      await picture.decode();
      place.replaceChildren(picture);
    } catch {
      this.pictures.delete(number);
    }
  }

  private async openLink(link: string): Promise<void> {
    this.search.value = "";
    if (await openLink(this.studio, link)) this.leave();
  }

  private leave(): void {
    this.opened();
    this.hide();
  }

  private async open(entry: LibraryEntry): Promise<void> {
    const opened = await this.studio.ask("open", { path: entry.path });
    if (opened) this.leave();
  }
}
