/** The library of models and scenes as one part of a page: a line of JSON with names and sizes, then the files. */

export function unpackLibrary(pack: ArrayBuffer, write: (path: string, bytes: Uint8Array) => void): void {
  const bytes = new Uint8Array(pack);
  const end = bytes.indexOf(10);
  const names = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end))) as [path: string, size: number][];
  let at = end + 1;
  for (const [path, size] of names) {
    write(path, bytes.subarray(at, at + size));
    at += size;
  }
}
