/** Editors above the texts of side files: points to drag, colours, forms. */
import { h } from "../elements.js";
import { at } from "../lists.js";
import type { CurvePoint, Help, PointCurve, ViewEntry, ViewRequest } from "../protocol.js";
import { MapEditor } from "./map.js";
import { MaterialEditor } from "./materials.js";
import { PointPlane } from "./plane.js";
import { SurfaceEditor } from "./surface.js";
import { ViewForm } from "./view.js";

/** What a setting of a view file becomes. */
export type ViewEdit = Omit<ViewRequest, "path" | "label" | "transient">;

export interface SideText {
  path: string;
  content: () => string;
  change: (content: string, lasting: boolean) => void;
  /** The control points that the program has read in the text. */
  curves: () => PointCurve[];
  /** Gives the curve of a number other control points: the text follows. */
  move: (number: number, points: CurvePoint[], lasting: boolean) => void;
  /** The settings that the program has read in the text of a view file. */
  viewEntries: () => ViewEntry[];
  /** Gives a setting of a view file another value: the text follows. */
  setView: (edit: ViewEdit, lasting: boolean) => void;
  /** Whether changes are on their way: what the program has read is older than what shows. */
  isAhead: () => boolean;
}

export interface SideEditor {
  elements: Node[];
  /** The text has changed elsewhere. */
  refresh?: () => void;
  /** The program has read the text anew. */
  reread?: () => void;
}

const none: SideEditor = { elements: [] };

/** Functions, contours and curves; a set of functions has a list to choose from. */
function planeEditor(text: SideText): SideEditor {
  const curves = text.curves();
  const [first] = curves;
  if (!first) return none;
  let number = 0;
  const make = (curve: PointCurve) => new PointPlane(curve, (points, lasting) => text.move(number, points, lasting));
  let plane = make(first);
  const holder = h("div", "", {}, plane.element);
  const choice = h(
    "select",
    "",
    { "aria-label": "Function" },
    ...curves.map(({ name }, index) => h("option", "", { value: index }, name || `function ${index + 1}`)),
  );
  choice.addEventListener("change", () => {
    number = choice.selectedIndex;
    plane = make(at(text.curves(), number));
    holder.replaceChildren(plane.element);
  });
  choice.hidden = curves.length < 2;
  const reread = () => {
    const now = text.curves()[number];
    if (now && !text.isAhead()) plane.refresh(now);
  };
  return { elements: [choice, holder], reread };
}

export function sideEditor(text: SideText, help: () => Help | null): SideEditor {
  if (text.path.endsWith(".v")) return new ViewForm(text, help);
  if (text.path.endsWith(".mat")) return new MaterialEditor(text);
  if (text.path.endsWith(".map")) return new MapEditor(text);
  if (text.path.endsWith(".s")) return new SurfaceEditor(text);
  return planeEditor(text);
}
