/** What was measured of a plant, beside it: points of a scanner, and axes as lines. */
import { BufferAttribute, BufferGeometry, GLSL3, LineSegments, Points, RawShaderMaterial, type Scene } from "three";
import type { Box } from "./vectors.js";

export interface MeasuredShape {
  /** x, y, z one after the other, m, y upwards. */
  points: readonly number[];
  /** Axes, each the same. */
  lines: readonly (readonly number[])[];
  /** Only ratios of lengths count: it is drawn as tall as the plant. */
  relative: boolean;
}

const vertex = /* glsl */ `
precision highp float;
uniform mat4 viewMatrix, projectionMatrix;
uniform float size, points;
in vec3 position;
void main() {
  gl_Position = projectionMatrix * (viewMatrix * vec4(position * size, 1.0));
  gl_PointSize = points;
}
`;

const fragment = /* glsl */ `
precision highp float;
out vec4 result;
void main() {
  result = vec4(0.84, 0.2, 0.2, 1.0);
}
`;

export class MeasuredView {
  private readonly parts: (Points | LineSegments)[] = [];
  private readonly scales: { value: number; height: number }[] = [];

  constructor(private readonly scene: Scene) {}

  set(shapes: readonly MeasuredShape[]): void {
    for (const part of this.parts) {
      this.scene.remove(part);
      part.geometry.dispose();
    }
    this.parts.length = 0;
    this.scales.length = 0;
    for (const { points, lines, relative } of shapes) {
      const size = { value: 1, height: relative ? heightOf([points, ...lines]) : 0 };
      this.scales.push(size);
      const material = new RawShaderMaterial({
        glslVersion: GLSL3,
        uniforms: { size, points: { value: 3.5 } },
        vertexShader: vertex,
        fragmentShader: fragment,
      });
      if (points.length > 0) this.add(new Points(geometryOf(points), material));
      if (lines.length > 0) this.add(new LineSegments(geometryOf(lines.flatMap(segmentsOf)), material));
    }
  }

  /** Shows them beside a plant, or hides them. */
  place(shown: boolean, plant: Box | null): void {
    for (const part of this.parts) part.visible = shown;
    for (const size of this.scales) size.value = size.height > 0 && plant ? (plant.upper[1] - plant.lower[1]) / size.height : 1;
  }

  private add(part: Points | LineSegments): void {
    part.frustumCulled = false;
    this.parts.push(part);
    this.scene.add(part);
  }
}

function geometryOf(numbers: readonly number[]): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(numbers), 3));
  return geometry;
}

/** Both ends of each piece of a line. */
function segmentsOf(line: readonly number[]): number[] {
  const ends: number[] = [];
  for (let i = 3; i < line.length; i += 3) ends.push(...line.slice(i - 3, i + 3));
  return ends;
}

function heightOf(lists: readonly (readonly number[])[]): number {
  let [low, high] = [Infinity, -Infinity];
  for (const list of lists) {
    for (let i = 1; i < list.length; i += 3) {
      low = Math.min(low, list[i] ?? low);
      high = Math.max(high, list[i] ?? high);
    }
  }
  return high > low ? high - low : 0;
}
