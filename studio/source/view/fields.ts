/** A field of numbers in space: as a slice, as a cloud of points whose opacity is the value, or as the surface of one value. */
import {
  BufferAttribute,
  BufferGeometry,
  Data3DTexture,
  DoubleSide,
  GLSL3,
  LinearFilter,
  Mesh,
  Points,
  RawShaderMaterial,
  RedFormat,
  Vector3,
  type Scene,
} from "three";
import { isosurface } from "./isosurface.js";
import type { Field } from "./packets.js";
import type { SharedUniforms } from "./shading.js";
import type { Axis } from "./vectors.js";

export interface FieldLook {
  mode: "slice" | "cloud" | "surface";
  /** 0, 1, 2: the axis that the slice is perpendicular to. */
  axis: Axis;
  /** From 0 to 1: where the slice is, or between which of the lowest and highest value the surface. */
  at: number;
}

const head = /* glsl */ `
precision highp float;
precision highp int;
uniform highp sampler3D field;
uniform sampler2D colourMap;
uniform vec3 lower, upper;
vec4 paint(float value) {
  return vec4(texture(colourMap, vec2(value * 0.998 + 0.001, 0.5)).rgb, 1.0);
}
`;

const sliceVertex = /* glsl */ `
uniform mat4 viewMatrix, projectionMatrix;
uniform int axis;
uniform float at;
out vec3 part;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  part = axis == 0 ? vec3(at, corner) : axis == 1 ? vec3(corner.x, at, corner.y) : vec3(corner, at);
  gl_Position = projectionMatrix * (viewMatrix * vec4(mix(lower, upper, part), 1.0));
}
`;

const sliceFragment = /* glsl */ `
in vec3 part;
out vec4 result;
void main() {
  float value = texture(field, part).r;
  result = vec4(paint(value).rgb, 0.45 + 0.5 * value);
}
`;

const cloudVertex = /* glsl */ `
uniform mat4 viewMatrix, projectionMatrix;
uniform float pixel;
uniform ivec3 size;
flat out vec4 colour;
void main() {
  ivec3 at = ivec3(gl_VertexID % size.x, (gl_VertexID / size.x) % size.y, gl_VertexID / (size.x * size.y));
  float value = texelFetch(field, at, 0).r;
  vec3 place = mix(lower, upper, (vec3(at) + 0.5) / vec3(size));
  gl_Position = value < 0.02 ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * (viewMatrix * vec4(place, 1.0));
  vec3 voxel = (upper - lower) / vec3(size);
  gl_PointSize = clamp(0.9 * min(voxel.x, min(voxel.y, voxel.z)) / (pixel * max(gl_Position.w, 1e-6)), 1.0, 24.0);
  colour = vec4(paint(value).rgb, 0.015 + 0.13 * value * value);
}
`;

const cloudFragment = /* glsl */ `
flat in vec4 colour;
out vec4 result;
void main() {
  result = colour;
}
`;

const surfaceVertex = /* glsl */ `
uniform mat4 viewMatrix, projectionMatrix;
in vec3 position;
out vec3 part, place;
void main() {
  part = position;
  place = mix(lower, upper, position);
  gl_Position = projectionMatrix * (viewMatrix * vec4(place, 1.0));
}
`;

/** The normal is the gradient of the field. */
const surfaceFragment = /* glsl */ `
uniform ivec3 size;
uniform float at;
uniform vec4 eye;
uniform vec3 sun;
in vec3 part, place;
out vec4 result;
void main() {
  vec3 d = 1.0 / vec3(size);
  vec3 gradient = vec3(
    texture(field, part + vec3(d.x, 0, 0)).r - texture(field, part - vec3(d.x, 0, 0)).r,
    texture(field, part + vec3(0, d.y, 0)).r - texture(field, part - vec3(0, d.y, 0)).r,
    texture(field, part + vec3(0, 0, d.z)).r - texture(field, part - vec3(0, 0, d.z)).r) / (upper - lower) * vec3(size);
  vec3 normal = gradient * inversesqrt(max(dot(gradient, gradient), 1e-20));
  if (dot(normal, eye.xyz - place) < 0.0) normal = -normal;
  result = vec4(paint(at).rgb * (0.6 + 0.4 * max(dot(normal, sun), 0.0)), 0.6);
}
`;

function uniformsOf({ colourMap, pixel, eye, sun }: SharedUniforms) {
  return {
    field: { value: new Data3DTexture(new Uint8Array(1), 1, 1, 1) },
    colourMap,
    pixel,
    eye,
    sun,
    lower: { value: new Vector3() },
    upper: { value: new Vector3() },
    size: { value: new Vector3(1, 1, 1) },
    axis: { value: 1 },
    at: { value: 0.5 },
  };
}

export class FieldView {
  private readonly uniforms: ReturnType<typeof uniformsOf>;
  private readonly slice: Mesh;
  private readonly cloud: Points;
  private readonly surface: Mesh;
  private field: Field | null = null;
  /** The level of the surface that there is. */
  private level = -1;

  constructor(shared: SharedUniforms, scene: Scene) {
    this.uniforms = uniformsOf(shared);
    const square = new BufferGeometry();
    square.setIndex([0, 1, 2, 2, 1, 3]);
    this.slice = new Mesh(square, this.material(sliceVertex, sliceFragment));
    this.cloud = new Points(new BufferGeometry(), this.material(cloudVertex, cloudFragment));
    this.surface = new Mesh(new BufferGeometry(), this.material(surfaceVertex, surfaceFragment));
    for (const part of [this.slice, this.cloud, this.surface]) {
      part.frustumCulled = false;
      part.visible = false;
      part.renderOrder = 2;
      scene.add(part);
    }
  }

  show(field: Field): void {
    const [columns, rows, layers] = field.size;
    this.field = field;
    this.level = -1;
    this.uniforms.field.value.dispose();
    const texture = new Data3DTexture(field.values as Uint8Array<ArrayBuffer>, columns, rows, layers);
    texture.format = RedFormat;
    texture.minFilter = LinearFilter;
    texture.magFilter = LinearFilter;
    texture.unpackAlignment = 1;
    texture.needsUpdate = true;
    this.uniforms.field.value = texture;
    this.uniforms.lower.value.set(...field.lower);
    this.uniforms.upper.value.set(...field.upper);
    this.uniforms.size.value.set(columns, rows, layers);
    this.cloud.geometry.setDrawRange(0, columns * rows * layers);
  }

  look(look: FieldLook | null): void {
    this.slice.visible = look?.mode === "slice";
    this.cloud.visible = look?.mode === "cloud";
    this.surface.visible = look?.mode === "surface";
    if (!look) return;
    if (this.surface.visible) this.makeSurface(look.at);
    this.uniforms.axis.value = look.axis;
    this.uniforms.at.value = look.at;
  }

  private makeSurface(at: number): void {
    // A whole level would touch voxels everywhere.
    const level = Math.floor(at * 254) + 0.5;
    if (!this.field || level === this.level) return;
    this.level = level;
    const { positions, indices } = isosurface(this.field.values, this.field.size, level);
    this.surface.geometry.dispose();
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    geometry.setIndex(new BufferAttribute(indices, 1));
    this.surface.geometry = geometry;
  }

  private material(vertexShader: string, fragmentShader: string): RawShaderMaterial {
    return new RawShaderMaterial({
      glslVersion: GLSL3,
      uniforms: this.uniforms,
      vertexShader: head + vertexShader,
      fragmentShader: head + fragmentShader,
      transparent: true,
      depthWrite: false,
      side: DoubleSide,
    });
  }
}
