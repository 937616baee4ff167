/** Limbs as rendered pictures have them, once the picture rests: with bark where they wear it, with a smooth skin on demand. */
import { h, remember, remembered } from "./elements.js";
import type { Studio } from "./state.js";
import type { Limbs, Packet, PlantScene } from "./view/index.js";

const rest = 200; // milliseconds that a step is looked at before its limbs are asked for
const mostWithBark = 60_000; // internodes that get bark without being asked

export class LimbLook {
  /** Says that a skin is being made. */
  readonly element = h("div", "limb-progress", { hidden: true, role: "status" });
  private smooth = remembered("smooth", false);
  private asked = "";
  private timer = 0;
  /** Of those who wait for limbs. */
  private readonly waiting: (() => void)[] = [];

  constructor(
    private readonly studio: Studio,
    private readonly scene: PlantScene,
  ) {
    this.element.append(
      h("span", "", {}, "Making the smooth skin …"),
      h("button", "button small", { type: "button", onclick: () => this.setSmooth(false) }, "Cancel"),
    );
    studio.on("shown", (packet) => this.follow(packet));
    studio.on("limbs", (limbs) => this.receive(limbs));
    studio.on("progress", ({ what, done }) => {
      if (what === "smooth skin" && done >= 1) this.element.hidden = true;
    });
  }

  get isSmooth(): boolean {
    return this.smooth;
  }

  setSmooth(smooth: boolean): void {
    this.smooth = smooth;
    remember("smooth", smooth);
    this.endProgress();
    this.studio.connection.request("limbs", { skin: null }).catch(() => undefined);
    this.asked = "";
    this.studio.limbs = null;
    this.scene.setLimbs(null);
    this.note();
    this.ask(0);
  }

  /** What is being made is not waited for any more. */
  private endProgress(): void {
    if (this.element.hidden) return;
    this.element.hidden = true;
    this.studio.emit("progress", { what: "smooth skin", done: 1 });
  }

  /** Tells in the page how the limbs are drawn: "", "tubes" or "smooth", and that others are on their way. */
  private note(): void {
    const { canvas } = this.scene;
    canvas.dataset.limbs = this.studio.limbs ? (this.studio.limbs.smooth ? "smooth" : "tubes") : "";
    canvas.toggleAttribute("data-waits", this.waits);
    if (!this.waits) this.release();
  }

  private get waits(): boolean {
    return this.skin !== null && !this.studio.limbs;
  }

  /** Waits until the limbs of the step that shows are drawn as they are to be, or cannot be. */
  settled(): Promise<void> {
    return this.waits ? new Promise((done) => this.waiting.push(done)) : Promise.resolve();
  }

  private release(): void {
    for (const done of this.waiting.splice(0)) done();
  }

  private get skin(): "smooth" | "tubes" | null {
    const packet = this.studio.frames.shown;
    if (!packet || packet.internodeCount === 0) return null;
    if (this.smooth) return "smooth";
    return packet.texturedLimbs && packet.internodeCount <= mostWithBark ? "tubes" : null;
  }

  private follow(packet: Packet): void {
    const { limbs } = this.studio;
    if (limbs && limbs.growth === packet.growth && limbs.step === packet.step) {
      this.scene.setLimbs(limbs);
      return;
    }
    this.studio.limbs = null;
    this.endProgress();
    this.note();
    this.ask(rest);
  }

  private ask(after: number): void {
    clearTimeout(this.timer);
    const { skin } = this;
    const packet = this.studio.frames.shown;
    if (!skin || !packet) return;
    this.timer = window.setTimeout(() => {
      const { growth, step } = packet;
      this.asked = `${growth} ${step} ${skin}`;
      this.element.hidden = skin !== "smooth";
      this.studio.connection.request("limbs", { growth, step, skin }).catch(() => {
        this.element.hidden = true;
        this.release();
      });
    }, after);
  }

  private receive(limbs: Limbs): void {
    if (this.asked !== `${limbs.growth} ${limbs.step} ${limbs.smooth ? "smooth" : "tubes"}`) return;
    this.element.hidden = true;
    const { shown } = this.studio.frames;
    if (shown?.growth !== limbs.growth || shown.step !== limbs.step) return;
    this.studio.limbs = limbs;
    this.scene.setLimbs(limbs);
    this.note();
  }
}
