/** The parts of a page that has its own session: files beside it, or, in a page that is one file, elements of it. */

/** Whether the page has one: its document says where the parts are. */
export function hasOwnSession(): boolean {
  return document.documentElement.dataset.parts !== undefined;
}

/** Bytes in base64, as a page of one file has them. */
function bytesOf(element: Element): Uint8Array<ArrayBuffer> {
  const text = atob(element.textContent?.trim() ?? "");
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** As it is packed. */
async function packed(name: string): Promise<Uint8Array<ArrayBuffer>> {
  const inside = document.getElementById(`part-${name}`);
  if (inside) return bytesOf(inside);
  const response = await fetch(new URL(name, document.baseURI));
  if (!response.ok) throw new Error(`${name} could not be loaded (${response.status}).`);
  return new Uint8Array(await response.arrayBuffer());
}

/** A part, unpacked: parts are packed by gzip, unless the server has unpacked them on the way. */
export async function part(name: string): Promise<ArrayBuffer> {
  const bytes = await packed(name);
  if (bytes[0] !== 0x1f || bytes[1] !== 0x8b) return bytes.buffer;
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}
