/** The line of counts, progress and time left. */
import { h, whole } from "./elements.js";
import type { Growth } from "./protocol.js";
import type { Studio } from "./state.js";
import { secondsLeft, type Moment } from "./time-left.js";
import type { PlantScene } from "./view/index.js";

const names: Record<Growth["state"], string> = {
  growing: "growing",
  asks: "waits",
  done: "grown",
  stopped: "stopped",
  failed: "failed",
};

function duration(seconds: number): string {
  if (seconds < 1) return `${Math.round(seconds * 1000)} ms`;
  if (seconds < 90) return `${seconds.toFixed(seconds < 10 ? 1 : 0)} s`;
  if (seconds < 90 * 60) return `${Math.round(seconds / 60)} min`;
  if (seconds < 48 * 3600) return `${Math.round(seconds / 3600)} hours`;
  return seconds < 365 * 86400 ? `${Math.round(seconds / 86400)} days` : "more than a year";
}

export class StatusLine {
  readonly element = h("footer", "status");
  /** Told as it changes; how far it is and the counts are there to be read. */
  private readonly state = h("span", "state", { role: "status" });
  private readonly progress = h("progress", "", { max: 1, value: 0, hidden: true, "aria-label": "Progress" });
  private readonly counts = h("span", "counts");
  private readonly what = h("span", "what");
  private grown: Moment[] = [];
  private grownOf = -1;

  constructor(
    private readonly studio: Studio,
    private readonly scene: PlantScene,
  ) {
    this.element.append(this.state, this.progress, this.what, this.counts);
    studio.on("growth", (growth) => this.showGrowth(growth));
    studio.on("problems", () => this.showGrowth(studio.growth));
    studio.on("shown", () => this.showCounts());
    studio.on("statistics", () => this.showCounts());
    studio.on("shapes", () => this.showCounts());
    studio.on("limbs", () => this.showCounts());
    studio.on("progress", ({ what, done }) => {
      this.progress.hidden = done >= 1;
      this.progress.value = done;
      this.what.textContent = what;
      if (done >= 1) this.showGrowth(studio.growth);
    });
  }

  private showGrowth(growth: Growth | null): void {
    if (!growth) return;
    const wrong = this.studio.problems.filter(({ severity }) => severity === "error").length;
    const busy = growth.state === "growing";
    this.note(growth);
    const recorded = growth.state === "done" && this.studio.document?.kind === "run";
    const state =
      wrong > 0
        ? `${wrong} ${wrong === 1 ? "error" : "errors"} in the text: the plant before it stays`
        : `${recorded ? "recorded" : names[growth.state]}${growth.reason ? `: ${growth.reason}` : ""}`;
    if (this.state.textContent !== state) this.state.textContent = state;
    this.element.dataset.state = wrong > 0 ? "failed" : growth.state;
    this.progress.hidden = !busy;
    this.progress.value = growth.last > 0 ? Math.max(0, growth.step) / growth.last : 0;
    this.what.textContent = busy ? this.timeLeft(growth) : recorded ? "" : `in ${duration(growth.seconds)}`;
    this.showCounts();
  }

  private note({ growth, step, seconds, modules }: Growth): void {
    if (growth !== this.grownOf) this.grown = [];
    this.grownOf = growth;
    if (step >= 0 && step !== this.grown.at(-1)?.step) this.grown = [...this.grown.slice(-30), { step, seconds, modules }];
  }

  private timeLeft(growth: Growth): string {
    const text = `step ${Math.max(0, growth.step)} of ${growth.last}`;
    const left = growth.seconds < 1 ? null : secondsLeft(this.grown, growth.last);
    return left === null ? text : `${text}, about ${duration(left)} left`;
  }

  /** As the statistics of all plants say; null while they are on their way. */
  private modulesAt(step: number): number | null {
    const { columns, rows } = this.studio.statistics;
    const at = columns.indexOf("modules");
    const own = rows.filter((row) => row[0] === step);
    return at < 0 || own.length === 0 ? null : own.reduce((sum, row) => sum + Number(row[at]), 0);
  }

  private showCounts(): void {
    const packet = this.studio.frames.shown;
    const growth = this.studio.growth;
    if (!packet) return;
    const { vertices, triangles } = this.scene.sizeOf(packet, this.studio.limbs);
    let organs = 0;
    for (const { count } of packet.groups) organs += count;
    const parts = [`${whole(packet.internodeCount)} internodes`];
    const modules = packet.step === growth?.step ? growth.modules : this.modulesAt(packet.step);
    if (modules !== null) parts.unshift(`${whole(modules)} modules`);
    if (organs > 0) parts.push(`${whole(organs)} organs`);
    if (triangles > 0) parts.push(`${whole(vertices)} vertices`, `${whole(triangles)} triangles`);
    this.counts.textContent = parts.join("  ·  ");
  }
}
