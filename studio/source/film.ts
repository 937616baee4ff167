/** A film of all steps, recorded from the canvas. */
import { download } from "./elements.js";
import type { LimbLook } from "./limbs.js";
import { errorText, type Studio } from "./state.js";
import type { Timeline } from "./timeline.js";
import type { PlantScene } from "./view/index.js";

export class Film {
  running = false;

  constructor(
    private readonly studio: Studio,
    private readonly scene: PlantScene,
    private readonly timeline: Timeline,
    private readonly limbs: LimbLook,
  ) {}

  async toggle(): Promise<void> {
    if (this.running) {
      this.running = false;
      return;
    }
    this.running = true;
    try {
      const name = `${this.studio.document?.name ?? "plant"}.webm`;
      download(await this.record(), name);
      this.studio.tell("note", `The film is in your downloads: ${name}.`);
    } catch (error) {
      this.studio.tell("error", errorText(error));
    }
    this.running = false;
    this.scene.keepSize(false);
  }

  /** Shows each step for the time that playing gives it. */
  private async record(): Promise<Blob> {
    const kind = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"].find((name) =>
      MediaRecorder.isTypeSupported(name),
    );
    if (!kind) throw new Error("This browser cannot record films in the format WebM.");
    this.timeline.pause();
    this.scene.keepSize(true);
    const { frames } = this.studio;
    const stream = this.scene.canvas.captureStream(30);
    const recorder = new MediaRecorder(stream, { mimeType: kind, videoBitsPerSecond: 8e6 });
    const parts: Blob[] = [];
    recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
    const ended = new Promise<void>((done) => recorder.addEventListener("stop", () => done()));
    const last = this.timeline.last;
    recorder.start();
    const told = this.studio.tell("note", "A film is being recorded: it plays all steps once.");
    for (let step = 0; step <= last && this.running; step++) {
      await frames.fetch(step);
      frames.look(step);
      if (recorder.state === "recording") recorder.pause();
      await this.limbs.settled();
      recorder.resume();
      this.scene.draw();
      await new Promise((done) => setTimeout(done, this.timeline.interval));
    }
    await new Promise((done) => setTimeout(done, 500));
    recorder.stop();
    await ended;
    this.studio.dismiss(told);
    for (const track of stream.getTracks()) track.stop();
    return new Blob(parts, { type: "video/webm" });
  }
}
