/** What a recording tells of its frames, several in one text: src/studio/server/frame_texts.h. */
import { at } from "../lists.js";
import { decompress, fromBase64, fromLetters, streamOfBytes, unpacked } from "./compression.js";

const mostKept = 3; // texts, which may have tens of MB each

async function textBytes(text: string, letters: string | undefined): Promise<ArrayBuffer> {
  if (letters) return (await unpacked(streamOfBytes(fromLetters(text, letters)))).arrayBuffer();
  const bytes = await decompress(fromBase64(text));
  return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) as ArrayBuffer;
}

export class FrameTexts {
  private readonly kept = new Map<number, Promise<ArrayBuffer>>();

  constructor(
    private readonly texts: string[],
    /** Frames of a text; missing: each has a text of its own. */
    private readonly together: number | undefined,
    /** Missing: texts are in base64. */
    private readonly letters: string | undefined,
  ) {}

  /** The bytes of a frame. */
  async frame(index: number): Promise<ArrayBuffer> {
    if (this.together === undefined) return this.text(index);
    const bytes = await this.text(Math.floor(index / this.together));
    const view = new DataView(bytes);
    let from = 0;
    for (let i = index % this.together; i > 0; i--) from += 4 + view.getUint32(from, true);
    return bytes.slice(from + 4, from + 4 + view.getUint32(from, true));
  }

  private text(number: number): Promise<ArrayBuffer> {
    const known = this.kept.get(number);
    if (known) return known;
    const bytes = textBytes(at(this.texts, number), this.letters);
    this.kept.set(number, bytes);
    const [oldest] = this.kept.keys();
    if (this.kept.size > mostKept && oldest !== undefined) this.kept.delete(oldest);
    return bytes;
  }
}

export async function jsonOf<Value>(bytes: Promise<ArrayBuffer>): Promise<Value> {
  return JSON.parse(new TextDecoder().decode(await bytes)) as Value;
}

/** A text of its own. */
export function oneText(text: string, letters?: string): Promise<ArrayBuffer> {
  return textBytes(text, letters);
}
