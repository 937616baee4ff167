/** Begins the studio in a page of one file, whose script is a packed part of it. */
import { bytesInside, unzipped } from "./packed.js";

const bytes = bytesInside("studio.js");
if (bytes) {
  void unzipped(bytes).then((text) => {
    const script = document.createElement("script");
    script.dataset.file = "studio.js";
    script.textContent = new TextDecoder().decode(text);
    document.body.append(script);
  });
}
