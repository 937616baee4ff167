/** Editors that drag points, for side files that have one. */
import type { TextFile } from "../protocol.js";

export interface SideText {
  content: () => string;
  change: (content: string, lasting: boolean) => void;
}

export function sideEditor(_file: TextFile, _text: SideText): Node[] {
  return [];
}
