/**
 * Internodes as impostors: one call draws four vertices an internode, which face the eye; the vertex shader reads the records of
 * the packet from a texture, and the fragment shader shades them as tapered cylinders with round ends.
 */
import { BufferAttribute, BufferGeometry, DataTexture, Mesh, RGIntegerFormat, UnsignedIntType, Vector3 } from "three";
import type { Packet } from "./packets.js";
import { plantMaterial, type Uniforms } from "./shading.js";

const perRow = 680; // internodes; three texels each, below the 2048 that every card has

const vertex = /* glsl */ `
uniform usampler2D records;
uniform vec3 lower, size;
uniform float thickest;
out vec3 across;
flat out vec3 side, front, colour;
out float light;

void main() {
  int number = gl_VertexID >> 2;
  ivec2 at = ivec2((number % ${perRow}) * 3, number / ${perRow});
  uvec2 a = texelFetch(records, at, 0).xy;
  uvec2 b = texelFetch(records, at + ivec2(1, 0), 0).xy;
  uvec2 c = texelFetch(records, at + ivec2(2, 0), 0).xy;
  vec3 base = lower + size * vec3(a.x & 65535u, a.x >> 16, a.y & 65535u) / 65535.0;
  vec3 tip = lower + size * vec3(a.y >> 16, b.x & 65535u, b.x >> 16) / 65535.0;
  bool atTip = (gl_VertexID & 2) != 0;
  float sign = (gl_VertexID & 1) != 0 ? 1.0 : -1.0;
  vec3 centre = atTip ? tip : base;
  float r = thickest * float(atTip ? b.y >> 16 : b.y & 65535u) / 65535.0;

  front = eye.w > 0.0 ? normalize(eye.xyz - base) : eye.xyz;
  vec3 axis = tip - base;
  side = cross(axis, front);
  float length2 = dot(side, side);
  side = length2 > 1e-20 ? side * inversesqrt(length2) : normalize(cross(front, vec3(0.31, 0.2, 0.93)));
  vec3 along = cross(front, side);
  vec4 clip = projectionMatrix * (viewMatrix * vec4(centre, 1.0));
  float wide = max(r, 0.55 * pixel * (eye.w > 0.0 ? clip.w : 1.0));
  float span = dot(axis, along);
  bool ends = r > 0.8 * pixel * clip.w;
  float reach = ends ? wide : 0.0;
  // Distances beyond the base and beyond the tip, in radii of this end.
  across = vec3(sign, atTip ? -(span + reach) / wide : reach / wide, atTip ? reach / wide : -(span + reach) / wide);
  vec3 corner = centre + side * (sign * wide) + along * (atTip ? reach : -reach);
  gl_Position = projectionMatrix * (viewMatrix * vec4(corner, 1.0));
  // A thick internode lies before the thin ones that begin inside it.
  vec4 surface = projectionMatrix * (viewMatrix * vec4(corner + front * r, 1.0));
  gl_Position.z = surface.z / surface.w * gl_Position.w;

  identity = c.y;
  if (pass != 0) return;
  colour = colourOf(c.y, vec3(c.x & 255u, (c.x >> 8) & 255u, (c.x >> 16) & 255u) / 255.0, float(c.x >> 24));
  light = lit(centre + sun * r);
}
`;

const fragment = /* glsl */ `
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
  float end = across.y > across.z ? -beyond : beyond;
  vec3 normal = side * across.x + cross(front, side) * end + front * sqrt(rest);
  result = shade(colour, normal, light);
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

export class Internodes {
  readonly mesh: Mesh;
  private readonly geometry = new BufferGeometry();
  private readonly uniforms: Uniforms;
  private capacity = 0;
  private rows = 0;

  constructor(shared: Uniforms) {
    this.uniforms = {
      ...shared,
      records: { value: recordTexture(new Uint32Array(0), 1) },
      lower: { value: new Vector3() },
      size: { value: new Vector3(1, 1, 1) },
      thickest: { value: 0 },
    };
    this.mesh = new Mesh(this.geometry, plantMaterial({ uniforms: this.uniforms, vertex, fragment }));
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
  }

  show(packet: Packet): void {
    this.reserve(packet.internodeCount);
    this.geometry.setDrawRange(0, packet.internodeCount * 6);
    this.mesh.visible = packet.internodeCount > 0;
    const texture = this.uniforms.records.value as DataTexture;
    (texture.image.data as unknown as Uint32Array).set(packet.internodes);
    texture.needsUpdate = true;
    (this.uniforms.lower.value as Vector3).set(...packet.lower);
    (this.uniforms.size.value as Vector3).set(
      packet.upper[0] - packet.lower[0], packet.upper[1] - packet.lower[1], packet.upper[2] - packet.lower[2],
    );
    this.uniforms.thickest.value = packet.radius;
  }

  private reserve(count: number): void {
    const rows = Math.max(1, Math.ceil(count / perRow));
    if (rows > this.rows || rows * 4 < this.rows) {
      (this.uniforms.records.value as DataTexture).dispose();
      this.rows = rows > 1 ? Math.ceil(rows * 1.3) : 1;
      this.uniforms.records.value = recordTexture(new Uint32Array(0), this.rows);
    }
    if (count <= this.capacity) return;
    this.capacity = Math.ceil(count * 1.3);
    this.geometry.dispose();
    this.geometry.setIndex(new BufferAttribute(corners(this.capacity), 1));
  }
}
