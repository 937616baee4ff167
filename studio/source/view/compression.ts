/** Compresses with what the browser has, and writes bytes as text. */

async function through(bytes: BufferSource, stream: CompressionStream | DecompressionStream): Promise<Uint8Array> {
  const piped = new Blob([bytes as ArrayBuffer]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}

export function compress(bytes: BufferSource): Promise<Uint8Array> {
  return through(bytes, new CompressionStream("deflate-raw"));
}

export function decompress(bytes: Uint8Array): Promise<Uint8Array> {
  return through(bytes as Uint8Array<ArrayBuffer>, new DecompressionStream("deflate-raw"));
}

export function toBase64(bytes: Uint8Array): string {
  const parts: string[] = [];
  for (let at = 0; at < bytes.length; at += 0x8000) parts.push(String.fromCharCode(...bytes.subarray(at, at + 0x8000)));
  return btoa(parts.join(""));
}

export function fromBase64(text: string): Uint8Array {
  return Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
}

/** Base64 without the signs that mean something in an address. */
export function urlSafe(base64: string): string {
  return base64.replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}
