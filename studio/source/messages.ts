/** Messages that stay until they are dismissed, and the banner of a lost connection. */
import { h, iconButton } from "./elements.js";
import { keepKey, keyIn } from "./key.js";
import type { Studio } from "./state.js";

const titles = { error: "Error", warning: "Warning", note: "Note" } as const;

export class Messages {
  readonly element = h("div", "messages", { role: "log", "aria-live": "polite", "aria-label": "Messages" });
  readonly banner = h("div", "banner", { role: "alert", hidden: true });

  constructor(private readonly studio: Studio) {
    studio.on("messages", () => this.draw());
    studio.on("connection", (state) => {
      this.banner.hidden = state === "open" || state === "connecting";
      if (state === "refused")
        this.banner.replaceChildren(...this.refusal());
      if (state === "lost")
        this.banner.replaceChildren(
          `${studio.connection.lost} `,
          h("button", "button small", { type: "button", onclick: () => studio.connection.connect() }, "Try now"),
        );
    });
  }

  /** Says what to do, and takes another address. */
  private refusal(): Node[] {
    const { connection } = this.studio;
    if (!connection.why.includes("key")) return [document.createTextNode(`The studio does not let this page in: ${connection.why}.`)];
    const field = h("input", "wide", { type: "text", "aria-label": "Address or key", placeholder: "http://127.0.0.1:…/#token=…" });
    const form = h(
      "form",
      "key-form",
      {
        onsubmit: (event) => {
          event.preventDefault();
          const key = keyIn(field.value);
          if (!key) return;
          keepKey(key);
          connection.connectWith(key);
        },
      },
      field,
      h("button", "button small", { type: "submit" }, "Open"),
    );
    return [
      h(
        "span",
        "",
        {},
        "The key in this page's address is not that of the studio that runs here. Each start has a new one: it stands in the address that ",
        h("code", "", {}, "espalier studio"),
        " has printed in its terminal. Open that address, or paste it here.",
      ),
      form,
    ];
  }

  private draw(): void {
    this.element.replaceChildren(
      ...this.studio.messages.map(({ number, severity, text }) =>
        h(
          "div",
          `message ${severity}`,
          {},
          h("strong", "", {}, titles[severity] ?? "Note"),
          h("span", "", {}, text),
          iconButton("close", "Dismiss", () => this.studio.dismiss(number)),
        ),
      ),
    );
  }
}
