/** The background: a soft gradient behind everything. */
import { BufferGeometry, Color, GLSL3, Mesh, RawShaderMaterial } from "three";
import type { Theme } from "./colours.js";
import { setBytes } from "./shading.js";
import type { Vector } from "./vectors.js";

const vertex = /* glsl */ `
precision highp float;
out float height;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
  height = corner.y * 0.5 + 0.5;
  gl_Position = vec4(corner, 1.0, 1.0);
}
`;

const fragment = /* glsl */ `
precision highp float;
uniform vec3 top, horizon;
in float height;
out vec4 result;
void main() {
  result = vec4(mix(horizon, top, smoothstep(0.1, 1.0, height)), 1.0);
}
`;

export class Backdrop {
  readonly mesh: Mesh;
  private readonly top = new Color();
  private readonly horizon = new Color();

  constructor() {
    const geometry = new BufferGeometry();
    geometry.setDrawRange(0, 3);
    const material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: vertex,
      fragmentShader: fragment,
      depthWrite: false,
      depthTest: false,
      uniforms: { top: { value: this.top }, horizon: { value: this.horizon } },
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = -2;
  }

  /** The colours of the theme, or one colour from 0 to 1. */
  use(theme: Theme, colour: Vector | null): void {
    setBytes(this.top, theme.background);
    setBytes(this.horizon, theme.horizon);
    if (!colour) return;
    this.top.setRGB(...colour);
    this.horizon.copy(this.top);
  }
}
