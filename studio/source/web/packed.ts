/** Parts of a page of one file: elements that have bytes written in letters. */

/** Those that need no escape in a page. `studio/site.mjs` writes with them. */
const letters = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%()*+,-./:;=?@[]^_{|}";

/** Five letters are four bytes, the last letter of them the least. Fewer at the end: one less byte. */
function from85(text: string): Uint8Array<ArrayBuffer> {
  const values = new Uint8Array(128);
  for (let i = 0; i < 85; i++) values[letters.charCodeAt(i)] = i;
  const bytes = new Uint8Array(Math.floor((text.length * 4) / 5));
  for (let from = 0, to = 0; from < text.length; from += 5, to += 4) {
    let number = 0;
    for (let i = 0; i < 5; i++) number = number * 85 + (values[text.charCodeAt(from + i)] ?? 84);
    for (let i = 0; i < 4 && to + i < bytes.length; i++) bytes[to + i] = number / 256 ** (3 - i);
  }
  return bytes;
}

function from64(text: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}

/** The bytes of a part that is an element of the page; null: it is a file. */
export function bytesInside(name: string): Uint8Array<ArrayBuffer> | null {
  const element = document.getElementById(`part-${name}`) as HTMLScriptElement | null;
  const text = element?.textContent?.trim() ?? "";
  return element && (element.type === "application/base85" ? from85(text) : from64(text));
}
