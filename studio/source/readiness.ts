/**
 * Tells in the page what is still to come, for tests and other programs that use it: attributes of its body.
 *   data-told    all that there was to tell a new page has been told; its value is the growth
 *   data-asks    the program owes an answer
 *   data-unsent  a text that is being typed is no lasting change yet
 *   data-behind  the plant that shows is not yet that of the texts and of the step that is looked at
 */
import type { Studio } from "./state.js";

function isBehind({ document, growth, frames }: Studio): boolean {
  const { shown, wanted } = frames;
  if (!document || !growth || !shown) return true;
  if (growth.version < document.version || shown.growth !== growth.growth) return true;
  return wanted === "last" && shown.step < growth.step;
}

export function tellReadiness(studio: Studio): void {
  const { body } = document;
  const compare = () => body.toggleAttribute("data-behind", isBehind(studio));
  for (const event of ["document", "growth", "shown"] as const) studio.on(event, compare);
  compare();
  studio.on("asks", (asks) => body.toggleAttribute("data-asks", asks));
  studio.on("unsent", (unsent) => body.toggleAttribute("data-unsent", unsent));
  studio.on("told", (growth) => {
    body.dataset.told = String(growth ?? "");
  });
}
