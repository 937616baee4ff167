/** Where the sun of the scene stands: the sky as one sees it lying on the ground, with the head towards what one looks at. */
import { h, setLabel, short, svg, whole } from "./elements.js";
import type { SkyLook, Vector } from "./view/index.js";

const radius = 17;

/** Where the sun is in the dial, for a camera that has turned about the vertical: the middle is the zenith, the rim the horizon. */
export function placeInDial([x, y, z]: Vector, azimuth: number): { right: number; up: number } {
  const fromZenith = Math.acos(Math.min(1, y)) / (Math.PI / 2);
  const level = Math.hypot(x, z) || 1;
  const right = (x * Math.cos(azimuth) - z * Math.sin(azimuth)) / level;
  const up = -(x * Math.sin(azimuth) + z * Math.cos(azimuth)) / level;
  return { right: right * fromZenith, up: up * fromZenith };
}

export function elevation([, y]: Vector): number {
  return (Math.asin(Math.min(1, y)) * 180) / Math.PI;
}

function words({ sun, diffuse, par }: SkyLook): string {
  if (par <= 0) return "It is dark in this step.";
  const light = `${short(Math.round(par))} umol m-2 s-1 of PAR`;
  if (!sun) return `There is no sun in this step: ${light}, all from the sky.`;
  return `The sun stands ${elevation(sun).toFixed(0)}° high: ${light}, ${whole(100 * diffuse)} % of it from the sky.`;
}

export class SunDial {
  readonly element = h("div", "sun-dial", { hidden: true, role: "img" });
  private readonly dot = svg("circle", { r: 4, class: "sun-dial-sun" });
  private readonly height = h("span", "");
  private sun: Vector | null = null;
  private azimuth = 0;

  constructor() {
    const side = radius + 2;
    this.element.append(
      svg(
        "svg",
        { viewBox: `${-side} ${-side} ${2 * side} ${2 * side}`, width: 2 * side, height: 2 * side, "aria-hidden": "true" },
        svg("circle", { r: radius, class: "sun-dial-rim" }),
        svg("circle", { r: radius / 2, class: "sun-dial-ring" }),
        this.dot,
      ),
      this.height,
    );
  }

  /** null: no sky of a scene shows. */
  show(sky: SkyLook | null): void {
    this.element.hidden = sky === null;
    if (!sky) return;
    setLabel(this.element, words(sky));
    this.sun = sky.sun;
    this.height.textContent = sky.sun ? `${elevation(sky.sun).toFixed(0)}°` : "";
    this.draw();
  }

  /** The camera stands at another azimuth. */
  turn(azimuth: number): void {
    if (azimuth === this.azimuth) return;
    this.azimuth = azimuth;
    this.draw();
  }

  private draw(): void {
    this.dot.toggleAttribute("hidden", this.sun === null);
    if (!this.sun) return;
    const { right, up } = placeInDial(this.sun, this.azimuth);
    this.dot.setAttribute("cx", String(radius * right));
    this.dot.setAttribute("cy", String(-radius * up));
  }
}
