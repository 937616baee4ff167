/** Colours as the browser writes them, #rrggbb, and as three bytes. */
import { vectorOf, type Vector } from "../view/index.js";

/** The colour of three bytes from `first` on; bytes that are missing count as 0. */
export function hexOf(bytes: ArrayLike<number>, first = 0): string {
  return `#${vectorOf((k) => bytes[first + k] ?? 0).map((byte) => byte.toString(16).padStart(2, "0")).join("")}`;
}

export function bytesOf(hex: string): Vector {
  return vectorOf((k) => parseInt(hex.slice(1 + 2 * k, 3 + 2 * k), 16));
}
