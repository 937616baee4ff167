/** What all plant materials share: light, shadow, colour by module, marks, and the pass that writes identities. */
import {
  Color,
  DataTexture,
  DepthTexture,
  FloatType,
  GLSL3,
  LinearFilter,
  Matrix4,
  NearestFilter,
  NoBlending,
  RawShaderMaterial,
  RedFormat,
  RedIntegerFormat,
  RGBAFormat,
  UnsignedByteType,
  UnsignedIntType,
  Vector2,
  Vector3,
  Vector4,
  DoubleSide,
  type IUniform,
  type Texture,
} from "three";
import { mapTexture, type Theme } from "./colours.js";

/** What a pass draws. */
export enum Pass {
  picture = 0,
  identity = 1,
  shadow = 2,
}

const tableWidth = 2048;

function table<T extends Float32Array | Uint8Array>(values: T, make: (length: number) => T, byte: boolean): DataTexture {
  const rows = Math.max(1, Math.ceil(values.length / tableWidth));
  const padded = make(rows * tableWidth);
  padded.set(values);
  const texture = new DataTexture(
    padded as Float32Array<ArrayBuffer> | Uint8Array<ArrayBuffer>,
    tableWidth,
    rows,
    byte ? RedIntegerFormat : RedFormat,
    byte ? UnsignedByteType : FloatType,
  );
  if (byte) texture.internalFormat = "R8UI";
  texture.unpackAlignment = 1;
  texture.needsUpdate = true;
  return texture;
}

export function valueTable(values: Float32Array): DataTexture {
  return table(values, (length) => new Float32Array(length), false);
}

export function markTable(values: Uint8Array): DataTexture {
  return table(values, (length) => new Uint8Array(length), true);
}

function colourMap(): DataTexture {
  const texture = new DataTexture(mapTexture() as Uint8Array<ArrayBuffer>, 256, 1, RGBAFormat);
  texture.minFilter = LinearFilter;
  texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

export function shadowDepth(size: number): DepthTexture {
  const texture = new DepthTexture(size, size, UnsignedIntType);
  texture.minFilter = NearestFilter;
  texture.magFilter = NearestFilter;
  return texture;
}

/** Uniforms that every material of a scene shares by reference. */
export function sharedUniforms() {
  return {
    pass: { value: Pass.picture },
    eye: { value: new Vector4(0, 0, 1, 0) },
    pixel: { value: 0.001 },
    screenPixel: { value: 0.001 },
    sun: { value: new Vector3(0.45, 0.8, 0.4).normalize() },
    sunColour: { value: new Color() },
    sunStrength: { value: 1 },
    groundShade: { value: 0 },
    skyColour: { value: new Color() },
    soilColour: { value: new Color() },
    markColour: { value: new Color() },
    kinColour: { value: new Color() },
    colouring: { value: 0 },
    range: { value: new Vector2(0, 1) },
    values: { value: valueTable(new Float32Array(1)) },
    marks: { value: markTable(new Uint8Array(1)) },
    marked: { value: false },
    colourMap: { value: colourMap() },
    shadowed: { value: false },
    shadowMap: { value: null as Texture | null },
    shadowMatrix: { value: new Matrix4() },
    shadowBias: { value: 0.01 },
  };
}

export type SharedUniforms = ReturnType<typeof sharedUniforms>;

/** Sets a colour to one that is written as 0xrrggbb, without a change of colour space. */
export function setBytes(target: Color, hex: number): void {
  target.setRGB(((hex >> 16) & 255) / 255, ((hex >> 8) & 255) / 255, (hex & 255) / 255);
}

/** The shaders compute with squares of the colours, which is near enough to linear light. */
function squared(target: Color, hex: number): void {
  setBytes(target, hex);
  target.setRGB(target.r * target.r, target.g * target.g, target.b * target.b);
}

export function useTheme(uniforms: SharedUniforms, theme: Theme): void {
  squared(uniforms.sunColour.value, theme.sun);
  squared(uniforms.skyColour.value, theme.sky);
  squared(uniforms.soilColour.value, theme.soil);
  squared(uniforms.markColour.value, theme.mark);
  squared(uniforms.kinColour.value, theme.kin);
}

const vertexHead = /* glsl */ `
precision highp float;
precision highp int;
precision highp usampler2D;
uniform mat4 viewMatrix, projectionMatrix;
uniform int pass;
uniform vec4 eye;
uniform float pixel;
uniform int colouring;
uniform vec2 range;
uniform highp sampler2D values;
uniform usampler2D marks;
uniform bool marked;
uniform sampler2D colourMap;
uniform vec3 markColour, kinColour, sun;
uniform bool shadowed;
uniform highp sampler2D shadowMap;
uniform mat4 shadowMatrix;
uniform float shadowBias;
flat out uint identity;

ivec2 place(int index) { return ivec2(index & 2047, index >> 11); }

vec3 colourOf(uint module, vec3 own, float order) {
  vec3 result = own * own;
  if (colouring == 1) {
    float value = texelFetch(values, place(int(module)), 0).r;
    float part = clamp((value - range.x) / max(range.y - range.x, 1e-30), 0.0, 1.0);
    result = isnan(value) ? vec3(0.25) : texture(colourMap, vec2(part * 0.998 + 0.001, 0.5)).rgb;
    if (!isnan(value)) result *= result;
  } else if (colouring == 2) {
    result = texture(colourMap, vec2(clamp(order / max(range.y, 1.0), 0.0, 1.0) * 0.998 + 0.001, 0.5)).rgb;
    result *= result;
  } else if (colouring == 3) result = vec3(0.25);
  if (marked) {
    uint mark = texelFetch(marks, place(int(module)), 0).r;
    if (mark == 1u) result = markColour * 1.4;
    else if (mark == 2u) result = mix(result, kinColour, 0.75);
    else result *= 0.75;
  }
  return result;
}

/** Light with a hard edge, for what is too thin to show a soft one. */
float litOnce(vec3 point) {
  if (!shadowed) return 1.0;
  vec3 at = (shadowMatrix * vec4(point, 1.0)).xyz;
  return float(texture(shadowMap, at.xy).r > at.z - shadowBias);
}

float lit(vec3 point) {
  if (!shadowed) return 1.0;
  vec3 at = (shadowMatrix * vec4(point, 1.0)).xyz;
  vec2 step = vec2(1.3 / 1024.0, 0.0);
  float depth = at.z - shadowBias;
  float sum = 0.0;
  sum += float(texture(shadowMap, at.xy + step.xy).r > depth);
  sum += float(texture(shadowMap, at.xy - step.xy).r > depth);
  sum += float(texture(shadowMap, at.xy + step.yx).r > depth);
  sum += float(texture(shadowMap, at.xy - step.yx).r > depth);
  return sum * 0.25;
}
`;

const fragmentHead = /* glsl */ `
precision highp float;
precision highp int;
uniform int pass;
uniform vec3 sun, sunColour, skyColour, soilColour;
uniform float sunStrength;
flat in uint identity;
out vec4 result;

vec4 identityColour() {
  return vec4(uvec4(identity, identity >> 8, identity >> 16, identity >> 24) & 255u) / 255.0;
}

vec4 shade(vec3 albedo, vec3 normal, float light) {
  float direct = max(dot(normal, sun), 0.0);
  float wrapped = 0.5 + 0.5 * normal.y;
  vec3 ambient = mix(soilColour, skyColour, wrapped);
  vec3 sum = albedo * (ambient * (0.55 + 0.3 * light) + sunColour * sunStrength * (direct * light * 0.95 + 0.06));
  return vec4(sqrt(sum), 1.0);
}

/** Drops pixels so that the share that stays is the opacity: no order of drawing is needed. */
void thin(float opacity) {
  if (opacity > 0.99) return;
  ivec2 at = ivec2(gl_FragCoord.xy) & 3;
  int bayer = ((at.x ^ at.y) & 1) * 8 + (at.y & 1) * 4 + (((at.x ^ at.y) >> 1) & 1) * 2 + ((at.y >> 1) & 1);
  if (opacity < (float(bayer) + 0.5) / 16.0) discard;
}
`;

export interface ShaderParts {
  uniforms: Record<string, IUniform>;
  vertex: string;
  fragment: string;
}

export function plantMaterial(parts: ShaderParts): RawShaderMaterial {
  return new RawShaderMaterial({
    glslVersion: GLSL3,
    uniforms: parts.uniforms,
    vertexShader: vertexHead + parts.vertex,
    fragmentShader: fragmentHead + parts.fragment,
    side: DoubleSide,
    blending: NoBlending,
  });
}

/**
 * Shades a surface from both sides; `image` is GLSL for the colour of its image there, as a vec4, and `bend` for its normal. Wood
 * lets no light through.
 */
export function surfaceFragment(head: string, image: string, isWood = false, bend = "normal"): string {
  return /* glsl */ `
in vec3 turned, towards;
in vec4 mixed;
in float light;
${head}

void main() {
  vec4 painted = ${image};
  if (painted.a < 0.5) discard;
  thin(mixed.a);
  vec3 albedo = mixed.rgb * painted.rgb * painted.rgb;
  if (pass != 0) {
    result = identityColour();
    return;
  }
  vec3 normal = normalize(dot(turned, towards) < 0.0 ? -turned : turned);
  normal = ${bend};
  // A thin leaf lets some light through: its shaded side is never quite dark.
  float through = ${isWood ? "0.0" : "0.35 * max(dot(-normal, sun), 0.0) * light * sunStrength"};
  result = shade(albedo, normal, light);
  result.rgb = sqrt(result.rgb * result.rgb + albedo * through);
}
`;
}
