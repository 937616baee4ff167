/** Opens what came by a link: shows the files that it holds, and writes them when that is agreed to. */
import { openDialog } from "./dialog.js";
import { h, whole } from "./elements.js";
import { decompress, fromBase64 } from "./view/index.js";
import type { LinkContents, SharedModel } from "./protocol.js";
import { errorText, type Studio } from "./state.js";

/** Links of the studio have 8,000 characters; what is packed in more could fill the memory. */
const longestPacked = 20000;

/** Links of every port, as they are shared, with the words around them, or as a fragment of this page's address. */
const link = /(?:espalier:|[#&])model=([\w-]+)/;

export function hasModel(text: string): boolean {
  return link.test(text);
}

export async function modelOfLink(text: string): Promise<SharedModel | null> {
  const packed = link.exec(text)?.[1];
  if (!packed) return null;
  if (packed.length > longestPacked) throw new Error(`it has ${whole(packed.length)} characters, too many for a link`);
  return JSON.parse(new TextDecoder().decode(await decompress(fromBase64(packed)))) as SharedModel;
}

function fileList(contents: LinkContents): HTMLElement {
  const line = ({ path, bytes, library }: LinkContents["files"][number]) =>
    h("li", "", {}, h("code", "", {}, path), library === null ? `, ${whole(bytes)} bytes` : ", comes with Espalier");
  return h("ul", "", {}, ...contents.files.map(line));
}

/** Whether the reader of the list agrees. */
function agreed(contents: LinkContents): Promise<boolean> {
  return new Promise((resolve) => {
    let answer = false;
    const open = h("button", "button primary", { type: "button" }, "Write and open");
    const dialog = openDialog(
      "Open a link",
      h("p", "", {}, "This link holds the files below. They are written to a folder of their own, ", h("code", "", {}, contents.folder), "."),
      fileList(contents),
      h("p", "hint", {}, "What it grows reads only that folder and the models that come with Espalier."),
      h("div", "form-end", {}, open),
    );
    open.addEventListener("click", () => {
      answer = true;
      dialog.close();
    });
    dialog.addEventListener("close", () => resolve(answer));
    open.focus();
  });
}

/** `#open=environments/two-trees.toml` opens a file of the library. */
export async function openNamed(studio: Studio, fragment: string): Promise<boolean> {
  const name = /[#&]open=([\w./-]+)/.exec(fragment)?.[1];
  if (!name) return false;
  const library = await studio.ask("library", {});
  const entry = library?.library.find(({ path }) => path.endsWith(`/${name}`));
  if (!entry) {
    studio.tell("error", `The library has no ${name}.`);
    return false;
  }
  return (await studio.ask("open", { path: entry.path })) !== undefined;
}

/** True if the link's model is open now; false if there is none in it, or the user thought better of it. */
export async function openLink(studio: Studio, text: string): Promise<boolean> {
  try {
    const model = await modelOfLink(text);
    const contents = model && (await studio.ask("read-link", model));
    if (!model || !contents || !(await agreed(contents))) return false;
    return (await studio.ask("open-text", model)) !== undefined;
  } catch (error) {
    studio.tell("error", `The link could not be read: ${errorText(error)}`);
    return false;
  }
}
