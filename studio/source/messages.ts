/** Messages that stay until they are dismissed, and the banner of a lost connection. */
import { h, iconButton } from "./elements.js";
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
        this.banner.replaceChildren(
          "The program did not accept this address. Open the address that `espalier studio` printed last.",
        );
      if (state === "lost")
        this.banner.replaceChildren(
          "There is no connection to the program. Your texts are kept on this page, and it tries again. If the program has ended, start espalier studio again. ",
          h("button", "button small", { type: "button", onclick: () => studio.connection.connect() }, "Try now"),
        );
    });
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
