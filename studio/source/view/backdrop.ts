/** The background: a soft gradient behind everything, and the sun of a scene where one looks towards it. */
import { BufferGeometry, Color, GLSL3, Mesh, RawShaderMaterial, Vector3 } from "three";
import type { Theme } from "./colours.js";
import type { SkyLook } from "./light.js";
import { setBytes } from "./shading.js";
import type { Vector } from "./vectors.js";

const vertex = /* glsl */ `
precision highp float;
uniform mat4 viewMatrix, projectionMatrix;
uniform vec3 sun;
out vec2 fromSun;
out float height;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
  height = corner.y * 0.5 + 0.5;
  gl_Position = vec4(corner, 1.0, 1.0);
  // In radians, near the middle of the picture; far away where the sun is behind the eye.
  vec4 at = projectionMatrix * vec4(mat3(viewMatrix) * sun, 0.0);
  vec2 scale = vec2(projectionMatrix[0][0], projectionMatrix[1][1]);
  fromSun = at.w > 0.0 ? (corner - at.xy / at.w) / scale : vec2(10.0);
}
`;

/** The disc is five times as wide as that of the sun, with a halo: it is a mark. */
const fragment = /* glsl */ `
precision highp float;
uniform vec3 top, horizon, sunColour;
in vec2 fromSun;
in float height;
out vec4 result;
void main() {
  vec3 sky = mix(horizon, top, smoothstep(0.1, 1.0, height));
  float away = length(fromSun) / 0.0233;
  float disc = 1.0 - smoothstep(1.0 - fwidth(away), 1.0 + fwidth(away), away);
  result = vec4(mix(sky, sunColour, max(disc, 0.55 * exp(-0.8 * away))), 1.0);
}
`;

const sunMark = new Color(1, 0.8, 0.3);

export class Backdrop {
  readonly mesh: Mesh;
  private readonly top = new Color();
  private readonly horizon = new Color();
  private readonly sun = new Vector3();
  private readonly sunColour = new Color();

  constructor() {
    const geometry = new BufferGeometry();
    geometry.setDrawRange(0, 3);
    const material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: vertex,
      fragmentShader: fragment,
      depthWrite: false,
      depthTest: false,
      uniforms: {
        top: { value: this.top },
        horizon: { value: this.horizon },
        sun: { value: this.sun },
        sunColour: { value: this.sunColour },
      },
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = -2;
  }

  /** The colours of the theme, or one colour from 0 to 1; and the sun of a sky. */
  use(theme: Theme, colour: Vector | null, sky: SkyLook | null): void {
    setBytes(this.top, theme.background);
    setBytes(this.horizon, theme.horizon);
    if (colour) {
      this.top.setRGB(...colour);
      this.horizon.copy(this.top);
    }
    // The null vector has no place in the picture.
    this.sun.set(...(sky?.sun ?? ([0, 0, 0] as const)));
    if (sky) this.sunColour.copy(sunMark).multiply(new Color(...sky.colour));
  }
}
