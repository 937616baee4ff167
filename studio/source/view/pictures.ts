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

  /** The pictures of a growth, which surfaces count from 1. `changed` is called when one has been read. */
  set(sources: readonly PictureSource[], changed: () => void): void {
    const before = this.known;
    this.known = sources.map(
      (source, i) => before.find((known, k) => k === i && sameSource(known.source, source)) ?? this.load(source, changed),
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

  private load(source: PictureSource, changed: () => void): Known {
    const known: Known = { source, colours: { value: white }, normals: { value: flat } };
    for (const part of ["colours", "normals"] as const)
      source[part]?.then(imageTexture).then(
        (texture) => {
          known[part].value = texture;
          changed();
        },
        () => undefined,
      );
    return known;
  }
}

function sameSource(a: PictureSource, b: PictureSource): boolean {
  return a.colours === b.colours && a.normals === b.normals;
}

function release({ colours, normals }: Known): void {
  for (const { value } of [colours, normals]) if (value !== white && value !== flat) value.dispose();
}
