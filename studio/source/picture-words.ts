/** What the picture shows, in words, for those who cannot see it. */
import { h, short, whole } from "./elements.js";
import type { Studio } from "./state.js";
import type { PlantScene } from "./view/index.js";

const rest = 700; // milliseconds that a step shows before it is told

export class PictureWords {
  readonly element = h("p", "unseen", { id: "picture-words", role: "status" });
  private timer = 0;

  constructor(
    private readonly studio: Studio,
    private readonly scene: PlantScene,
  ) {
    studio.on("shown", () => {
      clearTimeout(this.timer);
      this.timer = window.setTimeout(() => this.say(this.description()), rest);
    });
  }

  /** Instead of what was said before. */
  say(words: string): void {
    clearTimeout(this.timer);
    this.element.textContent = words;
  }

  private description(): string {
    const { shown, lastStep } = this.studio.frames;
    const { box } = this.scene;
    if (!shown || !box) return "The picture is empty.";
    const organs = shown.groups.reduce((sum, { count }) => sum + count, 0);
    const parts = [
      counted(shown.plants.length, "plant"),
      `${short(Number((box.upper[1] - box.lower[1]).toPrecision(2)))} m tall`,
      counted(shown.internodeCount, "internode"),
      organs > 0 ? counted(organs, "organ") : "",
      `step ${shown.step} of ${lastStep}`,
    ];
    return parts.filter((part) => part !== "").join(", ");
  }
}

function counted(count: number, name: string): string {
  return `${whole(count)} ${name}${count === 1 ? "" : "s"}`;
}
