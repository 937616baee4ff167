/** The dialog that exports a run in one of the program's formats. */
import { openDialog } from "./dialog.js";
import { download, h } from "./elements.js";
import { errorText, type Studio } from "./state.js";

/** `name=value` pairs, separated by blanks or lines. */
function optionsOf(text: string): Record<string, string> {
  const options: Record<string, string> = {};
  for (const pair of text.split(/[\s,]+/).filter(Boolean)) {
    const at = pair.indexOf("=");
    options[at < 0 ? pair : pair.slice(0, at)] = at < 0 ? "true" : pair.slice(at + 1);
  }
  return options;
}

export function exportDialog(studio: Studio): void {
  const formats = studio.help?.exporters ?? [];
  const select = h("select", "wide", { id: "export-format", size: Math.min(12, Math.max(4, formats.length)) },
    ...formats.map(({ name, summary }, index) => h("option", "", { value: name, selected: index === 0 }, `${name} – ${summary}`)));
  const about = h("pre", "about");
  const options = h("input", "wide", { type: "text", id: "export-options", placeholder: "name=value name=value" });
  const state = h("p", "hint", { role: "status" });
  const start = h("button", "button primary", { type: "submit" }, "Export");
  const describe = () => (about.textContent = formats.find(({ name }) => name === select.value)?.help ?? "");
  select.addEventListener("change", describe);
  describe();
  const form = h("form", "form", {
    onsubmit: (event) => {
      event.preventDefault();
      void run();
    },
  }, h("label", "", { for: "export-format" }, "Format"), select, about, h("label", "", { for: "export-options" }, "Options"), options,
    h("div", "form-end", {}, state, start));
  const dialog = openDialog("Export", form);

  async function run(): Promise<void> {
    start.disabled = true;
    state.textContent = "The file is being written …";
    try {
      const { file } = await studio.connection.request("export", { format: select.value, options: optionsOf(options.value) });
      download(await studio.connection.file(file.number), file.name);
      dialog.close();
    } catch (error) {
      state.textContent = errorText(error);
    }
    start.disabled = false;
  }
}
