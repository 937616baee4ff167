/** Triangles, drawn from both sides, with the pictures that they wear and the relief of bark. */
import { BufferAttribute, BufferGeometry, Mesh, type RawShaderMaterial } from "three";
import type { TriangleMesh } from "./packets.js";
import type { Pictures } from "./pictures.js";
import { plantMaterial, surfaceFragment, type SharedUniforms } from "./shading.js";

const vertex = /* glsl */ `
in vec3 position;
in vec4 normal;
in vec4 tint;
in uint module;
#ifdef TEXTURED
in vec2 onPicture;
out vec2 onImage;
#endif
out vec3 turned, towards;
out vec4 mixed;
out float light;

void main() {
  vec4 clip = projectionMatrix * (viewMatrix * vec4(position, 1.0));
  gl_Position = clip;
  identity = module;
  mixed.a = tint.a;
#ifdef TEXTURED
  onImage = onPicture;
#endif
  if (pass != 0) return;
  turned = normal.xyz;
  towards = eye.xyz - position * eye.w;
  mixed.rgb = colourOf(module, tint.rgb, 0.0);
  light = lit(position);
}
`;

/** The tangents follow from how place and picture change from pixel to pixel (Schüler 2006). */
const relief = /* glsl */ `
in vec2 onImage;
uniform sampler2D image, relief;

vec3 bent(vec3 normal, vec3 place) {
  vec3 alongX = dFdx(place), alongY = dFdy(place);
  vec2 uvX = dFdx(onImage), uvY = dFdy(onImage);
  vec3 acrossX = cross(normal, alongX), acrossY = cross(alongY, normal);
  vec3 tangent = acrossY * uvX.x + acrossX * uvY.x;
  vec3 bitangent = acrossY * uvX.y + acrossX * uvY.y;
  float longest = max(dot(tangent, tangent), dot(bitangent, bitangent));
  if (longest <= 0.0) return normal;
  vec3 bend = texture(relief, onImage).xyz * 2.0 - 1.0;
  return normalize((tangent * bend.x + bitangent * bend.y) * inversesqrt(longest) + normal * bend.z);
}
`;

const picture = "in vec2 onImage; uniform sampler2D image;";

export class Triangles {
  readonly mesh: Mesh<BufferGeometry, RawShaderMaterial[]>;
  private readonly plain: RawShaderMaterial;

  /** `isWood`: no light comes through. */
  constructor(
    private readonly shared: SharedUniforms,
    private readonly pictures: Pictures,
    private readonly isWood: boolean,
  ) {
    this.plain = this.material(0);
    this.mesh = new Mesh(new BufferGeometry(), [this.plain]);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
  }

  show(triangles: TriangleMesh): void {
    this.clear();
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(triangles.positions, 3));
    geometry.setAttribute("normal", new BufferAttribute(triangles.normals, 4, true));
    geometry.setAttribute("tint", new BufferAttribute(triangles.colours, 4, true));
    geometry.setAttribute("module", new BufferAttribute(triangles.modules, 1));
    if (triangles.onPicture) geometry.setAttribute("onPicture", new BufferAttribute(triangles.onPicture, 2));
    geometry.setIndex(new BufferAttribute(triangles.indices, 1));
    this.mesh.material = triangles.ranges.map(({ texture }) => (texture > 0 ? this.material(texture) : this.plain));
    triangles.ranges.forEach(({ first, count }, index) => geometry.addGroup(first, count, index));
    this.mesh.geometry = geometry;
    this.mesh.visible = triangles.indices.length > 0;
  }

  clear(): void {
    this.mesh.geometry.dispose();
    for (const material of this.mesh.material) if (material !== this.plain) material.dispose();
    this.mesh.material = [];
    this.mesh.visible = false;
  }

  private material(texture: number): RawShaderMaterial {
    if (texture === 0)
      return plantMaterial({ uniforms: { ...this.shared }, vertex, fragment: surfaceFragment("", "vec4(1.0)", this.isWood) });
    const image = this.pictures.colours(texture);
    const normals = this.pictures.normals(texture);
    const hasRelief = this.pictures.hasRelief(texture);
    return plantMaterial({
      uniforms: { ...this.shared, image, relief: normals },
      vertex: `#define TEXTURED\n${vertex}`,
      fragment: surfaceFragment(
        hasRelief ? relief : picture,
        "texture(image, onImage)",
        this.isWood,
        hasRelief ? "bent(normal, -towards)" : "normal",
      ),
    });
  }
}
