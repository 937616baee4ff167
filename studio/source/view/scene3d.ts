/** The picture of a plant: what is drawn, from where, in which colours. It draws only when something has changed. */
import {
  Matrix4,
  OrthographicCamera,
  Scene,
  Vector3,
  WebGLRenderer,
  WebGLRenderTarget,
  type Camera,
} from "three";
import { at } from "../lists.js";
import { Backdrop } from "./backdrop.js";
import { BesideView, leftOf } from "./beside.js";
import { OrbitCamera } from "./camera.js";
import { themes, type Theme } from "./colours.js";
import { FieldView, type FieldLook } from "./fields.js";
import { Ground } from "./ground.js";
import { Internodes } from "./internodes.js";
import { Labels } from "./labels.js";
import { SceneLight, type AuthorLook, type SkyLook } from "./light.js";
import { MeasuredView, type MeasuredShape } from "./measured.js";
import { boundsOf, type Column, type Field, type Limbs, type Packet, type Shape } from "./packets.js";
import { Pictures, type PictureSource } from "./pictures.js";
import { markTable, Pass, shadowDepth, sharedUniforms, valueTable } from "./shading.js";
import { Shapes } from "./shapes.js";
import { Triangles } from "./triangles.js";
import { around, axes, sameBox, sameVector, vectorOf, type Box, type Vector } from "./vectors.js";

const shadowSize = 1024;
const pickReach = 4; // pixels around the pointer
const nothing = 0xffffffff;

/** Whether this browser draws without a graphics card. */
function drawsInSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return true;
  const facts = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(facts ? facts.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

export class PlantScene {
  readonly orbit: OrbitCamera;
  /** Called after a frame was drawn. */
  drawn: (() => void) | null = null;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly uniforms = sharedUniforms();
  private readonly light = new SceneLight(this.uniforms);
  private readonly backdrop = new Backdrop();
  private readonly ground: Ground;
  private readonly internodes: Internodes;
  private readonly pictures = new Pictures(() => {
    this.shadowStale = true;
    this.request();
  });
  private readonly triangles: Triangles;
  /** Limbs with bark or skin, instead of the internodes. */
  private readonly limbs: Triangles;
  private readonly labels: Labels;
  private readonly shapes: Shapes;
  private readonly fieldView: FieldView;
  private readonly measured: MeasuredView;
  private readonly beside: BesideView;
  private readonly shadowCamera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private readonly shadowTarget = new WebGLRenderTarget(shadowSize, shadowSize, { depthTexture: shadowDepth(shadowSize) });
  private readonly pickTarget = new WebGLRenderTarget(2 * pickReach + 1, 2 * pickReach + 1);
  private readonly software = drawsInSoftware();
  private bounds: Box | null = null;
  /** How far the pinned plant stands away; null: where it grew. */
  private besideBy: Vector | null = null;
  private shadowStale = true;
  private requested = false;
  private restTimer = 0;
  private steady = false;
  private frame: Box | null = null;
  private framedGrowth: number | null = null;
  private width = 1;
  private height = 1;
  private groundShown = true;
  private labelsShown = true;
  private shadows = true;
  packet: Packet | null = null;
  private shownTheme: Theme = themes.light;

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: !this.software, alpha: false, powerPreference: "high-performance" });
    this.renderer.autoClear = false;
    this.orbit = new OrbitCamera(() => this.request());
    this.ground = new Ground(this.uniforms);
    this.internodes = new Internodes(this.uniforms);
    this.triangles = new Triangles(this.uniforms, this.pictures, false);
    this.limbs = new Triangles(this.uniforms, this.pictures, true);
    this.labels = new Labels(this.uniforms);
    this.shapes = new Shapes(this.uniforms, this.pictures, this.scene);
    this.fieldView = new FieldView(this.uniforms, this.scene);
    this.measured = new MeasuredView(this.scene);
    this.beside = new BesideView(this.uniforms, this.pictures, this.scene);
    this.scene.matrixWorldAutoUpdate = false;
    this.scene.add(
      this.backdrop.mesh,
      this.ground.mesh,
      this.ground.veil,
      this.internodes.thick,
      this.internodes.thin,
      this.triangles.mesh,
      this.limbs.mesh,
      this.labels.mesh,
    );
    this.theme = themes.light;
  }

  set theme(theme: Theme) {
    this.shownTheme = theme;
    this.ground.useTheme(theme);
    this.labels.useTheme(theme);
    this.relight();
  }

  /** What the view file of the model says. Another place of the eye is taken at once. */
  setAuthor(author: AuthorLook): void {
    const moved = this.packet !== null && !sameVector(author.towardsEye, this.light.author.towardsEye);
    this.light.author = author;
    this.relight();
    if (moved && this.frame) this.home();
  }

  /** The light and background of the view file that show. */
  get shownLight(): AuthorLook {
    return this.light.shownAuthor;
  }

  /** Whether light and background are those of the view file. */
  setAuthorLight(on: boolean): void {
    this.light.authorShows = on;
    this.relight();
  }

  /** Sun and sky of the step, which shine instead of other light; null: the scene has none. */
  setSky(sky: SkyLook | null): void {
    if (sky === this.light.sky) return;
    this.light.sky = sky;
    this.relight();
  }

  /** Whether sun and sky of the scene light the plants. */
  setSkyLight(on: boolean): void {
    this.light.skyShows = on;
    this.relight();
  }

  /** The sun and the sky that light the plants; null: those of the scene do not. */
  get shownSky(): SkyLook | null {
    return this.light.shownSky;
  }

  private relight(): void {
    this.light.apply(this.shownTheme);
    this.backdrop.use(this.shownTheme, this.light.shownAuthor.background, this.light.shownSky);
    this.shadowStale = true;
    this.placeGround();
    this.request();
  }

  /** The box of the plants; null: nothing is shown. */
  get box(): Box | null {
    return this.bounds;
  }

  get gridCell(): number {
    return this.ground.cell;
  }

  learn(shapes: Shape[]): void {
    this.shapes.learn(shapes);
  }

  /** The pictures that a growth wears. */
  setPictures(sources: readonly PictureSource[]): void {
    this.pictures.set(sources);
    this.request();
  }

  /** Draws a packet from now on. The camera stays, except for the first one. */
  show(packet: Packet): void {
    this.packet = packet;
    this.internodes.show(packet);
    this.triangles.show(packet);
    this.shapes.show(packet);
    this.labels.show(packet.labels);
    this.limbs.clear();
    this.bounds = boundsOf(packet, (shape) => this.shapes.boxOf(shape));
    this.shadowStale = true;
    this.placeGround();
    this.followGrowth(packet);
    this.request();
  }

  /** Vertices and triangles of a packet: of surfaces, organs, and limbs that are drawn with bark or skin. */
  sizeOf(packet: Packet, limbs: Limbs | null): { vertices: number; triangles: number } {
    const size = this.shapes.sizeOf(packet);
    for (const mesh of limbs ? [packet, limbs] : [packet]) {
      size.vertices += mesh.positions.length / 3;
      size.triangles += mesh.indices.length / 3;
    }
    return size;
  }

  /** Draws the limbs of the packet with bark or skin from now on; null: as internodes. */
  setLimbs(limbs: Limbs | null): void {
    if (limbs) this.limbs.show(limbs);
    else this.limbs.clear();
    this.shadowStale = true;
    this.request();
  }

  /** The next growth is shown whole, from the first direction. */
  reframe(): void {
    this.frame = null;
    this.framedGrowth = null;
  }

  /** The user has chosen a view: it stays. */
  keepView(): void {
    if (this.framedGrowth !== null) this.framedGrowth = -1;
  }

  fit(): void {
    const box = this.wholeBox;
    if (box) this.orbit.fit(box.lower, box.upper);
  }

  home(): void {
    const box = this.wholeBox;
    if (box) this.orbit.home(box.lower, box.upper, this.isFlat(), this.light.author.towardsEye);
  }

  /** Another growth has been pinned, whose plants wear these shapes. */
  beginBeside(shapes: Shape[]): void {
    this.beside.begin(shapes);
    this.besideBy = null;
    this.changeBeside();
  }

  /** Draws the plant of a pinned growth left of the one that is shown, or on it, in grey; null: not at all. */
  showBeside(packet: Packet | null, apart: boolean): void {
    const box = packet && this.beside.boxOf(packet);
    if (!packet || !box || !this.bounds) this.beside.hide();
    else if (!apart) this.beside.show(packet, [0, 0, 0]);
    else {
      // It stays where it stands until the plants would touch.
      const { azimuth } = this.orbit.state;
      const needed = leftOf(this.bounds, box, azimuth);
      const isFirst = this.besideBy === null;
      if (!this.besideBy || axes.some((k) => Math.abs(needed[k]) > Math.abs(this.besideBy?.[k] ?? 0))) this.besideBy = needed;
      this.beside.show(packet, this.besideBy);
      if (isFirst) this.fit();
    }
    this.changeBeside();
  }

  colourBesideBy(by: Column | "order" | "grey" | null): void {
    this.beside.colourBy(by);
    this.request();
  }

  private changeBeside(): void {
    this.shadowStale = true;
    this.placeGround();
    this.request();
  }

  /** Colours modules by a column, by the order of branching, or as the model does. */
  colourBy(by: Column | "order" | null, range?: [number, number]): void {
    this.uniforms.colouring.value = by === null ? 0 : by === "order" ? 2 : 1;
    if (by === "order") this.uniforms.range.value.set(0, range ? range[1] : 6);
    if (by !== null && by !== "order") {
      this.uniforms.values.value.dispose();
      this.uniforms.values.value = valueTable(by.values);
      this.uniforms.range.value.set(...(range ?? [by.lowest, by.highest]));
    }
    this.request();
  }

  /** Marks one module and its siblings; everything else steps back. */
  mark(module: number | null, siblings: readonly number[] = []): void {
    this.uniforms.marked.value = module !== null;
    if (module !== null) {
      const highest = siblings.reduce((most, sibling) => Math.max(most, sibling), Math.max(module, this.highestModule()));
      const marks = new Uint8Array(highest + 1);
      for (const sibling of siblings) marks[sibling] = 2;
      marks[module] = 1;
      this.uniforms.marks.value.dispose();
      this.uniforms.marks.value = markTable(marks);
    }
    this.request();
  }

  showField(field: Field | null, look: FieldLook): void {
    if (field) this.fieldView.show(field);
    this.fieldView.look(field ? look : null);
    this.request();
  }

  lookAtField(look: FieldLook): void {
    this.fieldView.look(look);
    this.request();
  }

  /** What was measured, which stands beside the plant from now on. */
  setMeasured(shapes: readonly MeasuredShape[]): void {
    this.measured.set(shapes);
    this.request();
  }

  setLabels(shown: boolean): void {
    this.labelsShown = shown;
    this.request();
  }

  setGround(shown: boolean): void {
    this.groundShown = shown;
    this.request();
  }

  setShadows(on: boolean): void {
    this.shadows = on;
    this.shadowStale = true;
    this.request();
  }

  resize(width: number, height: number): void {
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    this.renderer.setPixelRatio(this.software ? 1 : Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(this.width, this.height, false);
    this.orbit.resize(this.width, this.height);
    this.request();
  }

  /** A film needs a picture of one size. */
  keepSize(steady: boolean): void {
    this.steady = steady;
    clearTimeout(this.restTimer);
    if (this.software) this.setRatio(1);
    this.request();
  }

  request(): void {
    if (this.requested) return;
    this.requested = true;
    this.noteRest(false);
    requestAnimationFrame(() => {
      this.requested = false;
      if (this.software) this.drawFastThenFine();
      else this.drawFine();
      this.drawn?.();
    });
  }

  private drawFine(): void {
    this.draw();
    this.noteRest(!this.requested);
  }

  /** Tells in the page whether the picture is as it will stay. */
  private noteRest(rests: boolean): void {
    this.canvas.toggleAttribute("data-draws", !rests || this.pictures.areLoading);
  }

  /** Without a graphics card, smooth edges wait until the picture rests. */
  private drawFastThenFine(): void {
    this.setRatio(1);
    this.draw();
    clearTimeout(this.restTimer);
    if (this.steady) return this.noteRest(!this.requested);
    this.restTimer = window.setTimeout(() => {
      this.setRatio(2);
      this.drawFine();
    }, 300);
  }

  private setRatio(ratio: number): void {
    if (ratio === this.renderer.getPixelRatio()) return;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(this.width, this.height, false);
  }

  /** Draws now. */
  draw(): void {
    if (this.shadowStale) this.drawShadow();
    this.drawPass(Pass.picture, this.orbit.camera, null);
  }

  /** The module under a point of the canvas, or null. */
  pick(x: number, y: number): number | null {
    const { camera } = this.orbit;
    const side = 2 * pickReach + 1;
    camera.setViewOffset(this.width, this.height, Math.round(x) - pickReach, Math.round(y) - pickReach, side, side);
    this.drawPass(Pass.identity, camera, this.pickTarget);
    camera.clearViewOffset();
    const bytes = new Uint8Array(side * side * 4);
    this.renderer.readRenderTargetPixels(this.pickTarget, 0, 0, side, side, bytes);
    return nearestIdentity(bytes, side);
  }

  /** The picture as a PNG, with `scale` times the pixels. */
  async snapshot(scale: number): Promise<Blob> {
    const ratio = this.renderer.getPixelRatio();
    this.setRatio(scale);
    this.draw();
    const blob = await new Promise<Blob | null>((done) => this.canvas.toBlob(done, "image/png"));
    this.setRatio(ratio);
    this.draw();
    if (!blob) throw new Error("The browser could not write the picture.");
    return blob;
  }

  /** Waits until everything drawn so far stands in the picture: for measurements. */
  finish(): void {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /** A drawing in the plane x y: it is looked at from the front and stands on no ground. */
  private isFlat(): boolean {
    const { bounds } = this;
    if (!bounds) return false;
    const size = vectorOf((k) => bounds.upper[k] - bounds.lower[k]);
    return size[2] < 0.01 * Math.max(size[0], size[1]) && size[0] > 0.05 * size[1];
  }

  private reachesBelow(): boolean {
    if (!this.bounds) return false;
    return this.bounds.lower[1] + (this.packet?.radius ?? 0) < -0.01 * (this.bounds.upper[1] - this.bounds.lower[1]);
  }

  /** The first growth of a document stays whole in the picture while it grows; later ones leave the camera alone. */
  private followGrowth(packet: Packet): void {
    if (!this.bounds) return;
    this.framedGrowth ??= packet.growth;
    if (this.framedGrowth !== packet.growth) return;
    const before = this.frame;
    this.frame = before ? around(before, this.bounds) : this.bounds;
    if (!before) this.orbit.home(this.frame.lower, this.frame.upper, this.isFlat(), this.light.author.towardsEye);
    else if (!sameBox(this.frame, before)) this.orbit.fit(this.frame.lower, this.frame.upper);
  }

  private highestModule(): number {
    const { packet } = this;
    if (!packet) return 0;
    let highest = 0;
    for (let i = 5; i < packet.internodes.length; i += 6) highest = Math.max(highest, at(packet.internodes, i));
    for (const module of packet.modules) highest = Math.max(highest, module);
    for (const group of packet.groups) for (const module of group.modules) highest = Math.max(highest, module);
    return highest;
  }

  /** The box of all plants that stand in the picture. */
  private get wholeBox(): Box | null {
    return this.bounds && this.beside.box ? around(this.bounds, this.beside.box) : this.bounds;
  }

  private placeGround(): void {
    const box = this.wholeBox;
    if (!box) return;
    const { lower, upper } = box;
    const centre = new Vector3((lower[0] + upper[0]) / 2, (lower[1] + upper[1]) / 2, (lower[2] + upper[2]) / 2);
    const radius = Math.max(0.5 * Math.hypot(upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]), 1e-4);
    this.ground.place(centre, radius);
    const sun = this.uniforms.sun.value;
    const camera = this.shadowCamera;
    camera.left = camera.bottom = -radius;
    camera.right = camera.top = radius;
    camera.near = 0;
    // The ground may lie far behind the plant.
    camera.far = 2 * radius + Math.max(0, centre.y) / sun.y + radius;
    camera.position.copy(centre).addScaledVector(sun, radius);
    camera.lookAt(centre);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    const toTexture = new Matrix4().set(0.5, 0, 0, 0.5, 0, 0.5, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0, 1);
    this.uniforms.shadowMatrix.value
      .copy(toTexture)
      .multiply(camera.projectionMatrix)
      .multiply(camera.matrixWorldInverse);
    this.uniforms.shadowBias.value = (radius * 0.012) / camera.far;
  }

  private drawShadow(): void {
    this.shadowStale = false;
    const shadowed = this.shadows && this.light.castsShadows && this.bounds !== null;
    this.uniforms.shadowed.value = false;
    // What is drawn to must not be read from.
    this.uniforms.shadowMap.value = null;
    if (shadowed) this.drawPass(Pass.shadow, this.shadowCamera, this.shadowTarget);
    this.uniforms.shadowMap.value = this.shadowTarget.depthTexture;
    if (shadowed) this.ground.drawShade(this.renderer, this.shadowCamera);
    this.uniforms.shadowed.value = shadowed;
  }

  private drawPass(pass: Pass, camera: Camera, target: WebGLRenderTarget | null): void {
    const picture = pass === Pass.picture;
    this.uniforms.pass.value = pass;
    this.setEye(pass === Pass.shadow);
    this.internodes.choose(pass === Pass.shadow ? null : this.orbit.camera.position, this.uniforms.pixel.value);
    this.beside.prepare(pass !== Pass.identity, pass === Pass.shadow ? null : this.orbit.camera.position, this.uniforms.pixel.value);
    if (this.limbs.mesh.visible) this.internodes.thick.visible = this.internodes.thin.visible = false;
    this.labels.mesh.visible = picture && this.labelsShown && !this.labels.empty;
    this.measured.place(picture, this.bounds);
    this.backdrop.mesh.visible = picture;
    this.ground.mesh.visible = picture && this.groundShown && !this.isFlat();
    this.ground.veil.visible = this.ground.mesh.visible && this.reachesBelow();
    this.renderer.setRenderTarget(target);
    this.renderer.setClearColor(0xffffff, 1);
    this.renderer.clear();
    this.renderer.render(this.scene, camera);
    this.renderer.setRenderTarget(null);
  }

  private setEye(parallel: boolean): void {
    const eye = this.uniforms.eye.value;
    if (parallel) {
      eye.set(...this.uniforms.sun.value.toArray(), 0);
      this.uniforms.pixel.value = (this.shadowCamera.right * 2) / shadowSize;
      return;
    }
    const { camera } = this.orbit;
    eye.set(...camera.position.toArray(), 1);
    const rows = this.height * this.renderer.getPixelRatio();
    this.uniforms.pixel.value = (2 * Math.tan((camera.fov * Math.PI) / 360)) / rows;
    this.uniforms.screenPixel.value = (2 * Math.tan((camera.fov * Math.PI) / 360)) / this.height;
  }
}

function nearestIdentity(bytes: Uint8Array, side: number): number | null {
  const view = new DataView(bytes.buffer);
  const middle = (side - 1) / 2;
  let best: number | null = null;
  let nearest = Infinity;
  for (let i = 0; i < side * side; i++) {
    const identity = view.getUint32(i * 4, true);
    const away = Math.hypot((i % side) - middle, Math.floor(i / side) - middle);
    if (identity === nothing || away >= nearest) continue;
    nearest = away;
    best = identity;
  }
  return best;
}
