/** What lights the plants: sun and sky of the scene, the light of a view file, or the usual sun. */
import { Vector3 } from "three";
import type { Theme } from "./colours.js";
import { useTheme, type SharedUniforms } from "./shading.js";
import type { Vector } from "./vectors.js";

/** How the author of a model looked at it, where that is known. */
export interface AuthorLook {
  towardsEye: Vector | null;
  towardsLight: Vector | null;
  /** Red, green, blue from 0 to 1. */
  background: Vector | null;
}

/** The light of a step, as its scene has it. */
export interface SkyLook {
  /** Unit vector; null: there is light of the sky alone. */
  sun: Vector | null;
  /** Of the sun: linear, the largest 1. */
  colour: Vector;
  /** Share of the sky in the light on level ground. */
  diffuse: number;
  /** Of PAR on level ground, umol m-2 s-1; 0: it is dark. */
  par: number;
}

const usualSun = new Vector3(0.45, 0.8, 0.4).normalize();
const lowestSun = Math.sin((5 * Math.PI) / 180); // shadows of a lower one would be endless
const usualDiffuse = 0.43; // with the colours of the themes
const atNight = 0.4; // of the usual light
const usualShade = 0.42; // what a shadow takes from the ground

const within = (low: number, value: number, high: number) => Math.min(high, Math.max(low, value));

/**
 * How bright sun and sky are, as multiples of the usual ones; `onGround`: the sun on level ground. The share of each on level ground is that of the scene, and the whole is
 * always as bright: eyes get used to light. A low sun shines on what faces it; it is not made endlessly bright.
 */
export function brightness({ sun, diffuse, par }: SkyLook): { sun: number; sky: number; onGround: number } {
  if (par <= 0) return { sun: 0, sky: atNight, onGround: 0 };
  const onGround = sun ? (1 - diffuse) / (1 - usualDiffuse) : 0;
  const rise = sun ? usualSun.y / Math.max(sun[1], lowestSun) : 1;
  return { sun: Math.min(onGround * rise, 1.4), sky: within(0.6, diffuse / usualDiffuse, 1.7), onGround };
}

export class SceneLight {
  author: AuthorLook = { towardsEye: null, towardsLight: null, background: null };
  authorShows = true;
  sky: SkyLook | null = null;
  skyShows = true;

  constructor(private readonly uniforms: SharedUniforms) {}

  /** The sky that lights the plants; null: something else does. */
  get shownSky(): SkyLook | null {
    return this.skyShows ? this.sky : null;
  }

  /** Light and background of the view file, as far as they show. */
  get shownAuthor(): AuthorLook {
    const { author } = this;
    return this.authorShows ? { ...author, towardsEye: null } : { towardsEye: null, towardsLight: null, background: null };
  }

  get castsShadows(): boolean {
    return this.uniforms.sunStrength.value > 0;
  }

  apply(theme: Theme): void {
    const { sun, sunColour, sunStrength, groundShade, skyColour, soilColour } = this.uniforms;
    const { shownSky } = this;
    useTheme(this.uniforms, theme);
    sunStrength.value = 1;
    groundShade.value = usualShade;
    sun.value.copy(usualSun);
    const towards = shownSky ? shownSky.sun : this.shownAuthor.towardsLight;
    if (towards) {
      sun.value.set(...towards).normalize();
      sun.value.y = Math.max(sun.value.y, lowestSun);
      sun.value.normalize();
    }
    if (!shownSky) return;
    const bright = brightness(shownSky);
    sunStrength.value = bright.sun;
    groundShade.value = usualShade * bright.onGround;
    sunColour.value.setRGB(...shownSky.colour);
    skyColour.value.multiplyScalar(bright.sky);
    soilColour.value.multiplyScalar(bright.sky);
  }
}
