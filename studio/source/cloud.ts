/** Shows the attraction points that a tree will colonize, while a slider moves that changes them. */
import { sameBox, sameVector, type Field, type PlantScene } from "./view/index.js";
import type { Studio } from "./state.js";

const stays = 1500; // milliseconds behind the last move

export class CloudLook {
  private before: Field | null = null;
  private sliding = false;
  private asked = "";
  private timer = 0;

  /** `restore` shows what was chosen instead. */
  constructor(
    private readonly studio: Studio,
    private readonly scene: PlantScene,
    private readonly restore: () => void,
  ) {
    studio.on("sliding", (slides) => (slides ? this.begin() : this.end()));
    studio.on("shown", () => this.ask());
    studio.on("field", (field) => this.receive(field));
  }

  private begin(): void {
    clearTimeout(this.timer);
    if (this.sliding) return;
    this.sliding = true;
    this.before = null;
    this.ask();
  }

  private end(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => {
      this.sliding = false;
      this.asked = "";
      delete this.scene.canvas.dataset.cloud;
      this.restore();
    }, stays);
  }

  /** The points before any has been reached. */
  private ask(): void {
    const { shown } = this.studio.frames;
    const name = this.studio.fields.find(({ meaning }) => meaning.startsWith("attraction points"))?.name;
    if (!this.sliding || !shown || name === undefined) return;
    const wanted = `${shown.growth} ${name}`;
    if (wanted === this.asked) return;
    this.asked = wanted;
    this.studio.connection.request("field", { growth: shown.growth, step: 0, name }).catch(() => undefined);
  }

  private receive(field: Field): void {
    if (!this.sliding || field.step !== 0 || `${field.growth} ${field.name}` !== this.asked) return;
    this.before ??= field;
    if (isSame(field, this.before)) return;
    this.scene.canvas.dataset.cloud = String(field.growth);
    this.scene.showField(field, { mode: "cloud", axis: 1, at: 0.5 });
  }
}

function isSame(a: Field, b: Field): boolean {
  return sameVector(a.size, b.size) && sameBox(a, b) && a.values.every((value, index) => value === b.values[index]);
}
