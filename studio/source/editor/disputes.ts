/** Asks which text is to stay where another program has written a file that has unsaved changes here. */
import { h, whole } from "../elements.js";
import type { TextFile } from "../protocol.js";
import type { Studio } from "../state.js";
import { differingLines } from "./differing-lines.js";

const mostLines = 60; // that are shown

export class Disputes {
  readonly element = h("div", "disputes", { role: "alert" });

  /** `settled` is done when the server has all that was typed. */
  constructor(
    private readonly studio: Studio,
    private readonly settled: () => Promise<void>,
  ) {
    studio.on("document", ({ texts }) =>
      this.element.replaceChildren(...texts.filter(({ disputed }) => disputed).map((text) => this.question(text))),
    );
  }

  private question({ path, content, disk }: TextFile): HTMLElement {
    const name = path.slice(path.lastIndexOf("/") + 1);
    const choice = (words: string, take: "disk" | "mine") =>
      h("button", "button small", { type: "button", onclick: () => void this.settle(path, take) }, words);
    return h(
      "div",
      "dispute",
      {},
      h("span", "", {}, `Another program has written ${name}, which has unsaved changes here.`),
      choice("Read the file again", "disk"),
      choice("Keep my text", "mine"),
      disk === undefined ? null : comparison(disk, content),
    );
  }

  private async settle(path: string, take: "disk" | "mine"): Promise<void> {
    await this.settled();
    await this.studio.ask("settle", { path, take });
  }
}

/** The lines in which the file and the text of this page differ. */
function comparison(disk: string, mine: string): HTMLElement {
  const lines = differingLines(disk, mine);
  const more = lines.length - mostLines;
  return h(
    "div",
    "dispute-lines",
    { role: "group", tabindex: 0, "aria-label": "Lines that differ" },
    ...lines
      .slice(0, mostLines)
      .map(({ of, number, text }) =>
        h(of === "disk" ? "del" : "ins", "", {}, h("small", "", {}, `${of === "disk" ? "file" : "here"} ${number}`), h("code", "", {}, text || " ")),
      ),
    more > 0 ? h("small", "", {}, `and ${whole(more)} lines more`) : null,
  );
}
