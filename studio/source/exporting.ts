/** The dialog that exports the run in one of the program's formats. */
import { openDialog } from "./dialog.js";
import { download, h } from "./elements.js";
import { errorText, type Studio } from "./state.js";

export class Exporting {
  private asked = false;

  constructor(private readonly studio: Studio) {
    // Every page hears of exported files; the one that asked takes them.
    studio.on("exported", (files) => {
      if (!this.asked) return;
      this.asked = false;
      for (const file of files)
        studio.connection.file(file.number).then(
          (blob) => download(blob, file.name),
          (error: unknown) => studio.tell("error", errorText(error)),
        );
      if (files.length > 0) studio.tell("note", `Exported ${files.map(({ name }) => name).join(", ")}.`);
    });
  }

  open(): void {
    const formats = this.studio.help?.exporters ?? [];
    const select = h(
      "select",
      "wide",
      { id: "export-format", size: Math.min(12, Math.max(4, formats.length)) },
      ...formats.map(({ name, summary }, index) =>
        h("option", "", { value: name, selected: index === 0 }, `${name} – ${summary}`),
      ),
    );
    const about = h("pre", "about");
    const film = h("input", "", { type: "checkbox", id: "export-film" });
    const state = h("p", "hint", { role: "status" });
    const describe = () => (about.textContent = formats.find(({ name }) => name === select.value)?.help ?? "");
    select.addEventListener("change", describe);
    describe();
    const form = h(
      "form",
      "form",
      {
        onsubmit: (event) => {
          event.preventDefault();
          void this.run(select.value, film.checked, state).then((begun) => begun && dialog.close());
        },
      },
      h("label", "", { for: "export-format" }, "Format"),
      select,
      about,
      h("label", "check", { for: "export-film" }, film, `All steps, not only step ${this.studio.frames.step}`),
      h("div", "form-end", {}, state, h("button", "button primary", { type: "submit" }, "Export")),
    );
    const dialog = openDialog("Export", form);
  }

  private async run(format: string, film: boolean, state: HTMLElement): Promise<boolean> {
    this.asked = true;
    try {
      await this.studio.connection.request("export", { format, step: this.studio.frames.step, ...(film ? { film } : {}) });
      return true;
    } catch (error) {
      this.asked = false;
      state.textContent = errorText(error);
      return false;
    }
  }
}
