/** Editors that drag points, for the side files that have one. */
import { h } from "../elements.js";
import { readPoints } from "./files.js";
import { MapEditor } from "./map.js";
import { PointPlane } from "./plane.js";
import { SurfaceEditor } from "./surface.js";

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
  if (files.length === 0) return none;
  let at = 0;
  const make = () => new PointPlane(files[at], text.change);
  let plane = make();
  const holder = h("div", "", {}, plane.element);
  const choice = h(
    "select",
    "",
    { "aria-label": "Function" },
    ...files.map(({ name }, index) => h("option", "", { value: index }, name)),
  );
  choice.addEventListener("change", () => {
    at = choice.selectedIndex;
    plane = make();
    holder.replaceChildren(plane.element);
  });
  choice.hidden = files.length < 2;
  const refresh = () => {
    const now = read();
    if (now.length !== files.length) return;
    files = now;
    plane.refresh(files[at]);
  };
  return { elements: [choice, holder], refresh };
}

export function sideEditor(text: SideText): SideEditor {
  if (text.path.endsWith(".map")) return new MapEditor(text);
  if (text.path.endsWith(".s")) return new SurfaceEditor(text);
  return planeEditor(text);
}
