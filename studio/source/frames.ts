/** The steps of the present growth: which one is looked at, which packets are at hand, which are on their way. */
import type { Growth } from "./protocol.js";
import type { Studio } from "./state.js";
import type { Packet } from "./view/index.js";

const mostBytes = 400e6;
const mostOnTheWay = 3;

export class Frames {
  /** The step that the user looks at, or "last" to follow the growth. */
  wanted: number | "last" = "last";
  shown: Packet | null = null;
  private cache = new Map<number, Packet>();
  private bytes = 0;
  private growth = -1;
  /** The last step of this growth whose packet came; the counts of the growth may come later. */
  private newest = 0;
  private readonly onTheWay = new Set<number>();
  private queue: number[] = [];
  private readonly waiting = new Map<number, { resolve: (packet: Packet) => void; reject: (why: Error) => void }[]>();
  private looking = false;
  private lookAgain = false;

  constructor(private readonly studio: Studio) {}

  has(step: number): boolean {
    return this.cache.has(step);
  }

  get(step: number): Packet | undefined {
    return this.cache.get(step);
  }

  /** The packets at hand; the same map until another growth begins. */
  get packets(): ReadonlyMap<number, Packet> {
    return this.cache;
  }

  /** The last step that has grown. */
  get lastStep(): number {
    return Math.max(0, this.studio.growth?.step ?? 0, this.newest);
  }

  /** The step of the wanted picture. */
  get step(): number {
    if (this.wanted !== "last") return this.wanted;
    return this.shown && this.shown.growth === this.growth ? Math.max(this.shown.step, 0) : this.lastStep;
  }

  connected(): void {
    this.onTheWay.clear();
    this.looking = false;
    // The server shows the last step to whoever has not asked for another.
    if (this.wanted !== "last") this.tellServer();
  }

  grown(growth: Growth): void {
    if (growth.growth === this.growth) return;
    this.growth = growth.growth;
    this.cache = new Map();
    this.newest = 0;
    this.bytes = 0;
    this.onTheWay.clear();
    this.queue = [];
    for (const step of [...this.waiting.keys()]) this.settle(step, new Error("Another growth has begun."));
  }

  arrived(packet: Packet): void {
    this.onTheWay.delete(packet.step);
    if (packet.growth < this.growth) return;
    if (packet.growth === this.growth) {
      this.newest = Math.max(this.newest, packet.step);
      this.keep(packet);
      this.settle(packet.step, packet);
    }
    if (this.isAskedFor(packet)) this.show(packet);
    this.pump();
  }

  /** Looks at a step: at once if its packet is at hand. */
  look(step: number | "last"): void {
    const known = step === "last" && this.wanted === "last";
    this.wanted = step;
    const at = step === "last" ? this.lastStep : step;
    const packet = this.cache.get(at);
    if (packet) this.show(packet);
    if (!known) this.tellServer();
  }

  /** Fetches steps before they are looked at. */
  prefetch(steps: number[]): void {
    this.queue = steps.filter((step) => !this.cache.has(step) && !this.onTheWay.has(step) && step >= 0 && step <= this.lastStep);
    this.pump();
  }

  /** The packet of a step of the present growth, fetched if need be. */
  fetch(step: number): Promise<Packet> {
    const packet = this.cache.get(step);
    if (packet) return Promise.resolve(packet);
    return new Promise((resolve, reject) => {
      const waiting = this.waiting.get(step) ?? [];
      this.waiting.set(step, [...waiting, { resolve, reject }]);
      if (!this.onTheWay.has(step)) this.ask(step);
    });
  }

  /** Whoever waits for a step gets it, or learns why it does not come. */
  private settle(step: number, result: Packet | Error): void {
    const waiting = this.waiting.get(step) ?? [];
    this.waiting.delete(step);
    for (const { resolve, reject } of waiting) {
      if (result instanceof Error) reject(result);
      else resolve(result);
    }
  }

  private isAskedFor(packet: Packet): boolean {
    const isNew = packet.growth !== this.shown?.growth;
    if (this.wanted === "last") return isNew || packet.step >= (this.shown?.step ?? 0);
    // A growth that ends before the step one looks at shows its end.
    return packet.step === this.wanted || (isNew && this.lastStep < this.wanted);
  }

  private show(packet: Packet): void {
    if (packet === this.shown) return;
    this.shown = packet;
    this.studio.emit("shown", packet);
  }

  private keep(packet: Packet): void {
    this.bytes += packet.bytes - (this.cache.get(packet.step)?.bytes ?? 0);
    this.cache.delete(packet.step);
    this.cache.set(packet.step, packet);
    for (const [step, old] of this.cache) {
      if (this.bytes <= mostBytes) break;
      if (old === this.shown || old === packet) continue;
      this.cache.delete(step);
      this.bytes -= old.bytes;
    }
  }

  private pump(): void {
    while (this.onTheWay.size < mostOnTheWay && this.queue.length > 0) {
      const step = this.queue.shift();
      if (step !== undefined && !this.cache.has(step)) this.ask(step);
    }
  }

  private ask(step: number): void {
    this.onTheWay.add(step);
    this.studio.connection.request("frame", { growth: this.growth, step }).catch((error: unknown) => {
      this.onTheWay.delete(step);
      this.settle(step, error instanceof Error ? error : new Error(String(error)));
    });
  }

  /** One `look` is under way at a time; the newest wish wins. */
  private tellServer(): void {
    if (this.looking) {
      this.lookAgain = true;
      return;
    }
    this.looking = true;
    const at = this.wanted === "last" ? this.lastStep : this.wanted;
    const held = this.cache.has(at) ? { held: this.growth } : {};
    this.studio.connection
      .request("look", { step: this.wanted === "last" ? null : this.wanted, ...held })
      .catch(() => undefined)
      .finally(() => {
        this.looking = false;
        if (!this.lookAgain) return;
        this.lookAgain = false;
        this.tellServer();
      });
  }
}
