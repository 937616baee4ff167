/** First steps, one at a time, until each has been done once. */
import { h, iconButton, remember, remembered } from "./elements.js";
import type { Studio } from "./state.js";

const steps = [
  { key: "turned", text: "Drag to turn the plant, scroll to zoom." },
  { key: "changed", text: "Move a slider on the right: the plant grows anew." },
  { key: "played", text: "Play below shows how it grew." },
  { key: "asked", text: "Click an organ: it tells what it is and what made it." },
  { key: "shared", text: "The camera films the growth, Share hands it on, Gallery has more plants." },
] as const;

type Step = (typeof steps)[number]["key"];

export class Hints {
  readonly element = h("div", "picture-hint", { role: "status" });
  private readonly text = h("span", "");
  private done = new Set<string>(remembered<string[]>("hints", []));

  constructor(studio: Studio) {
    this.element.append(
      this.text,
      iconButton("close", "No more hints", () => this.end()),
    );
    let version = 0;
    studio.on("document", (document) => {
      if (document.undo && version > 0 && document.version > version && !/^open /.test(document.undo)) this.did("changed");
      version = document.version;
    });
    this.show();
  }

  did(step: Step): void {
    if (this.done.has(step)) return;
    this.done.add(step);
    remember("hints", [...this.done]);
    this.show();
  }

  private end(): void {
    for (const { key } of steps) this.done.add(key);
    remember("hints", [...this.done]);
    this.show();
  }

  private show(): void {
    const next = steps.find(({ key }) => !this.done.has(key));
    this.element.hidden = !next;
    if (next) this.text.textContent = next.text;
  }
}
