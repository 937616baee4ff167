/** Texts that the model wrote: each stands upright before everything else, at its place. */
import {
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  Color,
  DoubleSide,
  GLSL3,
  LinearFilter,
  Mesh,
  RawShaderMaterial,
} from "three";
import type { Theme } from "./colours.js";
import type { Label } from "./packets.js";
import { setBytes, type SharedUniforms } from "./shading.js";

const most = 300; // as in rendered pictures
const [rowHeight, width] = [40, 1024]; // pixels of the sheet, which has two for each of the screen
const border = 6;

const vertex = /* glsl */ `
precision highp float;
uniform mat4 viewMatrix, projectionMatrix;
uniform float screenPixel;
in vec3 position;
in vec2 shift, onSheet;
in vec4 tint;
out vec2 at;
out vec3 colour;
void main() {
  vec4 seen = viewMatrix * vec4(position, 1.0);
  seen.xy += shift * screenPixel * -seen.z;
  gl_Position = projectionMatrix * seen;
  at = onSheet;
  colour = tint.rgb;
}
`;

const fragment = /* glsl */ `
precision highp float;
uniform sampler2D sheet;
uniform vec3 halo;
in vec2 at;
in vec3 colour;
out vec4 result;
void main() {
  vec4 ink = texture(sheet, at);
  result = vec4(mix(halo, colour, ink.r), max(ink.r, 0.85 * ink.g));
}
`;

function uniformsOf({ screenPixel }: SharedUniforms) {
  return { screenPixel, sheet: { value: null as CanvasTexture | null }, halo: { value: new Color(1, 1, 1) } };
}

export class Labels {
  readonly mesh: Mesh<BufferGeometry, RawShaderMaterial>;
  private readonly canvas = document.createElement("canvas");
  private readonly uniforms: ReturnType<typeof uniformsOf>;

  constructor(shared: SharedUniforms) {
    this.uniforms = uniformsOf(shared);
    const material = new RawShaderMaterial({
      glslVersion: GLSL3,
      uniforms: this.uniforms,
      vertexShader: vertex,
      fragmentShader: fragment,
      transparent: true,
      depthTest: false,
      depthWrite: false,
      side: DoubleSide,
    });
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
    this.mesh.renderOrder = 3;
  }

  useTheme(theme: Theme): void {
    setBytes(this.uniforms.halo.value, theme.horizon);
  }

  get empty(): boolean {
    return this.mesh.geometry.index === null;
  }

  show(all: readonly Label[]): void {
    this.mesh.geometry.dispose();
    this.mesh.geometry = new BufferGeometry();
    const labels = all.slice(0, most);
    if (labels.length === 0) return;
    const rows = this.write([...new Set(labels.map(({ text }) => text))]);
    const places: number[] = [];
    const shifts: number[] = [];
    const onSheet: number[] = [];
    const tints: number[] = [];
    const indices: number[] = [];
    for (const { position, colour, text } of labels) {
      const { row, wide } = rows.get(text) ?? { row: 0, wide: 0 };
      const first = places.length / 3;
      for (const [x, y] of [[0, 0], [1, 0], [0, 1], [1, 1]] as const) {
        places.push(...position);
        shifts.push((x * wide) / 2, (y * rowHeight - border) / 2);
        onSheet.push((x * wide) / width, 1 - ((row + 1 - y) * rowHeight) / this.canvas.height);
        tints.push(...colour, 255);
      }
      indices.push(first, first + 1, first + 2, first + 2, first + 1, first + 3);
    }
    const { geometry } = this.mesh;
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(places), 3));
    geometry.setAttribute("shift", new BufferAttribute(new Float32Array(shifts), 2));
    geometry.setAttribute("onSheet", new BufferAttribute(new Float32Array(onSheet), 2));
    geometry.setAttribute("tint", new BufferAttribute(new Uint8Array(tints), 4, true));
    geometry.setIndex(indices);
  }

  /** Writes each text into a row of the sheet: red is the letters, green their surroundings. */
  private write(texts: readonly string[]): Map<string, { row: number; wide: number }> {
    const rows = new Map<string, { row: number; wide: number }>();
    this.canvas.width = width;
    this.canvas.height = 2 ** Math.ceil(Math.log2(texts.length * rowHeight));
    const pen = this.canvas.getContext("2d");
    if (!pen) return rows;
    pen.fillStyle = "black";
    pen.fillRect(0, 0, width, this.canvas.height);
    pen.font = "500 27px system-ui, sans-serif";
    pen.textBaseline = "alphabetic";
    pen.lineJoin = "round";
    texts.forEach((text, row) => {
      const y = (row + 1) * rowHeight - 12;
      pen.lineWidth = 7;
      pen.strokeStyle = "#0f0";
      pen.strokeText(text, border, y, width - 2 * border);
      pen.globalCompositeOperation = "lighter";
      pen.fillStyle = "#f00";
      pen.fillText(text, border, y, width - 2 * border);
      pen.globalCompositeOperation = "source-over";
      rows.set(text, { row, wide: Math.min(width, pen.measureText(text).width + 2 * border) });
    });
    this.uniforms.sheet.value?.dispose();
    const sheet = new CanvasTexture(this.canvas);
    sheet.minFilter = LinearFilter;
    sheet.generateMipmaps = false;
    this.uniforms.sheet.value = sheet;
    return rows;
  }
}
