/** Plays a growth that was recorded in an HTML file: no server is needed. */
import { at } from "../lists.js";
import type { CameraState } from "./camera.js";
import { themes, type Theme } from "./colours.js";
import { decompress, fromBase64 } from "./compression.js";
import { readMessage, type Limbs, type Packet } from "./packets.js";
import { OrganCard, type OrganMoment, type OrganTable } from "./organ-card.js";
import type { AuthorLook, SkyLook } from "./light.js";
import { PlantScene } from "./scene3d.js";
import { steer } from "./steer.js";

export interface Recording {
  title: string;
  theme: Theme["name"];
  steps: number[];
  /** Compressed binary messages of the protocol, in base64. */
  packets: string[];
  shapes: string[];
  images: string[];
  /** The pictures of relief of the images, "" where there is none. */
  reliefs: string[];
  /** Limbs with bark or skin, of the steps that showed them. */
  limbs: string[];
  /** All organs and, for each step, what is known of its modules; compressed JSON in base64. Missing: nothing is known. */
  organs?: string;
  moments?: string[];
  camera: CameraState;
  light: AuthorLook;
  /** Of each step; empty or missing: the scene has none, or it does not show. */
  skies?: SkyLook[];
}

async function unpack(text: string): Promise<ArrayBuffer> {
  const bytes = await decompress(fromBase64(text));
  return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) as ArrayBuffer;
}

async function unpackJson<Value>(text: string): Promise<Value> {
  return JSON.parse(new TextDecoder().decode(await unpack(text))) as Value;
}

function blobOf(text: string): Promise<Blob> | null {
  return text ? Promise.resolve(new Blob([fromBase64(text) as Uint8Array<ArrayBuffer>])) : null;
}

class Player {
  private readonly scene: PlantScene;
  private readonly slider = document.createElement("input");
  private readonly button = document.createElement("button");
  private readonly label = document.createElement("output");
  private readonly packets = new Map<number, Promise<Packet>>();
  private readonly limbs = new Map<number, Limbs>();
  private readonly card = new OrganCard(() => this.forget());
  private organs: Promise<OrganTable> | null = null;
  /** Number of the organ that was clicked at. */
  private picked: number | null = null;
  private at = 0;
  private playing = false;

  constructor(private readonly recording: Recording) {
    const canvas = document.createElement("canvas");
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
      const message = readMessage(await unpack(text));
      if (message.kind === "limbs") this.limbs.set(message.step, message);
    }
    for (const text of this.recording.shapes) {
      const message = readMessage(await unpack(text));
      if (message.kind === "shapes") this.scene.learn(message.shapes);
    }
    await this.show(this.recording.packets.length - 1);
    this.scene.keepView();
    this.scene.orbit.state = this.recording.camera;
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
    this.slider.max = String(this.recording.packets.length - 1);
    this.slider.setAttribute("aria-label", "Step");
    this.slider.addEventListener("input", () => void this.show(Number(this.slider.value)));
    bar.append(title, this.button, this.slider, this.label);
    return bar;
  }

  private packet(index: number): Promise<Packet> {
    let packet = this.packets.get(index);
    if (!packet) {
      packet = unpack(at(this.recording.packets, index)).then((buffer) => {
        const message = readMessage(buffer);
        if (message.kind !== "packet") throw new Error("The recording is broken.");
        return message;
      });
      this.packets.set(index, packet);
    }
    return packet;
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
    await this.showCard();
  }

  private async moment(): Promise<OrganMoment | null> {
    const text = this.recording.moments?.[this.at];
    if (!text) return null;
    const moment = await unpackJson<OrganMoment>(text);
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
    this.organs ??= unpackJson<OrganTable>(this.recording.organs);
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
    if (this.at >= this.recording.packets.length - 1) await this.show(0);
    while (this.playing && this.at < this.recording.packets.length - 1) {
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
