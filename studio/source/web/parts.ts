/** The parts of a page that has its own session: files beside it, or, in a page that is one file, elements of it. */
import { unpacked } from "../view/index.js";
import { bytesInside } from "./packed.js";

/** Whether the page has one: its document says where the parts are. */
export function hasOwnSession(): boolean {
  return document.documentElement.dataset.parts !== undefined;
}

/** As it is packed. */
async function packed(name: string): Promise<Uint8Array<ArrayBuffer>> {
  const inside = bytesInside(name);
  if (inside) return inside;
  const response = await fetch(new URL(name, document.baseURI));
  if (!response.ok) throw new Error(`${name} could not be loaded (${response.status}).`);
  return new Uint8Array(await response.arrayBuffer());
}

/** A part, unpacked; a server may have unpacked it on the way. */
export async function part(name: string): Promise<ArrayBuffer> {
  return unpacked(await packed(name));
}

/** Where a text that is a part of the page can be read; null: it is a file. */
export async function addressInside(name: string): Promise<string | null> {
  if (!bytesInside(name)) return null;
  return URL.createObjectURL(new Blob([await part(name)], { type: "text/plain;charset=utf-8" }));
}
