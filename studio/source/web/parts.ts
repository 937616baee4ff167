/** The parts of a page that has its own session: files beside it, or, in a page that is one file, elements of it. */
import { XzReadableStream } from "xz-decompress";
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

function unpacker(bytes: Uint8Array): ((packed: ReadableStream<Uint8Array<ArrayBuffer>>) => ReadableStream) | null {
  if (bytes[0] === 0xfd && bytes[1] === 0x37) return (packed) => new XzReadableStream(packed);
  if (bytes[0] === 0x1f && bytes[1] === 0x8b) return (packed) => packed.pipeThrough(new DecompressionStream("gzip"));
  return null;
}

/** A part, unpacked; a server may have unpacked it on the way. */
export async function part(name: string): Promise<ArrayBuffer> {
  const bytes = await packed(name);
  const unpack = unpacker(bytes);
  return unpack ? new Response(unpack(new Blob([bytes]).stream())).arrayBuffer() : bytes.buffer;
}

/** Where a text that is a part of the page can be read; null: it is a file. */
export async function addressInside(name: string): Promise<string | null> {
  if (!bytesInside(name)) return null;
  return URL.createObjectURL(new Blob([await part(name)], { type: "text/plain;charset=utf-8" }));
}
