/** Parts of a page of one file: elements that have bytes written in letters, which `data-letters` gives, or in base64. */
import { fromBase64, fromLetters } from "../view/index.js";

/** The bytes of a part that is an element of the page; null: it is a file. */
export function bytesInside(name: string): Uint8Array<ArrayBuffer> | null {
  const element = document.getElementById(`part-${name}`);
  if (!element) return null;
  const text = element.textContent?.trim() ?? "";
  const { letters } = element.dataset;
  return (letters ? fromLetters(text, letters) : fromBase64(text)) as Uint8Array<ArrayBuffer>;
}
