/** What is known of a picked organ. */
import type { Editor } from "./editor/editor.js";
import { shortName } from "./editor/editor.js";
import { h, iconButton, short, whole } from "./elements.js";
import { plotOverSteps } from "./plot.js";
import type { Parent, Picked, Place } from "./protocol.js";
import type { Studio } from "./state.js";
import type { Timeline } from "./timeline.js";
import { drawnModules, type Packet, type PlantScene } from "./view/index.js";

export class PickPanel {
  readonly element = h("div", "pick");
  private picked: Picked | null = null;
  private module: number | null = null;
  private growth = -1;
  private step = -1;
  /** The organs of a packet, along the plant. */
  private organs: Uint32Array = new Uint32Array(0);
  private organsOf: Packet | null = null;
  private going = false;

  constructor(
    private readonly studio: Studio,
    private readonly scene: () => PlantScene,
    private readonly editor: Editor,
    private readonly timeline: Timeline,
    private readonly opened: () => void,
    /** Tells those who cannot see the picture. */
    private readonly say: (words: string) => void,
  ) {
    this.empty();
    studio.on("theme", () => {
      if (this.picked) this.draw(this.picked);
    });
    studio.on("shown", ({ growth, step }) => {
      // Numbers of modules belong to one step.
      if (this.module !== null && (growth !== this.growth || step !== this.step)) this.scene().mark(null);
    });
  }

  /** Asks about a module and shows the answer; null forgets it. */
  async pick(module: number | null): Promise<void> {
    const { shown } = this.studio.frames;
    if (module === null || !shown) {
      this.forget();
      return;
    }
    const { growth, step } = shown;
    const picked = await this.studio.ask("pick", { growth, step, module });
    if (!picked || this.studio.frames.shown !== shown) return;
    Object.assign(this, { picked, module, growth, step });
    this.scene().mark(module, picked.siblings ?? []);
    this.editor.mark(picked.places ?? []);
    this.opened();
    this.draw(picked);
  }

  /** To the next organ along the plant, or by -1 to the one before; from the first one if none is picked. */
  async go(by: 1 | -1): Promise<void> {
    const { shown } = this.studio.frames;
    if (!shown || this.going) return;
    if (shown !== this.organsOf) this.organs = drawnModules(shown);
    this.organsOf = shown;
    const { module, organs } = this;
    const behind = module === null ? 0 : organs.findIndex((organ) => organ >= module);
    const next = module === null ? (by > 0 ? 0 : organs.length - 1) : (behind + by + organs.length) % organs.length;
    const organ = organs[next];
    if (organ === undefined) return;
    this.going = true;
    await this.pick(organ);
    this.going = false;
    const { picked } = this;
    if (!picked || this.module !== organ) return;
    const born = picked.born === undefined ? "" : `, born in step ${picked.born}`;
    this.say(`${picked.text}, organ ${whole(next + 1)} of ${whole(organs.length)}${born}, ${picked.plant}`);
  }

  private forget(): void {
    this.picked = null;
    this.module = null;
    this.scene().mark(null);
    this.editor.mark([]);
    this.empty();
  }

  private empty(): void {
    this.element.replaceChildren(
      h("p", "hint", {}, "Click an organ of the plant, or press N, to see what it is, where it comes from and how it has changed."),
    );
  }

  private draw(picked: Picked): void {
    const parts: (HTMLElement | null)[] = [
      h(
        "div",
        "pick-head",
        {},
        h("code", "", {}, picked.text),
        iconButton("back", "Organ before (B)", () => void this.go(-1)),
        iconButton("forward", "Next organ (N)", () => void this.go(1)),
        iconButton("close", "Forget this organ", () => this.forget()),
      ),
      this.facts(picked),
      this.parameters(picked),
      this.day(picked),
      this.history(picked),
      this.places(picked.places),
      this.kin(picked),
    ];
    this.element.replaceChildren(...parts.filter((part) => part !== null));
  }

  private facts(picked: Picked): HTMLElement {
    const rows: [string, Node | string][] = [
      ["Symbol", picked.symbol],
      ["Plant", picked.plant],
    ];
    if (picked.born !== undefined) rows.push(["Born in step", String(picked.born)]);
    if (picked.parent) rows.push(["Parent", this.relative(picked.parent)]);
    if (picked.children !== undefined) rows.push(["Children", String(picked.children)]);
    if (picked.identity !== undefined) rows.push(["Identity", h("code", "", {}, picked.identity)]);
    return h("dl", "facts", {}, ...rows.flatMap(([name, value]) => [h("dt", "", {}, name), h("dd", "", {}, value)]));
  }

  private relative(parent: Parent): HTMLElement {
    const text = parent.text ?? parent.symbol ?? parent.identity;
    const { module } = parent;
    if (module === undefined) return h("span", "", {}, text);
    return h("button", "link", { type: "button", onclick: () => void this.pick(module) }, text);
  }

  private parameters(picked: Picked): HTMLElement | null {
    if (picked.parameters.length === 0) return null;
    return h(
      "section",
      "",
      {},
      h("h3", "", {}, "Parameters"),
      h(
        "dl",
        "facts",
        {},
        ...picked.parameters.flatMap((value, index) => [
          h("dt", "", {}, picked.names[index] || `${index + 1}`),
          h("dd", "", {}, value === null ? "unknown" : short(value)),
        ]),
      ),
    );
  }

  private history(picked: Picked): HTMLElement | null {
    const { history } = picked;
    if (!history || history.steps.length < 2) return null;
    const section = h("section", "history", {}, h("h3", "", {}, "History"));
    const count = Math.max(...history.parameters.map((row) => row.length), 0);
    for (let index = 0; index < Math.min(count, 8); index++) {
      const values = history.parameters.map((row) => row[index] ?? null);
      const name = picked.names[index] || `parameter ${index + 1}`;
      const place = h("div", "small-chart", { role: "img", "aria-label": `${name} over steps` }, h("span", "", {}, name));
      plotOverSteps(place, history.steps, [{ name, values, colour: index }], {
        width: Math.max(180, this.element.clientWidth - 24),
        height: 84,
        small: true,
        step: () => this.step,
        clicked: (step) => this.timeline.goTo(step),
      });
      section.append(place);
    }
    return section;
  }

  /** What processes know of it, hour by hour. */
  private day(picked: Picked): HTMLElement | null {
    const { day } = picked;
    if (!day || day.steps.length < 3) return null;
    const section = h("section", "day", {}, h("h3", "", {}, "Course of the day, in hours"));
    day.names.forEach((name, index) => {
      const unit = day.units[index];
      const label = unit ? `${name}, ${unit}` : name;
      const place = h("div", "small-chart", { role: "img", "aria-label": `${name} by hour` }, h("span", "", {}, label));
      plotOverSteps(place, day.hours, [{ name, values: day.values[index] ?? [], colour: index }], {
        width: Math.max(180, this.element.clientWidth - 24),
        height: 84,
        small: true,
        step: () => day.hours[day.steps.indexOf(this.step)] ?? Number.NaN,
        clicked: (hour) => this.timeline.goTo(day.steps[day.hours.indexOf(hour)] ?? this.step),
      });
      section.append(place);
    });
    return section;
  }

  private places(places: Place[] = []): HTMLElement | null {
    if (places.length === 0) return null;
    return h(
      "section",
      "",
      {},
      h("h3", "", {}, places.length === 1 ? "Made by the production" : "Made by one of the productions"),
      ...places.map((place) =>
        h(
          "button",
          "place",
          {
            type: "button",
            onclick: () => this.editor.goTo(place.file, place.line, place.column),
          },
          h("small", "", {}, `${shortName(place.file)}, line ${place.line}`),
          h("code", "", {}, this.editor.lineOf(place.file, place.line)),
        ),
      ),
    );
  }

  private kin(picked: Picked): HTMLElement | null {
    const count = picked.siblings?.length ?? 0;
    if (count === 0) return null;
    return h("p", "hint", {}, `${whole(count)} ${count === 1 ? "sibling is" : "siblings are"} marked in the picture.`);
  }
}
