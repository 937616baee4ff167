/** The plant of another growth, beside the one that is shown or on it. It casts a shadow, and clicks do not meet it. */
import { Group, type Scene, type Vector3 } from "three";
import { at } from "../lists.js";
import { Internodes } from "./internodes.js";
import { boundsOf, type Column, type Packet, type Shape } from "./packets.js";
import type { Pictures } from "./pictures.js";
import { valueTable, type SharedUniforms } from "./shading.js";
import { Shapes } from "./shapes.js";
import { Triangles } from "./triangles.js";
import { axes, vectorOf, type Box, type Vector } from "./vectors.js";

export class BesideView {
  box: Box | null = null;
  private readonly group = new Group();
  private readonly uniforms: SharedUniforms;
  private readonly internodes: Internodes;
  private readonly triangles: Triangles;
  private shapes: Shapes;
  private shown = false;

  constructor(
    shared: SharedUniforms,
    private readonly pictures: Pictures,
    scene: Scene,
  ) {
    this.uniforms = {
      ...shared,
      colouring: { value: 0 },
      marked: { value: false },
      values: { value: valueTable(new Float32Array(1)) },
    };
    this.internodes = new Internodes(this.uniforms);
    this.triangles = new Triangles(this.uniforms, pictures, false);
    this.shapes = new Shapes(this.uniforms, pictures, this.group);
    this.group.add(this.internodes.thick, this.internodes.thin, this.triangles.mesh);
    scene.add(this.group);
  }

  /** The shapes of another growth. */
  begin(shapes: Shape[]): void {
    this.hide();
    this.shapes = new Shapes(this.uniforms, this.pictures, this.group);
    this.shapes.learn(shapes);
  }

  boxOf(packet: Packet): Box | null {
    return boundsOf(packet, (shape) => this.shapes.boxOf(shape));
  }

  /** Stands away from where it grew. */
  show(packet: Packet, by: Vector): void {
    const moved = movedBy(packet, by);
    this.shown = true;
    this.box = this.boxOf(moved);
    this.internodes.show(moved);
    this.triangles.show(moved);
    this.shapes.show(moved);
  }

  hide(): void {
    this.shown = false;
    this.box = null;
    this.triangles.clear();
    this.shapes.clear();
  }

  /** As the model has coloured it, by the order of branching, by values of its own, or grey. */
  colourBy(by: Column | "order" | "grey" | null): void {
    this.uniforms.colouring.value = by === null ? 0 : by === "order" ? 2 : by === "grey" ? 3 : 1;
    if (by === null || typeof by === "string") return;
    this.uniforms.values.value.dispose();
    this.uniforms.values.value = valueTable(by.values);
  }

  /** Before a pass: whether it is in it, and from where it is seen (see Internodes). */
  prepare(taken: boolean, eye: Vector3 | null, pixel: number): void {
    this.group.visible = taken && this.shown;
    if (this.group.visible) this.internodes.choose(eye, pixel);
  }
}

function movedBy(packet: Packet, by: Vector): Packet {
  const positions = packet.positions.map((value, i) => value + at(by, i % 3));
  const groups = packet.groups.map((group) => ({
    ...group,
    matrices: group.matrices.map((value, i) => (i % 4 === 3 ? value + at(by, (i % 12) >> 2) : value)),
  }));
  const moved = (corner: Vector) => vectorOf((k) => corner[k] + by[k]);
  return { ...packet, positions, groups, lower: moved(packet.lower), upper: moved(packet.upper) };
}

/** How a second box comes to stand left of a first, for an eye that looks along an azimuth, with a gap of a part of its width. */
export function leftOf(first: Box, second: Box, azimuth: number): Vector {
  const alongX = Math.abs(Math.cos(azimuth)) >= Math.abs(Math.sin(azimuth));
  const axis = alongX ? 0 : 2;
  const side = (alongX ? Math.cos(azimuth) : -Math.sin(azimuth)) > 0 ? 1 : -1;
  const gap = 0.15 * Math.max(...axes.map((k) => (k === 1 ? 0 : second.upper[k] - second.lower[k])), 1e-3);
  const away = side > 0 ? first.lower[axis] - second.upper[axis] - gap : first.upper[axis] - second.lower[axis] + gap;
  return vectorOf((k) => (k === axis ? away : 0));
}
