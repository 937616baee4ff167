/** The ground: a plane that fades into the background, with the shadow of the plant and a grid that tells its scale. */
import { Color, CustomBlending, DoubleSide, GLSL3, Mesh, PlaneGeometry, RawShaderMaterial, Vector3, type Blending } from "three";
import type { Theme } from "./colours.js";
import type { Uniforms } from "./shading.js";

const vertex = /* glsl */ `
precision highp float;
uniform mat4 viewMatrix, projectionMatrix;
uniform vec3 centre;
uniform float extent;
in vec3 position;
out vec3 place;
void main() {
  place = vec3(position.x * extent, 0.0, position.y * extent) + vec3(centre.x, 0.0, centre.z);
  gl_Position = projectionMatrix * (viewMatrix * vec4(place, 1.0));
}
`;

const fragment = /* glsl */ `
precision highp float;
uniform highp sampler2D shadowMap;
uniform mat4 shadowMatrix;
uniform vec3 colour, centre;
uniform float extent, cell, opacity;
uniform bool shadowed;
in vec3 place;
out vec4 result;

float shade() {
  vec3 at = (shadowMatrix * vec4(place, 1.0)).xyz;
  if (!shadowed || any(lessThan(at.xy, vec2(0.01))) || any(greaterThan(at.xy, vec2(0.99)))) return 0.0;
  const vec2 around[5] = vec2[5](vec2(0.0), vec2(1.7, 0.6), vec2(-0.6, 1.7), vec2(-1.7, -0.6), vec2(0.6, -1.7));
  float sum = 0.0;
  for (int i = 0; i < 5; i++) sum += float(texture(shadowMap, at.xy + around[i] * (1.2 / 1024.0)).r < at.z - 0.002);
  return sum / 5.0;
}

float grid(float size) {
  vec2 at = place.xz / size;
  vec2 width = fwidth(at);
  vec2 line = smoothstep(width * 1.5, vec2(0.0), abs(fract(at - 0.5) - 0.5));
  return max(line.x, line.y) * (1.0 - smoothstep(0.15, 0.4, max(width.x, width.y)));
}

void main() {
  float away = length(place.xz - centre.xz) / extent;
  float fade = 1.0 - smoothstep(0.12, 0.5, away);
  float lines = grid(cell) * 0.10 + grid(cell * 0.2) * 0.04;
  float dark = 1.0 - 0.42 * shade();
  result = vec4(colour * dark * (1.0 - lines), fade * opacity);
}
`;

/** The largest of 1, 2 or 5 times a power of ten that is not above a length. */
export function niceLength(length: number): number {
  const power = 10 ** Math.floor(Math.log10(Math.max(length, 1e-9)));
  const factor = [5, 2, 1].find((candidate) => candidate * power <= length) ?? 1;
  return factor * power;
}

export class Ground {
  /** Drawn before the plant, so that roots are seen through it. */
  readonly mesh: Mesh;
  /** Drawn after the plant: a thin veil over what is below. */
  readonly veil: Mesh;
  private readonly uniforms: Uniforms;

  constructor(shared: Uniforms) {
    this.uniforms = {
      shadowMap: shared.shadowMap, shadowMatrix: shared.shadowMatrix, shadowed: shared.shadowed,
      colour: { value: new Color() },
      centre: { value: new Vector3() },
      extent: { value: 10 },
      cell: { value: 1 },
    };
    this.mesh = this.plane(1, { blending: CustomBlending });
    this.mesh.renderOrder = -1;
    this.veil = this.plane(0.3, { transparent: true });
    this.veil.renderOrder = 1;
  }

  private plane(opacity: number, how: { blending?: Blending; transparent?: boolean }): Mesh {
    const material = new RawShaderMaterial({
      glslVersion: GLSL3, uniforms: { ...this.uniforms, opacity: { value: opacity } }, vertexShader: vertex, fragmentShader: fragment,
      depthWrite: false, side: DoubleSide, ...how,
    });
    const mesh = new Mesh(new PlaneGeometry(2, 2), material);
    mesh.frustumCulled = false;
    return mesh;
  }

  /** The side of a square of the grid in metres. */
  get cell(): number {
    return this.uniforms.cell.value as number;
  }

  place(centre: Vector3, radius: number): void {
    (this.uniforms.centre.value as Vector3).copy(centre);
    this.uniforms.extent.value = radius * 8;
    this.uniforms.cell.value = niceLength(radius * 1.2);
  }

  useTheme(theme: Theme): void {
    const hex = theme.ground;
    (this.uniforms.colour.value as Color).setRGB(((hex >> 16) & 255) / 255, ((hex >> 8) & 255) / 255, (hex & 255) / 255);
  }
}
