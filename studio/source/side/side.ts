/** Editors above the texts of side files: points to drag, colours, forms. */
import type { CurvePoint, Help, PointCurve, ViewEntry, ViewRequest } from "../protocol.js";
import { FunctionsEditor } from "./functions.js";
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
  /** The functions of all texts. */
  functions: () => PointCurve[];
  /** Of the function that is edited first, among those of the text. */
  opened: number;
  /** Shows another text and edits a function of it. */
  go: (path: string, number: number) => void;
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
  /** Puts the keyboard where the person has chosen what is edited. */
  focus?: () => void;
}

const none: SideEditor = { elements: [] };

/** Contours and curves. */
function planeEditor(text: SideText, curve: PointCurve): SideEditor {
  const plane = new PointPlane(curve, "line-1", [], {
    changed: (points, lasting) => text.move(0, points, lasting),
    pointed: () => undefined,
  });
  const reread = () => {
    const [now] = text.curves();
    if (now && !text.isAhead()) plane.refresh(now, []);
  };
  return { elements: [plane.element], reread };
}

export function sideEditor(text: SideText, help: () => Help | null): SideEditor {
  if (text.path.endsWith(".v")) return new ViewForm(text, help);
  if (text.path.endsWith(".mat")) return new MaterialEditor(text);
  if (text.path.endsWith(".map")) return new MapEditor(text);
  if (text.path.endsWith(".s")) return new SurfaceEditor(text);
  const [curve] = text.curves();
  if (!curve) return none;
  return curve.kind === "function" ? new FunctionsEditor(text) : planeEditor(text, curve);
}
