/** Compresses with what the browser has, unpacks that and xz, and writes bytes as text. */

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

/** Of a blob it would come by way of another process. */
export function streamOfBytes(bytes: Uint8Array<ArrayBuffer>): ReadableStream<Uint8Array<ArrayBuffer>> {
  return new ReadableStream({
    start(controller) {
      controller.enqueue(bytes);
      controller.close();
    },
  });
}

/** Whether bytes begin with these, and all of them. */
async function beginsWith(bytes: ReadableStream<Uint8Array<ArrayBuffer>>, ...these: number[]) {
  const [beginning, whole] = bytes.tee();
  const reader = beginning.getReader();
  const { value } = await reader.read();
  void reader.cancel();
  return { begins: these.every((byte, i) => value?.[i] === byte), whole };
}

/** What is packed by gzip; other bytes stay as they are. */
export async function ungzipped(bytes: ReadableStream<Uint8Array<ArrayBuffer>>): Promise<Response> {
  const { begins, whole } = await beginsWith(bytes, 0x1f, 0x8b);
  return new Response(begins ? whole.pipeThrough(new DecompressionStream("gzip")) : whole);
}

/** What is packed by xz or gzip; other bytes stay as they are. */
export async function unpacked(bytes: ReadableStream<Uint8Array<ArrayBuffer>>): Promise<Response> {
  const { begins, whole } = await beginsWith(bytes, 0xfd, 0x37);
  if (!begins) return ungzipped(whole);
  const { XzReadableStream } = await import("xz-decompress");
  return new Response(new XzReadableStream(whole));
}

/** Bytes that are written with 85 letters: five are four bytes, the last letter of them the least. Fewer at the end: one less byte. */
export function fromLetters(text: string, letters: string): Uint8Array<ArrayBuffer> {
  const values = new Uint8Array(128);
  for (let i = 0; i < 85; i++) values[letters.charCodeAt(i)] = i;
  const bytes = new Uint8Array(Math.floor((text.length * 4) / 5));
  for (let from = 0, to = 0; from < text.length; from += 5, to += 4) {
    let number = 0;
    for (let i = 0; i < 5; i++) number = number * 85 + (from + i < text.length ? (values[text.charCodeAt(from + i)] ?? 0) : 84);
    for (let i = 0; i < 4 && to + i < bytes.length; i++) bytes[to + i] = number / 256 ** (3 - i);
  }
  return bytes;
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
