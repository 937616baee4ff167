/** Plays a growth that was recorded in an HTML file: no server is needed. */
import { at } from "../lists.js";
import type { CameraState } from "./camera.js";
import { themes, type Theme } from "./colours.js";
import { fromBase64 } from "./compression.js";
import type { FieldLook } from "./fields.js";
import { FrameTexts, jsonOf, oneText } from "./frame-texts.js";
import { readMessage, type Field, type Limbs, type Packet } from "./packets.js";
import { OrganCard, type OrganMoment, type OrganTable } from "./organ-card.js";
import type { AuthorLook, SkyLook } from "./light.js";
import { PlantScene } from "./scene3d.js";
import { steer } from "./steer.js";
import type { Axis } from "./vectors.js";

export interface Recording {
  title: string;
  theme: Theme["name"];
  steps: number[];
  /** With which packets, organs, moments and fields are written; missing: in base64. */
  letters?: string;
  /** So many frames in each text of packets, moments and fields; missing: one. */
  together?: number;
  /** Compressed binary messages of the protocol. */
  packets: string[];
  shapes: string[];
  images: string[];
  /** The pictures of relief of the images, "" where there is none. */
  reliefs: string[];
  /** Limbs with bark or skin, of the steps that showed them. */
  limbs: string[];
  /** All organs and, for each step, what is known of its modules; compressed JSON. Missing: nothing is known. */
  organs?: string;
  moments?: string[];
  /** Fields of every step. */
  fields?: { name: string; unit: string; texts: string[] }[];
  /** null: the last step as a whole. */
  camera: CameraState | null;
  light: AuthorLook;
  /** Of each step; empty or missing: the scene has none, or it does not show. */
  skies?: SkyLook[];
}

function blobOf(text: string): Promise<Blob> | null {
  return text ? Promise.resolve(new Blob([fromBase64(text) as Uint8Array<ArrayBuffer>])) : null;
}

/** A window of glass behind the plant; what has one layer of voxels, as that. */
function lookOf({ size }: Field): FieldLook {
  const flat = size.indexOf(1);
  return { mode: "slice", axis: flat < 0 ? 2 : (flat as Axis), at: 0.5 };
}

class Player {
  private readonly canvas = document.createElement("canvas");
  private readonly scene: PlantScene;
  private readonly slider = document.createElement("input");
  private readonly button = document.createElement("button");
  private readonly label = document.createElement("output");
  private readonly fieldSelect = document.createElement("select");
  private readonly fieldLegend = document.createElement("output");
  private readonly packets: FrameTexts;
  private readonly moments: FrameTexts;
  private readonly fields: FrameTexts[];
  private readonly limbs = new Map<number, Limbs>();
  private readonly card = new OrganCard(() => this.forget());
  private organs: Promise<OrganTable> | null = null;
  /** Number of the organ that was clicked at. */
  private picked: number | null = null;
  private at = 0;
  private playing = false;

  constructor(private readonly recording: Recording) {
    const { together, letters, packets, moments = [], fields = [] } = recording;
    this.packets = new FrameTexts(packets, together, letters);
    this.moments = new FrameTexts(moments, together, letters);
    this.fields = fields.map(({ texts }) => new FrameTexts(texts, together, letters));
    const { canvas } = this;
    canvas.setAttribute("aria-label", "The plant. Arrows turn, + and - zoom, F fits.");
    document.body.append(canvas, this.card.element, this.bar());
    this.scene = new PlantScene(canvas);
    this.scene.theme = themes[recording.theme];
    steer(this.scene, { clicked: (x, y) => void this.pick(this.scene.pick(x, y)) });
    canvas.addEventListener("keydown", (event) => event.key === "Escape" && this.forget());
    const resize = () => this.scene.resize(canvas.clientWidth, canvas.clientHeight);
    new ResizeObserver(resize).observe(canvas);
    resize();
  }

  async start(): Promise<void> {
    const { images, reliefs, light } = this.recording;
    this.scene.setAuthor(light);
    this.scene.setPictures(images.map((text, i) => ({ colours: blobOf(text), normals: blobOf(reliefs[i] ?? "") })));
    for (const text of this.recording.limbs) {
      const message = readMessage(await oneText(text));
      if (message.kind === "limbs") this.limbs.set(message.step, message);
    }
    for (const text of this.recording.shapes) {
      const message = readMessage(await oneText(text));
      if (message.kind === "shapes") this.scene.learn(message.shapes);
    }
    await this.chooseSoil();
    await this.show(this.recording.steps.length - 1);
    this.scene.keepView();
    const { camera } = this.recording;
    const { clientWidth, clientHeight } = this.canvas;
    // A narrow window shows what a wide one showed from farther away.
    const farther = Math.max(1, clientHeight / Math.max(1, clientWidth));
    if (camera) this.scene.orbit.state = { ...camera, distance: camera.distance * farther };
  }

  private bar(): HTMLElement {
    const bar = document.createElement("div");
    bar.className = "recording-bar";
    const title = document.createElement("h1");
    title.textContent = this.recording.title;
    this.button.type = "button";
    this.button.className = "button";
    this.button.textContent = "Play";
    this.button.addEventListener("click", () => this.toggle());
    this.slider.type = "range";
    this.slider.min = "0";
    this.slider.max = String(this.recording.steps.length - 1);
    this.slider.setAttribute("aria-label", "Step");
    this.slider.addEventListener("input", () => void this.show(Number(this.slider.value)));
    bar.append(title, this.button, this.slider, this.label, ...this.fieldChoice());
    return bar;
  }

  private async packet(index: number): Promise<Packet> {
    const message = readMessage(await this.packets.frame(index));
    if (message.kind !== "packet") throw new Error("The recording is broken.");
    return message;
  }

  private fieldChoice(): HTMLElement[] {
    const { fields = [] } = this.recording;
    if (fields.length === 0) return [];
    this.fieldSelect.setAttribute("aria-label", "Field");
    this.fieldSelect.append(new Option("no field", ""), ...fields.map(({ name }, i) => new Option(name, String(i))));
    this.fieldSelect.addEventListener("change", () => void this.showField());
    return [this.fieldSelect, this.fieldLegend];
  }

  private async fieldOf(number: number, index: number): Promise<Field | null> {
    const message = readMessage(await at(this.fields, number).frame(index));
    return message.kind === "field" ? message : null;
  }

  /** Soil belongs to the picture, and so does what has one layer of voxels. */
  private async chooseSoil(): Promise<void> {
    for (let i = 0; i < this.fields.length && this.fieldSelect.value === ""; i++) {
      const field = await this.fieldOf(i, this.recording.steps.length - 1);
      if (field && (field.size.includes(1) || field.upper[1] + field.lower[1] < 0)) this.fieldSelect.value = String(i);
    }
  }

  private async showField(): Promise<void> {
    const { value } = this.fieldSelect;
    const { at: index } = this;
    const field = value === "" ? null : await this.fieldOf(Number(value), index);
    if (this.fieldSelect.value !== value || this.at !== index) return;
    this.scene.showField(field, field ? lookOf(field) : { mode: "slice", axis: 2, at: 0.5 });
    const unit = this.recording.fields?.[Number(value)]?.unit ?? "";
    const ends = (number: number) => Number(number.toPrecision(3));
    this.fieldLegend.textContent = field ? `${ends(field.lowest)} to ${ends(field.highest)}${unit === "1" ? "" : ` ${unit}`}` : "";
    document.body.dataset.field = field?.name ?? "";
  }

  private async show(index: number): Promise<void> {
    this.at = index;
    const packet = await this.packet(index);
    if (this.at !== index) return;
    this.scene.setSky(this.recording.skies?.[index] ?? null);
    this.scene.show(packet);
    this.scene.setLimbs(this.limbs.get(packet.step) ?? null);
    this.slider.value = String(index);
    this.label.textContent = `step ${packet.step}`;
    document.body.dataset.step = String(packet.step);
    await this.showField();
    await this.showCard();
  }

  private async moment(): Promise<OrganMoment | null> {
    if (!this.recording.moments) return null;
    const moment = await jsonOf<OrganMoment>(this.moments.frame(this.at));
    let sum = 0;
    moment.organ = moment.organ.map((step) => (sum += step));
    return moment;
  }

  private async pick(module: number | null): Promise<void> {
    const organ = module === null ? undefined : (await this.moment())?.organ[module];
    if (organ === undefined) {
      this.forget();
      return;
    }
    this.picked = organ;
    await this.showCard();
  }

  private forget(): void {
    this.picked = null;
    this.card.hide();
    this.scene.mark(null);
  }

  /** What the step at hand says of the picked organ: the same one, while there is one. */
  private async showCard(): Promise<void> {
    const { picked, at: index } = this;
    if (picked === null || !this.recording.organs) return;
    this.organs ??= jsonOf<OrganTable>(oneText(this.recording.organs, this.recording.letters));
    const [table, moment] = await Promise.all([this.organs, this.moment()]);
    if (this.picked !== picked || this.at !== index) return;
    const module = moment?.organ.indexOf(picked) ?? -1;
    this.card.show(table, picked, module < 0 ? null : moment, module);
    this.scene.mark(module < 0 ? null : module);
  }

  private toggle(): void {
    this.playing = !this.playing;
    this.button.textContent = this.playing ? "Pause" : "Play";
    if (this.playing) void this.play();
  }

  private async play(): Promise<void> {
    if (this.at >= this.recording.steps.length - 1) await this.show(0);
    while (this.playing && this.at < this.recording.steps.length - 1) {
      await new Promise((done) => setTimeout(done, 120));
      if (this.playing) await this.show(this.at + 1);
    }
    if (this.playing) this.toggle();
  }
}

/** Called by the shared file. */
export function playRecording(): void {
  const text = document.getElementById("recording")?.textContent;
  if (text) void new Player(JSON.parse(text) as Recording).start();
}
