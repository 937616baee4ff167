/** The dialog that exports the run in one of the program's formats. */
import { openDialog } from "./dialog.js";
import { download, h } from "./elements.js";
import type { ExportRequest, HandedFile } from "./protocol.js";
import { errorText, type Studio } from "./state.js";
import { zip } from "./zip.js";

/** What most programs and pages read. */
const usual = "gltf";

export class Exporting {
  private asked = false;

  constructor(private readonly studio: Studio) {
    // Every page hears of exported files; the one that asked takes them.
    studio.on("exported", (files) => {
      if (!this.asked) return;
      this.asked = false;
      if (files.length > 0) this.take(files).catch((error: unknown) => studio.tell("error", errorText(error)));
    });
  }

  open(): void {
    const { studio } = this;
    const known = studio.help?.exporters ?? [];
    const formats = [...known.filter(({ name }) => name === usual), ...known.filter(({ name }) => name !== usual)];
    const select = h(
      "select",
      "wide",
      { id: "export-format", size: Math.min(12, Math.max(4, formats.length)) },
      ...formats.map(({ name, summary }, index) =>
        h("option", "", { value: name, selected: index === 0 }, `${name} – ${summary}`),
      ),
    );
    const about = h("pre", "about", { tabindex: 0, "aria-label": "What the format holds" });
    const film = check("film");
    const smooth = check("smooth", studio.limbs?.smooth ?? false);
    const instances = check("instances");
    const triangles = h("input", "number", { type: "number", min: 1, step: 1, id: "export-triangles", placeholder: "all" });
    const state = h("p", "hint", { role: "status" });
    const describe = () => {
      about.textContent = formats.find(({ name }) => name === select.value)?.help ?? "";
      triangles.disabled = smooth.checked;
    };
    select.addEventListener("change", describe);
    smooth.addEventListener("change", describe);
    describe();
    const wanted = (): ExportRequest => ({
      format: select.value,
      step: studio.frames.step,
      film: film.checked,
      smooth: smooth.checked,
      instances: instances.checked,
      ...(triangles.value && !triangles.disabled ? { triangles: Number(triangles.value) } : {}),
    });
    const form = h(
      "form",
      "form",
      {
        onsubmit: (event) => {
          event.preventDefault();
          void this.run(wanted(), state).then((begun) => begun && dialog.close());
        },
      },
      h("label", "", { for: "export-format" }, "Format"),
      select,
      about,
      labelled(film, `All steps, not only step ${studio.frames.step}`),
      labelled(smooth, "Limbs with one smooth skin"),
      labelled(instances, "Organs that look alike as instances of one shape (gltf of one step, usd)"),
      h("label", "check", { for: "export-triangles" }, "At most so many triangles (obj, ply, stl, gltf, usd)", triangles),
      h("div", "form-end", {}, state, h("button", "button primary", { type: "submit" }, "Export")),
    );
    const dialog = openDialog("Export", form);
  }

  private async run(wanted: ExportRequest, state: HTMLElement): Promise<boolean> {
    this.asked = true;
    try {
      await this.studio.connection.request("export", wanted);
      return true;
    } catch (error) {
      this.asked = false;
      state.textContent = errorText(error);
      return false;
    }
  }

  /** A file that needs others comes with them, at the places where it looks for them. */
  private async take(files: HandedFile[]): Promise<void> {
    const entries = await Promise.all(
      files.map(async ({ name, number }) => ({ name, blob: await this.studio.connection.file(number) })),
    );
    const [first] = entries;
    if (!first) return;
    if (entries.length === 1) download(first.blob, first.name);
    else download(await zip(entries), `${first.name.replace(/\.\w+$/, "")}.zip`);
    this.studio.tell("note", `Exported ${files.map(({ name }) => name).join(", ")}.`);
  }
}

function check(name: string, checked = false): HTMLInputElement {
  return h("input", "", { type: "checkbox", id: `export-${name}`, checked });
}

function labelled(box: HTMLInputElement, words: string): HTMLElement {
  return h("label", "check", { for: box.id }, box, words);
}
