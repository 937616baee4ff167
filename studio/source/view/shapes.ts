/** Shapes that occur many times, such as leaves: each group is one call that reads the shape and its places from textures. */
import {
  BufferGeometry,
  DataTexture,
  FloatType,
  Mesh,
  RGBAFormat,
  RGIntegerFormat,
  UnsignedIntType,
  type IUniform,
  type Object3D,
  type Texture,
} from "three";
import { at } from "../lists.js";
import type { Packet, Shape, ShapeGroup } from "./packets.js";
import type { Pictures } from "./pictures.js";
import { plantMaterial, surfaceFragment, type SharedUniforms } from "./shading.js";
import { vectorOf, type Box } from "./vectors.js";

const perRow = 512;

const vertex = /* glsl */ `
uniform highp sampler2D corners;
uniform highp sampler2D rows;
uniform usampler2D facts;
uniform int cornersEach;
out vec3 turned, towards;
out vec4 mixed;
out float light;
out vec2 onImage;

void main() {
  int number = gl_VertexID / cornersEach;
  int corner = gl_VertexID - number * cornersEach;
  ivec2 at = ivec2((corner % ${perRow}) * 2, corner / ${perRow});
  vec4 point = texelFetch(corners, at, 0);
  vec4 normal = texelFetch(corners, at + ivec2(1, 0), 0);
  onImage = vec2(point.w, normal.w);
  point.w = 1.0;
  ivec2 row = ivec2((number % ${perRow}) * 3, number / ${perRow});
  vec4 x = texelFetch(rows, row, 0), y = texelFetch(rows, row + ivec2(1, 0), 0), z = texelFetch(rows, row + ivec2(2, 0), 0);
  vec3 position = vec3(dot(x, point), dot(y, point), dot(z, point));
  gl_Position = projectionMatrix * (viewMatrix * vec4(position, 1.0));
  uvec2 fact = texelFetch(facts, ivec2(number % ${perRow}, number / ${perRow}), 0).xy;
  identity = fact.y;
  mixed.a = float(fact.x >> 24) / 255.0;
  if (pass != 0) return;
  // Normals turn with the cofactors of the matrix.
  turned = normal.x * cross(vec3(x.y, y.y, z.y), vec3(x.z, y.z, z.z))
         + normal.y * cross(vec3(x.z, y.z, z.z), vec3(x.x, y.x, z.x))
         + normal.z * cross(vec3(x.x, y.x, z.x), vec3(x.y, y.y, z.y));
  turned *= inversesqrt(max(dot(turned, turned), 1e-30));
  towards = eye.xyz - position * eye.w;
  mixed.rgb = colourOf(fact.y, vec3(fact.x & 255u, (fact.x >> 8) & 255u, (fact.x >> 16) & 255u) / 255.0, 0.0);
  light = lit(position);
}
`;

const fragment = surfaceFragment("in vec2 onImage; uniform sampler2D image;", "texture(image, onImage)");

function floatTexture(values: Float32Array, texels: number, width: number): DataTexture {
  const rows = Math.max(1, Math.ceil(texels / width));
  const padded = new Float32Array(rows * width * 4);
  padded.set(values);
  const texture = new DataTexture(padded, width, rows, RGBAFormat, FloatType);
  texture.needsUpdate = true;
  return texture;
}

interface Corners {
  box: Box;
  vertices: number;
  count: number;
  image: number;
  texture: DataTexture;
}

function boxOf({ positions }: Shape): Box {
  const bound = (first: number, pick: (...values: number[]) => number, start: number) => {
    let found = start;
    for (let i = first; i < positions.length; i += 3) found = pick(found, at(positions, i));
    return found;
  };
  return { lower: vectorOf((k) => bound(k, Math.min, Infinity)), upper: vectorOf((k) => bound(k, Math.max, -Infinity)) };
}

/** The corners of the triangles of a shape, one after the other. */
function cornersOf(shape: Shape): Corners {
  const count = shape.indices.length;
  const values = new Float32Array(count * 8);
  for (let i = 0; i < count; i++) {
    const vertex = at(shape.indices, i);
    values.set(shape.positions.subarray(vertex * 3, vertex * 3 + 3), i * 8);
    values.set(shape.normals.subarray(vertex * 3, vertex * 3 + 3), i * 8 + 4);
    values[i * 8 + 3] = shape.texture[vertex * 2] ?? 0;
    values[i * 8 + 7] = shape.texture[vertex * 2 + 1] ?? 0;
  }
  return { box: boxOf(shape), vertices: shape.positions.length / 3, count, image: shape.image, texture: floatTexture(values, count * 2, perRow * 2) };
}

function disc(inner: number): Shape {
  const sides = 20;
  const positions: number[] = [];
  const normals: number[] = [];
  const indices: number[] = [];
  for (let i = 0; i < sides; i++) {
    const angle = (2 * Math.PI * i) / sides;
    for (const radius of [inner, 0.5]) {
      positions.push(radius * Math.cos(angle), radius * Math.sin(angle), 0);
      normals.push(0, 0, 1);
    }
    const [a, b] = [2 * i, 2 * ((i + 1) % sides)];
    indices.push(a, a + 1, b + 1);
    if (inner > 0) indices.push(a, b + 1, b);
  }
  return shapeOf(inner > 0 ? 2 : 0, positions, normals, indices);
}

function shapeOf(shape: number, positions: number[], normals: number[], indices: number[]): Shape {
  return {
    shape,
    image: 0,
    positions: new Float32Array(positions),
    normals: new Float32Array(normals),
    texture: new Float32Array(0),
    indices: new Uint32Array(indices),
  };
}

/** A sphere of diameter 1 with rings of latitude. */
function sphere(): Shape {
  const [rings, sides] = [6, 10];
  const normals: number[] = [];
  const indices: number[] = [];
  for (let i = 0; i <= rings; i++) {
    const polar = (Math.PI * i) / rings;
    for (let j = 0; j <= sides; j++) {
      const angle = (2 * Math.PI * j) / sides;
      normals.push(Math.sin(polar) * Math.cos(angle), Math.cos(polar), Math.sin(polar) * Math.sin(angle));
      const at = i * (sides + 1) + j;
      if (i > 0 && i < rings && j < sides) indices.push(at, at + 1, at + sides + 1);
      if (i < rings && j < sides) indices.push(at + 1, at + sides + 2, at + sides + 1);
    }
  }
  // The first ring is a point: its triangles are those of the second half of each square.
  return shapeOf(
    1,
    normals.map((value) => value / 2),
    normals,
    indices,
  );
}

class GroupMesh {
  readonly mesh: Mesh;
  private readonly rows: DataTexture;
  private readonly facts: DataTexture;

  constructor(shared: SharedUniforms, group: ShapeGroup, corners: Corners, image: IUniform<Texture>) {
    const facts = new Uint32Array(Math.ceil(group.count / perRow) * perRow * 2);
    const tints = new DataView(group.colours.buffer, group.colours.byteOffset, group.colours.byteLength);
    for (let i = 0; i < group.count; i++) {
      facts[i * 2] = tints.getUint32(i * 4, true);
      facts[i * 2 + 1] = at(group.modules, i);
    }
    this.facts = new DataTexture(facts, perRow, facts.length / 2 / perRow, RGIntegerFormat, UnsignedIntType);
    this.facts.internalFormat = "RG32UI";
    this.facts.needsUpdate = true;
    this.rows = floatTexture(group.matrices, group.count * 3, perRow * 3);
    const uniforms = {
      ...shared,
      corners: { value: corners.texture },
      image,
      rows: { value: this.rows },
      facts: { value: this.facts },
      cornersEach: { value: corners.count },
    };
    const geometry = new BufferGeometry();
    geometry.setDrawRange(0, group.count * corners.count);
    this.mesh = new Mesh(geometry, plantMaterial({ uniforms, vertex, fragment }));
    this.mesh.frustumCulled = false;
  }

  dispose(): void {
    this.rows.dispose();
    this.facts.dispose();
    (this.mesh.material as { dispose(): void }).dispose();
    this.mesh.geometry.dispose();
  }
}

export class Shapes {
  private readonly known = new Map<number, Corners>();
  private groups: GroupMesh[] = [];

  constructor(
    private readonly shared: SharedUniforms,
    private readonly pictures: Pictures,
    private readonly scene: Object3D,
  ) {
    for (const shape of [disc(0), sphere(), disc(0.47)]) this.known.set(shape.shape, cornersOf(shape));
  }

  /** The box of a shape; of an unknown one that of a shape of diameter 1. */
  boxOf(shape: number): Box {
    return this.known.get(shape)?.box ?? { lower: [-0.5, -0.5, -0.5], upper: [0.5, 0.5, 0.5] };
  }

  /** Vertices and triangles of all organs. */
  sizeOf(packet: Packet): { vertices: number; triangles: number } {
    let vertices = 0;
    let triangles = 0;
    for (const { shape, count } of packet.groups) {
      vertices += count * (this.known.get(shape)?.vertices ?? 0);
      triangles += (count * (this.known.get(shape)?.count ?? 0)) / 3;
    }
    return { vertices, triangles };
  }

  /** Shapes from 3 on belong to a growth. */
  learn(shapes: Shape[]): void {
    for (const shape of shapes) {
      this.known.get(shape.shape)?.texture.dispose();
      this.known.set(shape.shape, cornersOf(shape));
    }
  }

  clear(): void {
    for (const group of this.groups) {
      this.scene.remove(group.mesh);
      group.dispose();
    }
    this.groups = [];
  }

  show(packet: Packet): void {
    this.clear();
    for (const group of packet.groups) {
      const corners = this.known.get(group.shape);
      if (!corners || group.count === 0 || corners.count === 0) continue;
      const drawn = new GroupMesh(this.shared, group, corners, this.pictures.colours(corners.image));
      this.groups.push(drawn);
      this.scene.add(drawn.mesh);
    }
  }
}
