/** The triangles of a packet, drawn from both sides. */
import { BufferAttribute, BufferGeometry, Mesh } from "three";
import type { Packet } from "./packets.js";
import { plantMaterial, surfaceFragment, type Uniforms } from "./shading.js";

const vertex = /* glsl */ `
in vec3 position;
in vec4 normal;
in vec4 tint;
in uint module;
out vec3 turned, towards;
out vec4 mixed;
out float light;

void main() {
  vec4 clip = projectionMatrix * (viewMatrix * vec4(position, 1.0));
  gl_Position = clip;
  identity = module;
  mixed.a = tint.a;
  if (pass != 0) return;
  turned = normal.xyz;
  towards = eye.xyz - position * eye.w;
  mixed.rgb = colourOf(module, tint.rgb, 0.0);
  light = lit(position);
}
`;

export class Triangles {
  readonly mesh: Mesh;

  constructor(shared: Uniforms) {
    this.mesh = new Mesh(
      new BufferGeometry(),
      plantMaterial({ uniforms: { ...shared }, vertex, fragment: surfaceFragment("", "vec4(1.0)") }),
    );
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
  }

  show(packet: Packet): void {
    this.mesh.geometry.dispose();
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(packet.positions, 3));
    geometry.setAttribute("normal", new BufferAttribute(packet.normals, 4, true));
    geometry.setAttribute("tint", new BufferAttribute(packet.colours, 4, true));
    geometry.setAttribute("module", new BufferAttribute(packet.modules, 1));
    geometry.setIndex(new BufferAttribute(packet.indices, 1));
    this.mesh.geometry = geometry;
    this.mesh.visible = packet.indices.length > 0;
  }
}
