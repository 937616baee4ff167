/** Asks before a plant becomes very large. */
import { h } from "./elements.js";
import type { Studio } from "./state.js";

export function largeQuestion(studio: Studio): HTMLElement {
  const words = h("span", "");
  const element = h(
    "div",
    "limb-progress",
    { role: "alert", hidden: true },
    words,
    h("button", "button small", { type: "button", onclick: () => void studio.ask("go-on", {}) }, "Grow on"),
    h("button", "button small", { type: "button", onclick: () => void studio.ask("stop", {}) }, "Stop here"),
  );
  studio.on("growth", ({ state, reason }) => {
    element.hidden = state !== "asks";
    words.textContent = `The plant becomes very large: ${reason.replace(/\d{4,}/, (number) => Number(number).toLocaleString("en"))}.`;
  });
  return element;
}
