/** A film of all steps: WebM with VP9, which says what its colours are, so that every browser plays those of the picture. */
import { ArrayBufferTarget, Muxer } from "webm-muxer";
import { download } from "./elements.js";
import type { LimbLook } from "./limbs.js";
import { errorText, type Studio } from "./state.js";
import type { Timeline } from "./timeline.js";
import type { PlantScene } from "./view/index.js";

/** Browsers that turn a picture into brightness and colour differences do it in different ways, and say another: we do it. */
const colours = { matrix: "smpte170m", primaries: "bt709", transfer: "iec61966-2-1", fullRange: false } as const;

/** Brightness, then both colour differences of each four pixels (ITU-R BT.601, limited range). Sides are even. */
export function planesOf(rgba: Uint8ClampedArray, width: number, height: number): Uint8Array {
  const pixels = width * height;
  const planes = new Uint8Array((pixels * 3) / 2);
  const at = (i: number): number => rgba[i] ?? 0;
  for (let i = 0; i < pixels; i++) {
    planes[i] = Math.round(16 + (65.481 * at(4 * i) + 128.553 * at(4 * i + 1) + 24.966 * at(4 * i + 2)) / 255);
  }
  let next = pixels;
  for (let y = 0; y < height; y += 2) {
    for (let x = 0; x < width; x += 2, next++) {
      const corner = 4 * (y * width + x);
      const mean = (k: number) =>
        (at(corner + k) + at(corner + 4 + k) + at(corner + 4 * width + k) + at(corner + 4 * width + 4 + k)) / (4 * 255);
      const [r, g, b] = [mean(0), mean(1), mean(2)];
      planes[next] = Math.round(128 - 37.797 * r - 74.203 * g + 112 * b);
      planes[next + pixels / 4] = Math.round(128 + 112 * r - 93.786 * g - 18.214 * b);
    }
  }
  return planes;
}

/** The lowest level of VP9 that has room for such a picture. */
function codecFor(pixels: number): string {
  const level = pixels <= 2_228_224 ? "40" : pixels <= 8_912_896 ? "50" : "60";
  return `vp09.00.${level}.08`;
}

/** Pictures of one size as a film. */
export class Recording {
  private readonly target = new ArrayBufferTarget();
  private readonly muxer: Muxer<ArrayBufferTarget>;
  private readonly encoder: VideoEncoder;
  private readonly copy: OffscreenCanvasRenderingContext2D;
  private failure: unknown;
  private pictures = 0;

  private constructor(
    private readonly width: number,
    private readonly height: number,
    config: VideoEncoderConfig,
  ) {
    const copy = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
    if (!copy) throw new Error("This browser cannot read the picture.");
    this.copy = copy;
    this.muxer = new Muxer({ target: this.target, video: { codec: "V_VP9", width, height } });
    this.encoder = new VideoEncoder({
      output: (chunk, about) => {
        const decoderConfig = { codec: config.codec, ...about?.decoderConfig, colorSpace: colours };
        this.muxer.addVideoChunk(chunk, { ...about, decoderConfig });
      },
      error: (error) => {
        this.failure = error;
      },
    });
    this.encoder.configure(config);
  }

  static async begin(canvas: HTMLCanvasElement): Promise<Recording> {
    const width = canvas.width - (canvas.width % 2);
    const height = canvas.height - (canvas.height % 2);
    const config: VideoEncoderConfig = { codec: codecFor(width * height), width, height, bitrate: 12e6 };
    if (typeof VideoEncoder === "undefined" || !(await VideoEncoder.isConfigSupported(config)).supported) {
      throw new Error(
        "This browser writes no films of the format VP9 here. Open the studio over localhost or https, or take espalier render.",
      );
    }
    return new Recording(width, height, config);
  }

  /** The picture as it stands, from a time on; milliseconds. */
  async add(canvas: HTMLCanvasElement, time: number): Promise<void> {
    this.copy.drawImage(canvas, 0, 0);
    const { data } = this.copy.getImageData(0, 0, this.width, this.height);
    const frame = new VideoFrame(planesOf(data, this.width, this.height), {
      format: "I420",
      codedWidth: this.width,
      codedHeight: this.height,
      timestamp: Math.round(1000 * time),
      colorSpace: colours,
    });
    this.encoder.encode(frame, { keyFrame: this.pictures++ % 30 === 0 });
    frame.close();
    while (this.encoder.encodeQueueSize > 4 && !this.failure) await new Promise((done) => setTimeout(done, 5));
    if (this.failure) throw this.failure;
  }

  async end(): Promise<Blob> {
    await this.encoder.flush();
    if (this.failure) throw this.failure;
    this.encoder.close();
    this.muxer.finalize();
    return new Blob([this.target.buffer], { type: "video/webm" });
  }
}

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

  /** Each step lasts as long as playing shows it, and the last one for a while. */
  private async record(): Promise<Blob> {
    this.timeline.pause();
    this.scene.keepSize(true);
    const { canvas } = this.scene;
    const recording = await Recording.begin(canvas);
    const { frames } = this.studio;
    const { last, interval } = this.timeline;
    const told = this.studio.tell("note", "A film is being recorded: it shows all steps once.");
    let time = 0;
    try {
      for (let step = 0; step <= last && this.running; step++, time += interval) {
        await frames.fetch(step);
        frames.look(step);
        await this.limbs.settled();
        this.scene.draw();
        await recording.add(canvas, time);
      }
      this.scene.draw();
      await recording.add(canvas, time + 500);
    } finally {
      this.studio.dismiss(told);
    }
    return recording.end();
  }
}
