/** The gallery: models and scenes of the library with pictures, one's own files, and a search. */
import { h, icon, iconButton } from "./elements.js";
import type { Library, LibraryEntry } from "./protocol.js";
import { hasModel, openLink } from "./links.js";
import type { Studio } from "./state.js";

const everything = "All";
const ownFiles = "My files";

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
  private shelf = everything;
  private readonly pictures = new Map<number, Promise<string>>();
  private readonly lazily: IntersectionObserver;
  private readonly tabs = h("div", "tabs", { role: "tablist", "aria-label": "Shelves" });
  private buttons = new Map<string, HTMLButtonElement>();

  constructor(
    private readonly studio: Studio,
    private readonly opened: () => void,
  ) {
    this.close = iconButton("close", "Back to the plant", () => this.hide());
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
          h("p", "", {}, "Open a model or a scene: it grows at once, and you can change everything in it. ", lessonsLink()),
        ),
        this.close,
      ),
      h(
        "div",
        "gallery-bar",
        {},
        this.tabs,
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
    const shelves = new Set(this.library?.library.map(({ shelf }) => shelf));
    this.buttons = new Map([everything, ...shelves, ownFiles].map((shelf) => [shelf, this.tab(shelf)]));
    this.tabs.replaceChildren(...this.buttons.values());
    this.draw();
    this.search.focus({ preventScroll: true });
  }

  hide(): void {
    this.element.hidden = true;
    for (const element of this.behind) element.inert = false;
    if (this.before instanceof HTMLElement) this.before.focus();
  }

  private choose(shelf: string): void {
    this.shelf = shelf;
    this.search.value = "";
    this.draw();
    this.element.scrollTop = 0;
  }

  private draw(): void {
    const { library, files } = this.library ?? { library: [], files: [] };
    const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const fits = ({ name, summary, path, shelf }: LibraryEntry) => {
      const text = `${name} ${summary} ${path} ${shelf}`.toLowerCase();
      return words.every((word) => text.includes(word));
    };
    const onShelf = this.shelf === ownFiles ? files : library.filter(({ shelf }) => [everything, shelf].includes(this.shelf));
    // A search looks on every shelf.
    const shown = words.length > 0 ? everything : this.shelf;
    for (const [shelf, button] of this.buttons) button.setAttribute("aria-selected", String(shelf === shown));
    const entries = words.length > 0 ? [...library, ...files].filter(fits) : onShelf;
    const sections = new Map<string, LibraryEntry[]>();
    for (const entry of entries) sections.set(entry.shelf, [...(sections.get(entry.shelf) ?? []), entry]);
    this.list.replaceChildren(...[...sections].map(([shelf, inside]) => this.section(shelf, inside)));
    if (entries.length === 0)
      this.list.append(h("p", "hint", {}, words.length > 0 ? "Nothing has these words." : "There is nothing here."));
  }

  private tab(shelf: string): HTMLButtonElement {
    return h("button", "tab", { type: "button", role: "tab", onclick: () => this.choose(shelf) }, shelf);
  }

  private section(shelf: string, entries: LibraryEntry[]): HTMLElement {
    const plain = entries.filter(({ picture }) => picture === null);
    return h(
      "section",
      "",
      {},
      h("h2", "", {}, shelf || "Folder"),
      h("div", "card-grid", {}, ...entries.filter(({ picture }) => picture !== null).map((entry) => this.card(entry))),
      h("div", "card-grid plain", {}, ...plain.map((entry) => this.card(entry))),
    );
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

/** A site says where its lessons are. */
function lessonsLink(): HTMLElement | null {
  const { lessons } = document.documentElement.dataset;
  return lessons ? h("a", "", { href: lessons }, "Lessons of two minutes") : null;
}
