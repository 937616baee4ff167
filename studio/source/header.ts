/** The bar above everything: document, undo, save, share, theme. */
import { menuButton, openDialog } from "./dialog.js";
import { h, icon, iconButton, setLabel } from "./elements.js";
import { Exporting } from "./exporting.js";
import type { Editor } from "./editor/editor.js";
import type { Changes } from "./changes.js";
import type { Layout } from "./layout.js";
import { shareHtmlDialog, shareLinkDialog } from "./share.js";
import type { Studio } from "./state.js";
import type { PlantScene } from "./view/index.js";
import { addressInside } from "./web/parts.js";

export interface HeaderParts {
  studio: Studio;
  changes: Changes;
  editor: Editor;
  layout: Layout;
  scene: PlantScene;
  gallery: () => void;
  /** What the page is called; "": as the document. */
  title: string;
}

export class Header {
  readonly element: HTMLElement;
  /** Called when what can be shared is looked at. */
  shared: () => void = () => undefined;
  private readonly name = h("h1", "document-name");
  private readonly exporting: Exporting;
  private readonly undoButton = iconButton("undo", "Undo", () => void this.step("undo"));
  private readonly redoButton = iconButton("redo", "Redo", () => void this.step("redo"));

  constructor(private readonly parts: HeaderParts) {
    const { layout, studio } = parts;
    this.exporting = new Exporting(studio);
    const save = h(
      "button",
      "button",
      { type: "button", title: "Save (Ctrl+S)", onclick: () => void this.save() },
      icon("save"),
      "Save",
    );
    const share = h("button", "button primary", { type: "button" }, icon("share"), "Share");
    this.element = h(
      "header",
      "bar",
      {},
      h(
        "a",
        "brand",
        {
          href: "#",
          "aria-label": "Espalier studio: gallery",
          onclick: (event) => {
            event.preventDefault();
            parts.gallery();
          },
        },
        h("img", "", { src: document.querySelector<HTMLLinkElement>("link[rel=icon]")?.href ?? "", alt: "" }),
        h("span", "", {}, "Espalier"),
      ),
      h("button", "button", { type: "button", onclick: () => parts.gallery() }, icon("gallery"), "Gallery"),
      this.name,
      h("span", "spread"),
      this.undoButton,
      this.redoButton,
      save,
      menuButton(share, () => this.shareEntries()),
      iconButton("left", "Show or hide the texts", () => layout.toggle("left")),
      iconButton("right", "Show or hide the settings", () => layout.toggle("right")),
      iconButton("sun", "Light or dark", () => studio.setTheme(studio.theme === "dark" ? "light" : "dark")),
      iconButton("help", "Keys and help", () => keysDialog()),
    );
    studio.on("document", () => this.show());
    this.show();
  }

  /** Undo and redo take back lasting changes, so what is being typed becomes one first. */
  async step(which: "undo" | "redo"): Promise<void> {
    this.parts.editor.sendLasting();
    await this.parts.changes.settle();
    await this.parts.studio.ask(which, {});
  }

  /** A model of the library is saved under a name of one's own. */
  async save(path?: string): Promise<void> {
    const { document } = this.parts.studio;
    if (!document) return;
    if (!path && !document.path.startsWith(`${document.folder}/`)) {
      this.saveAs();
      return;
    }
    this.parts.editor.sendLasting();
    await this.parts.changes.settle();
    const saved = await this.parts.studio.ask("save", path ? { path } : {});
    if (saved) this.parts.studio.tell("note", savedText(saved));
  }

  private show(): void {
    const { document } = this.parts.studio;
    const changed = document?.texts.some((text) => text.changed) || document?.settings.some((setting) => setting.changed);
    const name = this.parts.title || document?.name || "";
    this.name.replaceChildren(name, changed ? h("small", "", {}, "changed") : "");
    this.name.title = document?.path ?? "";
    window.document.title = name ? `${name} – Espalier studio` : "Espalier studio";
    this.undoButton.disabled = !document?.undo;
    this.redoButton.disabled = !document?.redo;
    setLabel(this.undoButton, document?.undo ? `Undo: ${document.undo} (Ctrl+Z)` : "Nothing to undo");
    setLabel(this.redoButton, document?.redo ? `Redo: ${document.redo} (Ctrl+Y)` : "Nothing to redo");
  }

  private shareEntries() {
    this.shared();
    const { studio, scene } = this.parts;
    return [
      { name: "Save as …", hint: "below the opened folder", run: () => this.saveAs() },
      { name: "Export …", hint: "glTF, OBJ, Blender and more", run: () => this.exporting.open() },
      { name: "Share as HTML …", hint: "one file that shows the growth anywhere", run: () => shareHtmlDialog(studio, scene) },
      { name: "Share as a link …", hint: "for anyone who runs a studio", run: () => void shareLinkDialog(studio) },
    ];
  }

  private suggestedPath(): string {
    const { document } = this.parts.studio;
    if (!document) return "";
    const inside = document.path.startsWith(`${document.folder}/`);
    return inside ? document.path.slice(document.folder.length + 1) : document.name;
  }

  private saveAs(): void {
    const field = h("input", "wide", { type: "text", id: "save-path", value: this.suggestedPath() });
    const form = h(
      "form",
      "form",
      {
        onsubmit: (event) => {
          event.preventDefault();
          void this.save(field.value.trim() || undefined).then(() => dialog.close());
        },
      },
      h("label", "", { for: "save-path" }, "File, below the opened folder"),
      field,
      h("div", "form-end", {}, h("button", "button primary", { type: "submit" }, "Save")),
    );
    const dialog = openDialog("Save as", form);
    field.focus();
  }
}

function savedText({ path, files }: { path: string; files: string[] }): string {
  const others = files.filter((file) => file !== path).length;
  return `Saved as ${path}${others > 0 ? `, with ${others === 1 ? "a file" : `${others} files`} that it reads` : ""}.`;
}

const keys: [string, string][] = [
  ["Arrows", "turn the plant"],
  ["+ and -", "nearer and farther"],
  ["Space, Shift", "raise and lower"],
  ["F", "show the whole plant"],
  ["Home", "first view"],
  ["Click, Escape", "an organ tells about itself; forget it"],
  ["N, B", "to the next organ along the plant, and back"],
  ["Shift and drag, right button", "move the picture"],
  ["P", "play or pause"],
  [", and .", "one step back, one step on"],
  ["Ctrl+Z, Ctrl+Y", "undo and redo; in a text: of what was typed there"],
  ["Ctrl+S", "save"],
  ["Ctrl+Space", "complete a name in the text"],
  ["Ctrl+F", "search in the text"],
  ["Tab, then Escape", "leave the text"],
];

/** A file beside the page, or a part of it. */
function licences(): HTMLElement {
  const link = h("a", "", { href: "LICENSES.txt", target: "_blank" }, "licences");
  void addressInside("LICENSES.txt").then((address) => address && link.setAttribute("href", address));
  return link;
}

function keysDialog(): void {
  openDialog(
    "Keys",
    h(
      "p",
      "",
      {},
      "Keys of the picture work when it has the focus: click it, or reach it with Tab. Rest the pointer on a word of a text to read what it means.",
    ),
    h(
      "dl",
      "facts keys",
      {},
      ...keys.flatMap(([name, what]) => [h("dt", "", {}, h("kbd", "", {}, name)), h("dd", "", {}, what)]),
    ),
    h("p", "hint", {}, "This page contains free software of others: ", licences(), "."),
  );
}
