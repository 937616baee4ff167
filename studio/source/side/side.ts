/** Editors above the texts of side files: points to drag, colours, forms. */
import { h } from "../elements.js";
import { readPoints } from "./files.js";
import { at } from "../lists.js";
import type { Help } from "../protocol.js";
import { MapEditor } from "./map.js";
import { MaterialEditor } from "./materials.js";
import { PointPlane } from "./plane.js";
import { SurfaceEditor } from "./surface.js";
import { ViewForm } from "./view.js";

export interface SideText {
  path: string;
  content: () => string;
  change: (content: string, lasting: boolean) => void;
}

export interface SideEditor {
  elements: Node[];
  /** The text has changed elsewhere. */
  refresh: () => void;
}

const none: SideEditor = { elements: [], refresh: () => undefined };

/** Functions, contours and curves; a set of functions has a list to choose from. */
function planeEditor(text: SideText): SideEditor {
  const read = () => readPoints(text.path, text.content());
  let files = read();
  const [first] = files;
  if (!first) return none;
  let shown = 0;
  let plane = new PointPlane(first, text.change);
  const holder = h("div", "", {}, plane.element);
  const choice = h(
    "select",
    "",
    { "aria-label": "Function" },
    ...files.map(({ name }, index) => h("option", "", { value: index }, name)),
  );
  choice.addEventListener("change", () => {
    shown = choice.selectedIndex;
    plane = new PointPlane(at(files, shown), text.change);
    holder.replaceChildren(plane.element);
  });
  choice.hidden = files.length < 2;
  const refresh = () => {
    const now = read();
    if (now.length !== files.length) return;
    files = now;
    plane.refresh(at(files, shown));
  };
  return { elements: [choice, holder], refresh };
}

export function sideEditor(text: SideText, help: () => Help | null): SideEditor {
  if (text.path.endsWith(".v")) return new ViewForm(text, help);
  if (text.path.endsWith(".mat")) return new MaterialEditor(text);
  if (text.path.endsWith(".map")) return new MapEditor(text);
  if (text.path.endsWith(".s")) return new SurfaceEditor(text);
  return planeEditor(text);
}
