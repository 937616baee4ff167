/** Begins the studio in a page of one file, whose script is a packed part of it. */
import { part } from "./parts.js";

void part("studio.js").then((bytes) => {
  const script = document.createElement("script");
  script.dataset.file = "studio.js";
  script.textContent = new TextDecoder().decode(bytes);
  document.body.append(script);
});
