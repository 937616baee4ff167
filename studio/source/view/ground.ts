/** The ground: a plane that fades into the background, with the shadow of the plant and a grid that tells its scale. */
import {
  Color,
  CustomBlending,
  DoubleSide,
  GLSL3,
  Mesh,
  NoBlending,
  OneFactor,
  OneMinusSrcAlphaFactor,
  PlaneGeometry,
  RawShaderMaterial,
  Scene,
  Vector3,
  WebGLRenderTarget,
  type Camera,
  type ShaderMaterialParameters,
  type Texture,
  type WebGLRenderer,
} from "three";
import type { Theme } from "./colours.js";
import { setBytes, type SharedUniforms } from "./shading.js";

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

/** How much of the sun each place of the ground is denied, with soft edges; drawn from the sun, once for each packet. */
const shadeFragment = /* glsl */ `
precision highp float;
uniform highp sampler2D shadowMap;
uniform mat4 shadowMatrix;
in vec3 place;
out vec4 result;

void main() {
  vec3 at = (shadowMatrix * vec4(place, 1.0)).xyz;
  float sum = 0.0, weights = 0.0;
  for (int i = -2; i <= 2; i++)
    for (int j = -2; j <= 2; j++) {
      float weight = exp(-0.35 * float(i * i + j * j));
      sum += weight * float(texture(shadowMap, at.xy + vec2(i, j) * (1.3 / 1024.0)).r < at.z - 0.002);
      weights += weight;
    }
  result = vec4(sum / weights);
}
`;

const fragment = /* glsl */ `
precision highp float;
uniform sampler2D shade;
uniform mat4 shadowMatrix;
uniform vec3 colour, centre;
uniform float extent, cell, opacity, groundShade;
uniform bool shadowed;
in vec3 place;
out vec4 result;

/** Lines of the grid, and finer ones between them where they can be told apart. */
float grid() {
  vec2 at = place.xz / cell;
  vec2 width = fwidth(at);
  float coarse = max(width.x, width.y);
  vec2 line = max(vec2(0.0), 1.0 - abs(fract(at - 0.5) - 0.5) / (width * 1.5));
  vec2 fine = max(vec2(0.0), 1.0 - abs(fract(at * 5.0 - 0.5) - 0.5) / (width * 7.5));
  return max(line.x, line.y) * 0.10 * clamp(1.6 - coarse * 4.0, 0.0, 1.0)
       + max(fine.x, fine.y) * 0.04 * clamp(1.6 - coarse * 20.0, 0.0, 1.0);
}

void main() {
  float away = length(place.xz - centre.xz) / extent;
  float fade = 1.0 - smoothstep(0.12, 0.5, away);
  vec2 at = (shadowMatrix * vec4(place, 1.0)).xy;
  float dark = shadowed ? texture(shade, at).r : 0.0;
  result = vec4(colour * (1.0 - groundShade * dark) * (1.0 - grid()), fade * opacity);
}
`;

/** The largest of 1, 2 or 5 times a power of ten that is not above a length. */
export function niceLength(length: number): number {
  const power = 10 ** Math.floor(Math.log10(Math.max(length, 1e-9)));
  const factor = [5, 2, 1].find((candidate) => candidate * power <= length) ?? 1;
  return factor * power;
}

function uniformsOf({ shadowMap, shadowMatrix, shadowed, groundShade }: SharedUniforms) {
  return {
    shadowMap,
    shadowMatrix,
    shadowed,
    groundShade,
    shade: { value: null as Texture | null },
    colour: { value: new Color() },
    centre: { value: new Vector3() },
    extent: { value: 10 },
    cell: { value: 1 },
  };
}

export class Ground {
  /** Drawn before the plant, so that roots are seen through it. */
  readonly mesh: Mesh;
  /** Drawn after the plant: a thin veil over what is below. */
  readonly veil: Mesh;
  private readonly shadeTarget = new WebGLRenderTarget(512, 512, { depthBuffer: false });
  private readonly shadeScene = new Scene();
  private readonly uniforms: ReturnType<typeof uniformsOf>;

  constructor(shared: SharedUniforms) {
    this.uniforms = uniformsOf(shared);
    this.shadeScene.add(this.plane(1, shadeFragment, { blending: NoBlending, depthTest: false }));
    this.mesh = this.plane(1, fragment, {
      blending: CustomBlending,
      blendSrcAlpha: OneFactor,
      blendDstAlpha: OneMinusSrcAlphaFactor,
    });
    this.mesh.renderOrder = -1;
    this.veil = this.plane(0.3, fragment, { transparent: true });
    this.veil.renderOrder = 1;
  }

  /** Draws the soft shadow; the shadow map of the plant has been drawn before. */
  drawShade(renderer: WebGLRenderer, sun: Camera): void {
    this.uniforms.shade.value = null;
    renderer.setRenderTarget(this.shadeTarget);
    renderer.setClearColor(0x000000, 1);
    renderer.clear();
    renderer.render(this.shadeScene, sun);
    renderer.setRenderTarget(null);
    this.uniforms.shade.value = this.shadeTarget.texture;
  }

  private plane(opacity: number, fragmentShader: string, how: Partial<ShaderMaterialParameters>): Mesh {
    const material = new RawShaderMaterial({
      glslVersion: GLSL3,
      uniforms: { ...this.uniforms, opacity: { value: opacity } },
      vertexShader: vertex,
      fragmentShader,
      depthWrite: false,
      side: DoubleSide,
      ...how,
    });
    const mesh = new Mesh(new PlaneGeometry(2, 2), material);
    mesh.frustumCulled = false;
    return mesh;
  }

  /** The side of a square of the grid in metres. */
  get cell(): number {
    return this.uniforms.cell.value;
  }

  place(centre: Vector3, radius: number): void {
    this.uniforms.centre.value.copy(centre);
    this.uniforms.extent.value = radius * 8;
    this.uniforms.cell.value = niceLength(radius * 1.2);
  }

  useTheme(theme: Theme): void {
    setBytes(this.uniforms.colour.value, theme.ground);
  }
}
