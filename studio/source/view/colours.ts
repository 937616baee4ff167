/** Colour maps that are even to the eye, and the colours of the two themes. */
import { at } from "../lists.js";
import { vectorOf, type Vector } from "./vectors.js";

/** Nine colours of viridis (Smith & van der Walt 2015, matplotlib), evenly spaced. */
const viridis = ["440154", "472d7b", "3b528b", "2c728e", "21918c", "28ae80", "5ec962", "addc30", "fde725"];

function parse(hex: string): Vector {
  return vectorOf((k) => parseInt(hex.slice(2 * k, 2 * k + 2), 16));
}

/** The colour at a part between 0 and 1, as bytes. */
export function mapColour(part: number): Vector {
  const place = Math.min(1, Math.max(0, part)) * (viridis.length - 1);
  const index = Math.min(viridis.length - 2, Math.floor(place));
  const [from, to] = [parse(at(viridis, index)), parse(at(viridis, index + 1))];
  return vectorOf((k) => Math.round(from[k] + (to[k] - from[k]) * (place - index)));
}

/** 256 colours with opacity for a texture. */
export function mapTexture(): Uint8Array {
  const data = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; i++) data.set([...mapColour(i / 255), 255], i * 4);
  return data;
}

/** The map as a gradient of the style sheet. */
export function mapGradient(): string {
  return `linear-gradient(to right, ${viridis.map((hex) => `#${hex}`).join(", ")})`;
}

export interface Theme {
  name: "light" | "dark";
  background: number;
  horizon: number;
  ground: number;
  sky: number;
  soil: number;
  sun: number;
  mark: number;
  kin: number;
}

export const themes: Record<Theme["name"], Theme> = {
  light: {
    name: "light",
    background: 0xe9eff2,
    horizon: 0xf8faf9,
    ground: 0xdfe3da,
    sky: 0xc3d3df,
    soil: 0x8a8475,
    sun: 0xfff4e0,
    mark: 0xe8590c,
    kin: 0xf5b041,
  },
  dark: {
    name: "dark",
    background: 0x14191c,
    horizon: 0x232b2f,
    ground: 0x23292a,
    sky: 0xa9bcc9,
    soil: 0x6e675c,
    sun: 0xfff0d8,
    mark: 0xff8c42,
    kin: 0xffd27a,
  },
};
