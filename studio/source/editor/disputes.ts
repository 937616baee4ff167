/** Asks which text is to stay where another program has written a file that has unsaved changes here. */
import { h } from "../elements.js";
import type { Studio } from "../state.js";

export class Disputes {
  readonly element = h("div", "disputes", { role: "alert" });

  /** `settled` is done when the server has all that was typed. */
  constructor(
    private readonly studio: Studio,
    private readonly settled: () => Promise<void>,
  ) {
    studio.on("document", ({ texts }) =>
      this.element.replaceChildren(...texts.filter(({ disputed }) => disputed).map(({ path }) => this.question(path))),
    );
  }

  private question(path: string): HTMLElement {
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
    );
  }

  private async settle(path: string, take: "disk" | "mine"): Promise<void> {
    await this.settled();
    await this.studio.ask("settle", { path, take });
  }
}
