/**
 * Internodes as impostors. The vertex shader reads the records of the packet from a texture: no vertex is stored. What is wider
 * than a line of the picture is drawn with four vertices that face the eye, and the fragment shader shades it as a tapered
 * cylinder with round ends. The rest is drawn as lines: on a processor, a triangle costs far more than a line.
 */
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  DataTexture,
  LineSegments,
  Mesh,
  RGIntegerFormat,
  UnsignedIntType,
  Vector3,
} from "three";
import { at, increase } from "../lists.js";
import type { Packet } from "./packets.js";
import { plantMaterial, type SharedUniforms } from "./shading.js";
import { vectorOf } from "./vectors.js";

const perRow = 680; // internodes; three texels each, below the 2048 that every card has

const records = /* glsl */ `
uniform usampler2D records;
uniform vec3 lower, size;
uniform float thickest;

struct Internode { vec3 base, tip; float baseRadius, tipRadius; uint tint, module; };

Internode internodeOf(int number) {
  ivec2 at = ivec2((number % ${perRow}) * 3, number / ${perRow});
  uvec2 a = texelFetch(records, at, 0).xy;
  uvec2 b = texelFetch(records, at + ivec2(1, 0), 0).xy;
  uvec2 c = texelFetch(records, at + ivec2(2, 0), 0).xy;
  return Internode(
    lower + size * vec3(a.x & 65535u, a.x >> 16, a.y & 65535u) / 65535.0,
    lower + size * vec3(a.y >> 16, b.x & 65535u, b.x >> 16) / 65535.0,
    thickest * float(b.y & 65535u) / 65535.0, thickest * float(b.y >> 16) / 65535.0, c.x, c.y);
}

vec3 ownColour(Internode it) {
  return colourOf(it.module, vec3(it.tint & 255u, (it.tint >> 8) & 255u, (it.tint >> 16) & 255u) / 255.0, float(it.tint >> 24));
}
`;

const thickVertex = /* glsl */ `
out vec3 across;
flat out vec3 side, front, colour;
out float light;

void main() {
  Internode it = internodeOf(gl_VertexID >> 2);
  bool atTip = (gl_VertexID & 2) != 0;
  float sign = (gl_VertexID & 1) != 0 ? 1.0 : -1.0;
  vec3 centre = atTip ? it.tip : it.base;
  float r = atTip ? it.tipRadius : it.baseRadius;

  front = eye.w > 0.0 ? normalize(eye.xyz - it.base) : eye.xyz;
  vec3 axis = it.tip - it.base;
  side = cross(axis, front);
  float length2 = dot(side, side);
  side = length2 > 1e-20 ? side * inversesqrt(length2) : normalize(cross(front, vec3(0.31, 0.2, 0.93)));
  vec3 along = cross(front, side);
  vec4 clip = projectionMatrix * (viewMatrix * vec4(centre, 1.0));
  float wide = max(r, 0.55 * pixel * (eye.w > 0.0 ? clip.w : 1.0));
  float span = dot(axis, along);
  bool ends = r > 0.8 * pixel * clip.w;
  // The tip is round and covers the joint; the base is flat, an ellipse as wide as it is seen from behind.
  float seen = span * inversesqrt(max(dot(axis, axis), 1e-20));
  float tipReach = ends ? wide : 0.0, baseReach = ends ? wide * sqrt(max(0.0, 1.0 - seen * seen)) : 0.0;
  float baseUnit = max(baseReach, 0.001 * wide);
  // Distances beyond the base and beyond the tip, as parts of the reach of each.
  across = vec3(sign, atTip ? -(span + tipReach) / baseUnit : baseReach / baseUnit, atTip ? tipReach / wide : -(span + baseReach) / wide);
  vec3 corner = centre + side * (sign * wide) + along * (atTip ? tipReach : -baseReach);
  gl_Position = projectionMatrix * (viewMatrix * vec4(corner, 1.0));
  // A thick internode lies before the thin ones that begin inside it.
  vec4 surface = projectionMatrix * (viewMatrix * vec4(corner + front * r, 1.0));
  gl_Position.z = surface.z / surface.w * gl_Position.w;

  identity = it.module;
  if (pass != 0) return;
  colour = ownColour(it);
  light = lit(centre + sun * r);
}
`;

const thickFragment = /* glsl */ `
in vec3 across;
flat in vec3 side, front, colour;
in float light;

void main() {
  float beyond = max(max(across.y, across.z), 0.0);
  float rest = 1.0 - across.x * across.x - beyond * beyond;
  if (rest < 0.0) discard;
  if (pass != 0) {
    result = identityColour();
    return;
  }
  // Round ends are hardly tilted, so that joints do not show as rings.
  float end = across.y > across.z ? -beyond : beyond;
  vec3 normal = normalize(side * across.x + cross(front, side) * (0.25 * end) + front * sqrt(1.0 - across.x * across.x));
  result = shade(colour, normal, light);
}
`;

const thinVertex = /* glsl */ `
flat out vec4 shaded;
uniform vec3 sunColour, skyColour, soilColour;

void main() {
  Internode it = internodeOf(gl_VertexID >> 1);
  vec3 centre = (gl_VertexID & 1) != 0 ? it.tip : it.base;
  gl_Position = projectionMatrix * (viewMatrix * vec4(centre, 1.0));
  identity = it.module;
  if (pass != 0 || (gl_VertexID & 1) == 0) return;
  // The mean over the side that faces the eye: its normals are those of a half cylinder.
  vec3 front = normalize(eye.xyz - centre);
  float direct = clamp(0.32 + 0.55 * dot(front, sun), 0.0, 1.0) * litOnce(centre);
  vec3 ambient = mix(soilColour, skyColour, 0.5 + 0.35 * front.y);
  shaded = vec4(sqrt(ownColour(it) * (ambient * 0.7 + sunColour * (0.75 * direct + 0.06))), 1.0);
}
`;

const thinFragment = /* glsl */ `
flat in vec4 shaded;
void main() {
  result = pass != 0 ? identityColour() : shaded;
}
`;

function recordTexture(records: Uint32Array, rows: number): DataTexture {
  const padded = new Uint32Array(perRow * rows * 6);
  padded.set(records);
  const texture = new DataTexture(padded, perRow * 3, rows, RGIntegerFormat, UnsignedIntType);
  texture.internalFormat = "RG32UI";
  texture.needsUpdate = true;
  return texture;
}

/** Two triangles for each four vertices. */
function corners(count: number): Uint32Array {
  const indices = new Uint32Array(count * 6);
  for (let i = 0, at = 0, first = 0; i < count; i++, first += 4) {
    indices[at++] = first;
    indices[at++] = first + 1;
    indices[at++] = first + 2;
    indices[at++] = first + 2;
    indices[at++] = first + 1;
    indices[at++] = first + 3;
  }
  return indices;
}

const buckets = 1024;

/** Puts records in order of thickness, the thickest first. */
class Order {
  /** For each bucket of thickness, how many internodes are thicker than it. */
  readonly thicker = new Uint32Array(buckets + 1);

  /** Copies the records into `target`. */
  sort(records: Uint32Array, count: number, target: Uint32Array): void {
    const { thicker } = this;
    thicker.fill(0);
    const bucketOf = (i: number) => {
      const radii = at(records, i * 6 + 3);
      return buckets - 1 - (Math.max(radii & 65535, radii >>> 16) >> 6);
    };
    for (let i = 0; i < count; i++) increase(thicker, bucketOf(i) + 1, 1);
    for (let bucket = 0; bucket < buckets; bucket++) increase(thicker, bucket + 1, at(thicker, bucket));
    const next = thicker.slice();
    for (let i = 0; i < count; i++) {
      const place = increase(next, bucketOf(i), 1) * 6;
      for (let k = 0; k < 6; k++) target[place + k] = at(records, i * 6 + k);
    }
  }

  /** How many internodes may be thicker than a part of the thickest. */
  above(part: number): number {
    if (part >= 1) return 0;
    return at(this.thicker, buckets - (Math.floor(Math.max(0, part) * 65535) >> 6));
  }
}

function unbounded(object: Mesh | LineSegments): void {
  object.frustumCulled = false;
  object.visible = false;
}

function uniformsOf(shared: SharedUniforms) {
  return {
    ...shared,
    records: { value: recordTexture(new Uint32Array(0), 1) },
    lower: { value: new Vector3() },
    size: { value: new Vector3(1, 1, 1) },
    thickest: { value: 0 },
  };
}

export class Internodes {
  readonly thick: Mesh;
  readonly thin: LineSegments;
  private readonly uniforms: ReturnType<typeof uniformsOf>;
  private readonly order = new Order();
  private packet: Packet | null = null;
  private capacity = 0;
  private rows = 0;

  constructor(shared: SharedUniforms) {
    this.uniforms = uniformsOf(shared);
    const { uniforms } = this;
    this.thick = new Mesh(
      new BufferGeometry(),
      plantMaterial({ uniforms, vertex: records + thickVertex, fragment: thickFragment }),
    );
    this.thin = new LineSegments(
      new BufferGeometry(),
      plantMaterial({ uniforms, vertex: records + thinVertex, fragment: thinFragment }),
    );
    unbounded(this.thick);
    unbounded(this.thin);
  }

  show(packet: Packet): void {
    this.packet = packet;
    this.reserve(packet.internodeCount);
    const texture = this.uniforms.records.value;
    this.order.sort(packet.internodes, packet.internodeCount, texture.image.data as unknown as Uint32Array);
    texture.needsUpdate = true;
    this.uniforms.lower.value.set(...packet.lower);
    this.uniforms.size.value.set(...vectorOf((k) => packet.upper[k] - packet.lower[k]));
    this.uniforms.thickest.value = packet.radius;
  }

  /** Decides what is drawn as lines: what is narrower than about 1.5 pixels. `eye` is null for parallel rays. */
  choose(eye: Vector3 | null, pixel: number): void {
    const { packet } = this;
    const count = packet?.internodeCount ?? 0;
    if (!packet || count === 0) {
      this.thick.visible = this.thin.visible = false;
      return;
    }
    const box = new Box3(new Vector3(...packet.lower), new Vector3(...packet.upper));
    const centre = box.getCenter(new Vector3());
    // Between the nearest point and the middle: inside the box nothing is a line.
    const near = eye ? box.distanceToPoint(eye) : 1;
    const away = eye && near > 0 ? (near + eye.distanceTo(centre)) / 2 : near;
    const thick = this.order.above((0.75 * pixel * away) / Math.max(packet.radius, 1e-30));
    this.thick.visible = thick > 0;
    this.thin.visible = thick < count;
    this.thick.geometry.setDrawRange(0, thick * 6);
    this.thin.geometry.setDrawRange(thick * 2, (count - thick) * 2);
  }

  private reserve(count: number): void {
    const rows = Math.max(1, Math.ceil(count / perRow));
    if (rows > this.rows || rows * 4 < this.rows) {
      this.uniforms.records.value.dispose();
      this.rows = rows > 1 ? Math.ceil(rows * 1.3) : 1;
      this.uniforms.records.value = recordTexture(new Uint32Array(0), this.rows);
    }
    if (count <= this.capacity) return;
    this.capacity = Math.ceil(count * 1.3);
    this.thick.geometry.dispose();
    this.thick.geometry.setIndex(new BufferAttribute(corners(this.capacity), 1));
  }
}
