/** The timeline: play, step, scrub, grow on. */
import { h, icon, iconButton, remember, remembered, setIcon } from "./elements.js";
import type { Studio } from "./state.js";

const ahead = 12; // steps fetched before they are played

export class Timeline {
  readonly element: HTMLElement;
  playing = false;
  /** Called when it begins to play. */
  started: () => void = () => undefined;
  private readonly play = iconButton("play", "Play (P)", () => this.toggle());
  private readonly slider = h("input", "scrub", { type: "range", min: 0, max: 0, step: 1, value: 0, "aria-label": "Step" });
  private readonly grown = h("div", "grown");
  private readonly label = h("output", "step-label", { "aria-live": "off" }, "0");
  private readonly rate = h("select", "", { "aria-label": "Steps a second", title: "Steps a second" });
  private readonly more = h("input", "number", { type: "number", min: 1, value: 5, "aria-label": "Steps to grow on by" });
  private readonly stopButton = iconButton("stop", "Stop the growth", () => void this.studio.ask("stop", {}));
  private due = 0;

  constructor(private readonly studio: Studio) {
    const chosen = remembered("rate", 8);
    for (const value of [0.5, 1, 2, 4, 8, 15, 30, 60])
      this.rate.append(h("option", "", { value, selected: value === chosen }, `${value} / s`));
    this.rate.addEventListener("change", () => remember("rate", Number(this.rate.value)));
    this.slider.addEventListener("input", () => this.scrub(Number(this.slider.value)));
    const growOn = h(
      "button",
      "button small",
      { type: "button", title: "Grow on by this many steps", onclick: () => this.growOn() },
      icon("grow"),
      "Grow on",
    );
    this.element = h(
      "div",
      "timeline",
      { role: "region", "aria-label": "Timeline" },
      iconButton("first", "First step", () => this.goTo(0)),
      iconButton("back", "One step back", () => this.goTo(this.step - 1)),
      this.play,
      iconButton("forward", "One step on", () => this.forward()),
      iconButton("last", "Last step: follow the growth", () => this.follow()),
      h("div", "track", {}, this.grown, this.slider),
      this.label,
      this.rate,
      h("span", "grow-on", {}, this.more, growOn),
      this.stopButton,
    );
    studio.on("growth", () => this.show());
    studio.on("shown", () => this.show());
    this.show();
  }

  /** Shows a step at once, or as soon as it is here. */
  goTo(step: number): void {
    this.pause();
    this.scrub(Math.min(this.last, Math.max(0, step)));
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.start();
  }

  start(): void {
    this.playing = true;
    this.started();
    setIcon(this.play, "pause", "Pause (P)");
    if (this.step >= this.last && this.studio.growth?.state !== "growing") this.studio.frames.look(0);
    this.due = performance.now() + this.interval;
    requestAnimationFrame((now) => this.advance(now));
  }

  pause(): void {
    this.playing = false;
    setIcon(this.play, "play", "Play (P)");
  }

  get step(): number {
    return this.studio.frames.step;
  }

  get last(): number {
    return this.studio.frames.lastStep;
  }

  /** Milliseconds that a step shows while playing. */
  get interval(): number {
    return 1000 / Number(this.rate.value);
  }

  private scrub(wanted: number): void {
    const { frames } = this.studio;
    const step = Math.min(wanted, this.last);
    frames.look(wanted >= this.last && this.studio.growth?.state === "growing" ? "last" : step);
    const near: number[] = [];
    for (let k = 1; k <= ahead; k++) near.push(step + k, step - k);
    frames.prefetch(near);
    this.show();
  }

  private follow(): void {
    this.pause();
    this.studio.frames.look("last");
    this.show();
  }

  private forward(): void {
    if (this.step >= this.last) void this.studio.ask("grow", { to: this.last + 1 }).then(() => this.follow());
    else this.goTo(this.step + 1);
  }

  private growOn(): void {
    void this.studio.ask("grow", { to: this.last + Math.max(1, Number(this.more.value)) });
    this.follow();
  }

  /** Shows the next step when its time has come and it is here. */
  private advance(now: number): void {
    if (!this.playing) return;
    const { frames } = this.studio;
    if (now >= this.due) {
      const next = this.step + 1;
      const { last } = this;
      if (next > last && this.studio.growth?.state !== "growing") {
        this.pause();
        return;
      }
      frames.prefetch(Array.from({ length: ahead }, (_, k) => next + k));
      if (next <= last && frames.has(next)) {
        frames.look(next);
        this.due = Math.max(this.due + this.interval, now - 100);
      }
    }
    requestAnimationFrame((later) => this.advance(later));
  }

  private show(): void {
    const { growth } = this.studio;
    const end = Math.max(growth?.last ?? 0, this.last, 1);
    this.slider.max = String(end);
    if (!this.slider.matches(":active")) this.slider.value = String(this.step);
    this.slider.setAttribute("aria-valuetext", `step ${this.step} of ${this.last}`);
    this.grown.style.setProperty("--grown", String(this.last / end));
    this.grown.style.setProperty("--at", String(Math.min(1, this.step / end)));
    this.label.textContent = `${this.step} / ${this.last}`;
    this.stopButton.disabled = growth?.state !== "growing";
  }
}
