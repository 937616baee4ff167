/** The parts of a page that has its own session, for the studio. */
import { unpacked } from "../view/index.js";
import { packedPart, streamOf } from "./packed.js";

/** Whether the page has one: its document says where the parts are. */
export function hasOwnSession(): boolean {
  return document.documentElement.dataset.parts !== undefined;
}

/** A part, unpacked; a server may have unpacked it on the way. */
export async function part(name: string): Promise<ArrayBuffer> {
  const packed = await unpacked(await streamOf(packedPart(name)));
  return packed.arrayBuffer();
}

/** Where a text that is a part of the page can be read; null: it is a file. */
export async function addressInside(name: string): Promise<string | null> {
  if ("address" in packedPart(name)) return null;
  return URL.createObjectURL(new Blob([await part(name)], { type: "text/plain;charset=utf-8" }));
}
