/** Pictures that surfaces wear, as textures that are white or flat until they have been read. */
import { DataTexture, LinearFilter, LinearMipmapLinearFilter, RepeatWrapping, RGBAFormat, Texture, type IUniform } from "three";

/** The colours of a picture and the normals of its relief, where it has them. */
export interface PictureSource {
  colours: Promise<Blob> | null;
  normals: Promise<Blob> | null;
}

interface Known {
  source: PictureSource;
  colours: IUniform<Texture>;
  normals: IUniform<Texture>;
}

function plain(red: number, green: number, blue: number): Texture {
  const texture = new DataTexture(new Uint8Array([red, green, blue, 255]), 1, 1, RGBAFormat);
  texture.needsUpdate = true;
  return texture;
}

const white = plain(255, 255, 255);
const flat = plain(128, 128, 255);

/** The bottom row of the image has the texture coordinate 0. */
async function imageTexture(blob: Blob): Promise<Texture> {
  const image = await createImageBitmap(blob, {
    imageOrientation: "flipY",
    premultiplyAlpha: "none",
    colorSpaceConversion: "none",
  });
  const texture = new Texture(image);
  texture.flipY = false;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.magFilter = LinearFilter;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.needsUpdate = true;
  return texture;
}

export class Pictures {
  private known: Known[] = [];
  private loading = 0;

  /** `changed` is called when a picture has been read. */
  constructor(private readonly changed: () => void) {}

  /** Whether some have not been read yet. */
  get areLoading(): boolean {
    return this.loading > 0;
  }

  /** The pictures of a growth, which surfaces count from 1. */
  set(sources: readonly PictureSource[]): void {
    const before = this.known;
    this.known = sources.map(
      (source, i) => before.find((known, k) => k === i && sameSource(known.source, source)) ?? this.load(source),
    );
    for (const old of before) if (!this.known.includes(old)) release(old);
  }

  colours(number: number): IUniform<Texture> {
    return this.known[number - 1]?.colours ?? { value: white };
  }

  normals(number: number): IUniform<Texture> {
    return this.known[number - 1]?.normals ?? { value: flat };
  }

  hasRelief(number: number): boolean {
    return Boolean(this.known[number - 1]?.source.normals);
  }

  private load(source: PictureSource): Known {
    const known: Known = { source, colours: { value: white }, normals: { value: flat } };
    for (const part of ["colours", "normals"] as const) void this.read(source[part], known[part]);
    return known;
  }

  /** A picture that cannot be read stays white or flat. */
  private async read(source: Promise<Blob> | null, target: IUniform<Texture>): Promise<void> {
    if (!source) return;
    this.loading++;
    try {
      target.value = await imageTexture(await source);
    } catch {
      // The program has said why.
    }
    this.loading--;
    this.changed();
  }
}

function sameSource(a: PictureSource, b: PictureSource): boolean {
  return a.colours === b.colours && a.normals === b.normals;
}

function release({ colours, normals }: Known): void {
  for (const { value } of [colours, normals]) if (value !== white && value !== flat) value.dispose();
}
