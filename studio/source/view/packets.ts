/** Reads the binary messages of the protocol (docs/developer/studio-protocol.md). Arrays are views of the message: nothing is copied. */
import { at } from "../lists.js";
import { axes, vectorOf, type Axis, type Box, type Vector } from "./vectors.js";

export interface ShapeGroup {
  shape: number;
  count: number;
  matrices: Float32Array;
  colours: Uint8Array;
  modules: Uint32Array;
}

/** Indices that wear one picture; 0 is none. */
export interface TextureRange {
  texture: number;
  first: number;
  count: number;
}

export interface TriangleMesh {
  positions: Float32Array;
  normals: Int8Array;
  colours: Uint8Array;
  modules: Uint32Array;
  indices: Uint32Array;
  /** All indices, one range behind the other. */
  ranges: TextureRange[];
  /** Where the vertices lie on the pictures; null if nothing wears one. */
  onPicture: Float32Array | null;
}

/** A text that the model wrote at a place. */
export interface Label {
  position: Vector;
  colour: Vector;
  module: number;
  text: string;
}

export interface Packet extends TriangleMesh {
  kind: "packet";
  growth: number;
  step: number;
  bytes: number;
  /** The message that the arrays are views of. */
  message: ArrayBuffer;
  /** The first module of each plant. */
  plants: Uint32Array;
  lower: Vector;
  upper: Vector;
  radius: number;
  internodeCount: number;
  /** Six numbers an internode, as the graphics card reads them. */
  internodes: Uint32Array;
  groups: ShapeGroup[];
  /** Whether limbs wear pictures, such as bark. */
  texturedLimbs: boolean;
  labels: Label[];
}

/** Limbs as tubes or with a smooth skin, which the server makes when it is asked. */
export interface Limbs extends TriangleMesh {
  kind: "limbs";
  growth: number;
  step: number;
  smooth: boolean;
  message: ArrayBuffer;
}

export interface Shape {
  shape: number;
  /** 0 is none; others count the images of the growth from 1. */
  image: number;
  positions: Float32Array;
  normals: Float32Array;
  texture: Float32Array;
  indices: Uint32Array;
}

export interface Shapes {
  kind: "shapes";
  growth: number;
  message: ArrayBuffer;
  shapes: Shape[];
}

export interface Column {
  kind: "column";
  growth: number;
  step: number;
  name: string;
  lowest: number;
  highest: number;
  values: Float32Array;
}

export interface Field {
  kind: "field";
  growth: number;
  step: number;
  name: string;
  size: Vector;
  lower: Vector;
  upper: Vector;
  lowest: number;
  highest: number;
  values: Uint8Array;
}

export type BinaryMessage = Packet | Shapes | Column | Field | Limbs;

class Reader {
  private readonly view: DataView;
  constructor(
    private readonly buffer: ArrayBuffer,
    private at: number,
  ) {
    this.view = new DataView(buffer);
  }
  u32(): number {
    this.at += 4;
    return this.view.getUint32(this.at - 4, true);
  }
  i32(): number {
    return this.u32() | 0;
  }
  f32(): number {
    this.at += 4;
    return this.view.getFloat32(this.at - 4, true);
  }
  vector(): Vector {
    return [this.f32(), this.f32(), this.f32()];
  }
  floats(count: number): Float32Array {
    return new Float32Array(this.buffer, this.skip(count * 4), count);
  }
  numbers(count: number): Uint32Array {
    return new Uint32Array(this.buffer, this.skip(count * 4), count);
  }
  bytes(count: number): Uint8Array {
    return new Uint8Array(this.buffer, this.skip(count), count);
  }
  signed(count: number): Int8Array {
    return new Int8Array(this.buffer, this.skip(count), count);
  }
  name(): string {
    const length = this.u32();
    const text = new TextDecoder().decode(this.bytes(length));
    this.skip((4 - (length % 4)) % 4);
    return text;
  }
  private skip(count: number): number {
    const start = this.at;
    this.at += count;
    if (this.at > this.buffer.byteLength) throw new Error("A binary message is shorter than its head says.");
    return start;
  }
}

export function readMessage(buffer: ArrayBuffer): BinaryMessage {
  const letters = String.fromCharCode(...new Uint8Array(buffer, 0, 4));
  const reader = new Reader(buffer, 4);
  if (letters === "ESP1") return readPacket(reader, buffer);
  if (letters === "ESS1") return readShapes(reader, buffer);
  if (letters === "ESC1") return readColumn(reader);
  if (letters === "ESF1") return readField(reader);
  if (letters === "ESM1") return readLimbs(reader, buffer);
  throw new Error(`A binary message begins with ${letters}, which this page does not know.`);
}

function readPacket(reader: Reader, message: ArrayBuffer): Packet {
  const growth = reader.u32();
  const step = reader.i32();
  const plantCount = reader.u32();
  const internodeCount = reader.u32();
  const vertices = reader.u32();
  const indexCount = reader.u32();
  const groupCount = reader.u32();
  const lower = reader.vector();
  const upper = reader.vector();
  const radius = reader.f32();
  const plants = reader.numbers(plantCount);
  const internodes = reader.numbers(internodeCount * 6);
  const positions = reader.floats(vertices * 3);
  const normals = reader.signed(vertices * 4);
  const colours = reader.bytes(vertices * 4);
  const modules = reader.numbers(vertices);
  const indices = reader.numbers(indexCount);
  const groups: ShapeGroup[] = [];
  for (let i = 0; i < groupCount; i++) groups.push(readGroup(reader));
  const rangeCount = reader.u32();
  const labelCount = reader.u32();
  const texturedLimbs = reader.u32() > 0;
  const textured = readRanges(reader, rangeCount);
  const onPicture = rangeCount > 0 ? reader.floats(vertices * 2) : null;
  if (texturedLimbs) reader.bytes(Math.ceil(internodeCount / 2) * 4);
  const labels: Label[] = [];
  for (let i = 0; i < labelCount; i++) labels.push(readLabel(reader));
  const plain = textured[0]?.first ?? indexCount;
  return {
    kind: "packet",
    growth,
    step,
    bytes: message.byteLength,
    message,
    plants,
    lower,
    upper,
    radius,
    internodeCount,
    internodes,
    positions,
    normals,
    colours,
    modules,
    indices,
    ranges: [{ texture: 0, first: 0, count: plain }, ...textured],
    onPicture,
    groups,
    texturedLimbs,
    labels,
  };
}

function readRanges(reader: Reader, count: number): TextureRange[] {
  return Array.from({ length: count }, () => ({ texture: reader.u32(), first: reader.u32(), count: reader.u32() }));
}

function readLabel(reader: Reader): Label {
  const position = reader.vector();
  const colour = reader.bytes(4);
  return { position, colour: vectorOf((k) => at(colour, k)), module: reader.u32(), text: reader.name() };
}

function readLimbs(reader: Reader, message: ArrayBuffer): Limbs {
  const growth = reader.u32();
  const step = reader.i32();
  const smooth = reader.u32() > 0;
  const vertices = reader.u32();
  const indexCount = reader.u32();
  const rangeCount = reader.u32();
  const ranges = readRanges(reader, rangeCount);
  return {
    kind: "limbs",
    growth,
    step,
    smooth,
    message,
    ranges,
    positions: reader.floats(vertices * 3),
    normals: reader.signed(vertices * 4),
    colours: reader.bytes(vertices * 4),
    modules: reader.numbers(vertices),
    onPicture: reader.floats(vertices * 2),
    indices: reader.numbers(indexCount),
  };
}

function readGroup(reader: Reader): ShapeGroup {
  const shape = reader.u32();
  const count = reader.u32();
  return {
    shape,
    count,
    matrices: reader.floats(count * 12),
    colours: reader.bytes(count * 4),
    modules: reader.numbers(count),
  };
}

function readShapes(reader: Reader, message: ArrayBuffer): Shapes {
  const growth = reader.u32();
  const count = reader.u32();
  const shapes: Shape[] = [];
  for (let i = 0; i < count; i++) {
    const shape = reader.u32();
    const image = reader.u32();
    const vertices = reader.u32();
    const indices = reader.u32();
    shapes.push({
      shape,
      image,
      positions: reader.floats(vertices * 3),
      normals: reader.floats(vertices * 3),
      texture: reader.floats(vertices * 2),
      indices: reader.numbers(indices),
    });
  }
  return { kind: "shapes", growth, message, shapes };
}

function readColumn(reader: Reader): Column {
  const growth = reader.u32();
  const step = reader.i32();
  const modules = reader.u32();
  const lowest = reader.f32();
  const highest = reader.f32();
  const name = reader.name();
  return { kind: "column", growth, step, name, lowest, highest, values: reader.floats(modules) };
}

function readField(reader: Reader): Field {
  const growth = reader.u32();
  const step = reader.i32();
  const size: Vector = [reader.u32(), reader.u32(), reader.u32()];
  const lower = reader.vector();
  const upper = reader.vector();
  const lowest = reader.f32();
  const highest = reader.f32();
  const name = reader.name();
  const values = reader.bytes(size[0] * size[1] * size[2]);
  return { kind: "field", growth, step, name, size, lower, upper, lowest, highest, values };
}

export function triangleCount(packet: Packet): number {
  return packet.indices.length / 3;
}

/** The modules that are drawn, each once, in the order of the string: along each branch. */
export function drawnModules(packet: Packet): Uint32Array {
  const lists = [packet.modules, ...packet.groups.map(({ modules }) => modules)];
  const all = new Uint32Array(lists.reduce((sum, { length }) => sum + length, packet.internodeCount));
  for (let i = 0; i < packet.internodeCount; i++) all[i] = at(packet.internodes, i * 6 + 5);
  let end = packet.internodeCount;
  for (const list of lists) {
    all.set(list, end);
    end += list.length;
  }
  return all.sort().filter((module, i) => i === 0 || module !== all[i - 1]);
}

/** The box of everything in a packet, or null if it is empty. `boxOf` knows the boxes of shapes. */
export function boundsOf(packet: Packet, boxOf: (shape: number) => Box): Box | null {
  const lower: [number, number, number] = [Infinity, Infinity, Infinity];
  const upper: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  const add = (k: Axis, value: number, reach: number) => {
    lower[k] = Math.min(lower[k], value - reach);
    upper[k] = Math.max(upper[k], value + reach);
  };
  if (packet.internodeCount > 0)
    for (const k of axes) {
      add(k, packet.lower[k], packet.radius);
      add(k, packet.upper[k], packet.radius);
    }
  const { positions } = packet;
  for (let i = 0; i < positions.length; i += 3) for (const k of axes) add(k, at(positions, i + k), 0);
  for (const { shape, matrices } of packet.groups) {
    const box = boxOf(shape);
    const middle = vectorOf((k) => (box.upper[k] + box.lower[k]) / 2);
    const half = vectorOf((k) => (box.upper[k] - box.lower[k]) / 2);
    for (let i = 0; i < matrices.length; i += 12)
      for (const k of axes) {
        const row = i + 4 * k;
        const along = (j: Axis) => at(matrices, row + j);
        const centre = at(matrices, row + 3) + axes.reduce<number>((sum, j) => sum + along(j) * middle[j], 0);
        add(k, centre, axes.reduce<number>((sum, j) => sum + Math.abs(along(j)) * half[j], 0));
      }
  }
  return Number.isFinite(lower[0]) ? { lower, upper } : null;
}
