/** Parts of a page as they are packed: files beside it, or, in a page of one file, elements whose bytes `data-letters` writes. */
import { fromLetters, streamOfBytes } from "../view/index.js";
import type { PackedParts } from "./messages.js";

/** Where a part is; workers, who have no document, are told it. */
export type Packed = { address: string } | { text: string; letters: string };

export function packedPart(name: string): Packed {
  const element = document.getElementById(`part-${name}`);
  if (!element) return { address: new URL(name, document.baseURI).href };
  return { text: element.textContent?.trim() ?? "", letters: element.dataset.letters ?? "" };
}

/** What each first worker of a page loads. */
export function packedParts(): PackedParts {
  return { module: packedPart("espalier.wasm.xz"), library: packedPart("library.pack") };
}

/** The bytes, as they come. */
export async function streamOf(packed: Packed): Promise<ReadableStream<Uint8Array<ArrayBuffer>>> {
  if ("text" in packed) return streamOfBytes(fromLetters(packed.text, packed.letters));
  const response = await fetch(packed.address);
  if (response.ok && response.body) return response.body;
  throw new Error(`${packed.address} could not be loaded (${response.status}).`);
}
