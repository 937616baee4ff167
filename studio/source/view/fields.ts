/** A field of numbers in space: as a slice, or as a cloud of points whose opacity is the value. */
import {
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
import type { Field } from "./packets.js";
import type { Uniforms } from "./shading.js";

export interface FieldLook {
  mode: "slice" | "cloud";
  /** 0, 1, 2: the axis that the slice is perpendicular to. */
  axis: number;
  /** Where the slice is, from 0 to 1. */
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

export class FieldView {
  private readonly uniforms: Uniforms;
  private readonly slice: Mesh;
  private readonly cloud: Points;

  constructor(shared: Uniforms, scene: Scene) {
    this.uniforms = {
      field: { value: new Data3DTexture(new Uint8Array(1), 1, 1, 1) },
      colourMap: shared.colourMap,
      pixel: shared.pixel,
      lower: { value: new Vector3() },
      upper: { value: new Vector3() },
      size: { value: new Vector3(1, 1, 1) },
      axis: { value: 1 },
      at: { value: 0.5 },
    };
    const square = new BufferGeometry();
    square.setIndex([0, 1, 2, 2, 1, 3]);
    this.slice = new Mesh(square, this.material(sliceVertex, sliceFragment));
    this.cloud = new Points(new BufferGeometry(), this.material(cloudVertex, cloudFragment));
    for (const part of [this.slice, this.cloud]) {
      part.frustumCulled = false;
      part.visible = false;
      part.renderOrder = 2;
      scene.add(part);
    }
  }

  show(field: Field): void {
    const [columns, rows, layers] = field.size;
    (this.uniforms.field.value as Data3DTexture).dispose();
    const texture = new Data3DTexture(field.values as Uint8Array<ArrayBuffer>, columns, rows, layers);
    texture.format = RedFormat;
    texture.minFilter = LinearFilter;
    texture.magFilter = LinearFilter;
    texture.unpackAlignment = 1;
    texture.needsUpdate = true;
    this.uniforms.field.value = texture;
    (this.uniforms.lower.value as Vector3).set(...field.lower);
    (this.uniforms.upper.value as Vector3).set(...field.upper);
    (this.uniforms.size.value as Vector3).set(columns, rows, layers);
    this.cloud.geometry.setDrawRange(0, columns * rows * layers);
  }

  look(look: FieldLook | null): void {
    this.slice.visible = look?.mode === "slice";
    this.cloud.visible = look?.mode === "cloud";
    if (!look) return;
    this.uniforms.axis.value = look.axis;
    this.uniforms.at.value = look.at;
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
