/** The picture with what belongs to it: colours and their legend, fields, ground, pictures and films. */
import { download, fillSlider, h, iconButton, remember, remembered, setLabel, short, whole } from "./elements.js";
import {
  type Axis,
  mapGradient,
  PlantScene,
  sameVector,
  steer,
  themes,
  triangleCount,
  type Column,
  type Field,
  type FieldLook,
  type Packet,
} from "./view/index.js";
import { at } from "./lists.js";
import type { AuthorView } from "./protocol.js";
import { errorText, type Studio } from "./state.js";
import type { Timeline } from "./timeline.js";
import { menuButton } from "./dialog.js";
import { CloudLook } from "./cloud.js";
import type { Comparison } from "./compare.js";
import { Film } from "./film.js";
import { Hints } from "./hints.js";
import { LimbLook } from "./limbs.js";
import { PictureWords } from "./picture-words.js";
import { largeQuestion } from "./question.js";
import { SunDial } from "./sun-dial.js";

export class Viewport {
  readonly element: HTMLElement;
  readonly scene: PlantScene;
  private readonly canvas = h("canvas", "", {
    "aria-label": "The plant. Arrows turn, + and - zoom, Space and Shift raise and lower, F fits, N and B go from organ to organ.",
    "aria-describedby": "picture-words",
  });
  private readonly colourSelect = h("select", "", { "aria-label": "Colour by" });
  private readonly fieldSelect = h("select", "", { "aria-label": "Field" });
  private readonly fieldTools = h("div", "field-tools", { hidden: true });
  private readonly fieldValue = h("output", "field-value");
  private field: Field | null = null;
  private readonly legend = h("div", "legend", { hidden: true, "aria-live": "polite" });
  private readonly scale = h("div", "scale-note");
  private readonly pin = iconButton("pin", "Pin this growth: it stands beside what you change then", () => this.comparison.toggle());
  private readonly limbs: LimbLook;
  readonly hints: Hints;
  readonly words: PictureWords;
  private colouring = remembered("colouring", "");
  private fieldName = "";
  private askedField = "";
  private fieldIsAsked = false;
  private legendIsField = false;
  private fieldLook: FieldLook = { mode: "slice", axis: 1, at: 0.5 };
  private askedColumn = "";
  private hasAuthorLight = false;
  private hasSky = false;
  private readonly dial = new SunDial();
  private documentPath = "";

  constructor(
    private readonly studio: Studio,
    timeline: Timeline,
    private readonly comparison: Comparison,
    clicked: (module: number | null) => void,
  ) {
    this.scene = new PlantScene(this.canvas);
    this.scene.theme = themes[studio.theme];
    steer(this.scene, { clicked: (x, y) => clicked(this.scene.pick(x, y)) });
    this.hints = new Hints(studio);
    this.words = new PictureWords(studio, this.scene);
    new CloudLook(studio, this.scene, () => this.chooseField(this.fieldName));
    this.canvas.addEventListener("pointerup", () => this.hints.did("turned"));
    this.limbs = new LimbLook(studio, this.scene);
    const film = new Film(this.studio, this.scene, timeline, this.limbs);
    this.buildFieldTools();
    this.element = h(
      "div",
      "viewport",
      {},
      this.canvas,
      h(
        "div",
        "picture-over",
        {},
        this.toolbar(film),
        h("div", "picture-left", {}, largeQuestion(studio), this.limbs.element, comparison.element, this.fieldTools, this.legend),
      ),
      this.dial.element,
      this.scale,
      this.hints.element,
      this.words.element,
    );
    this.scene.drawn = () => this.dial.turn(this.scene.orbit.state.azimuth);
    new ResizeObserver(() => this.scene.resize(this.element.clientWidth, this.element.clientHeight)).observe(this.element);
    this.colourSelect.addEventListener("change", () => this.colourBy(this.colourSelect.value));
    this.fieldSelect.addEventListener("change", () => this.chooseField(this.fieldSelect.value));
    this.listen();
    this.fillColours();
    this.fillFields();
  }

  private listen(): void {
    const { studio } = this;
    studio.on("theme", (theme) => (this.scene.theme = themes[theme]));
    studio.on("pictures", (pictures) => this.scene.setPictures(pictures));
    studio.on("shapes", ({ shapes }) => this.scene.learn(shapes));
    studio.on("shown", (packet) => this.show(packet));
    studio.on("columns", () => this.fillColours());
    studio.on("fields", () => this.fillFields());
    studio.on("column", (column) => this.paint(column));
    studio.on("field", (field) => this.paintField(field));
    studio.on("compared", () => this.compare());
    studio.on("measured", (files) => this.scene.setMeasured(files.map((file) => ({ ...file, relative: !file.has_scale }))));
    studio.on("view", (view) => this.followAuthor(view));
    studio.on("document", (document) => {
      if (document.path !== this.documentPath) this.scene.reframe();
      this.documentPath = document.path;
    });
  }

  private followAuthor(view: AuthorView | null): void {
    const eye = view?.towards_eye ?? null;
    this.hasAuthorLight = Boolean(view?.towards_light ?? view?.background);
    this.scene.setAuthor({
      // Where the file says nothing, the eye stands at 0 0 1.
      towardsEye: sameVector(eye, [0, 0, 1]) ? null : eye,
      towardsLight: view?.towards_light ?? null,
      background: view?.background ?? null,
    });
  }

  private show(packet: Packet): void {
    const sky = this.studio.skyOf(packet);
    this.hasSky = sky !== null;
    this.scene.setSky(sky);
    this.dial.show(this.scene.shownSky);
    this.scene.show(packet);
    this.comparison.show();
    this.scale.textContent = `grid ${short(this.scene.gridCell)} m`;
    this.element.dataset.step = String(packet.step);
    this.element.dataset.growth = String(packet.growth);
    this.element.dataset.triangles = String(triangleCount(packet));
    if (this.colouring && this.colouring !== "order") this.askColumn(packet);
    if (this.fieldName) this.askField();
  }

  /** What is pinned has changed, or how it is looked at. */
  private compare(): void {
    this.pin.setAttribute("aria-pressed", String(this.comparison.pinned !== null));
    this.colourBy(this.colouring);
    this.askedField = "";
    if (this.fieldName) this.askField();
  }

  private toolbar(film: Film): HTMLElement {
    for (const { key, apply } of this.looks) apply(remembered(key, true));
    const look = menuButton(
      iconButton("layers", "What is drawn: ground, shadows, labels, smooth skin", () => undefined),
      () => [
        {
          name: "Smooth skin",
          hint: "limbs as one surface",
          on: this.limbs.isSmooth,
          run: () => this.limbs.setSmooth(!this.limbs.isSmooth),
        },
        ...this.looks
          .filter(({ offered }) => offered?.() ?? true)
          .map(({ name, key, apply }) => ({ name, on: remembered(key, true), run: () => flip(key, apply) })),
      ],
    );
    const pictures = menuButton(
      iconButton("camera", "Picture or film", () => undefined),
      () => [
        { name: "Picture", hint: "PNG, as shown", run: () => void this.snapshot(1) },
        { name: "Picture, twice as large", hint: "PNG, 2x", run: () => void this.snapshot(2) },
        { name: film.running ? "End the film" : "Film of all steps", hint: "WebM", run: () => this.film(film) },
      ],
    );
    return h(
      "div",
      "picture-tools",
      { role: "toolbar", "aria-label": "Picture" },
      h("label", "", {}, h("span", "", {}, "Colour"), this.colourSelect),
      h("label", "field-choice", {}, h("span", "", {}, "Field"), this.fieldSelect),
      h(
        "div",
        "picture-buttons",
        {},
        this.pin,
        iconButton("fit", "Show the whole plant (F)", () => this.scene.fit()),
        iconButton("home", "First view (Home)", () => this.scene.home()),
        look,
        pictures,
      ),
    );
  }

  private film(film: Film): void {
    this.hints.did("shared");
    void film.toggle();
  }

  private async snapshot(scale: number): Promise<void> {
    try {
      const name = this.studio.document?.name ?? "plant";
      download(await this.scene.snapshot(scale * Math.min(window.devicePixelRatio, 2)), `${name}-${this.studio.frames.step}.png`);
    } catch (error) {
      this.studio.tell("error", errorText(error));
    }
  }

  /** What the picture may show besides the plant. */
  private readonly looks: { name: string; key: string; apply: (on: boolean) => void; offered?: () => boolean }[] = [
    { name: "Shadows", key: "shadows", apply: (on) => this.scene.setShadows(on) },
    { name: "Ground", key: "ground", apply: (on) => this.scene.setGround(on) },
    { name: "Labels of the model", key: "labels", apply: (on) => this.scene.setLabels(on) },
    {
      name: "Sun and sky of the scene",
      key: "scene-sky",
      apply: (on) => {
        this.scene.setSkyLight(on);
        this.dial.show(this.scene.shownSky);
      },
      offered: () => this.hasSky,
    },
    {
      name: "Light of the view file",
      key: "author-light",
      apply: (on) => this.scene.setAuthorLight(on),
      offered: () => this.hasAuthorLight,
    },
  ];

  private fillColours(): void {
    const { columns } = this.studio;
    const names = columns.includes("order") ? columns : ["order", ...columns];
    this.colourSelect.replaceChildren(
      h("option", "", { value: "" }, "as modelled"),
      ...names.map((name) => h("option", "", { value: name }, name)),
    );
    if (!["", ...names].includes(this.colouring)) this.colourBy("");
    this.colourSelect.value = this.colouring;
    if (this.colouring && this.studio.frames.shown) this.colourBy(this.colouring);
  }

  private colourBy(name: string): void {
    this.colouring = name;
    remember("colouring", name);
    this.askedColumn = "";
    this.legend.hidden = true;
    const { shown } = this.studio.frames;
    this.comparison.colour(null);
    if (name === "") this.scene.colourBy(null);
    else if (!this.studio.columns.includes(name)) this.paintOrder(shown);
    else if (shown) this.askColumn(shown);
  }

  private paintOrder(packet: Packet | null): void {
    let highest = 1;
    if (packet) for (let i = 4; i < packet.internodes.length; i += 6) highest = Math.max(highest, at(packet.internodes, i) >>> 24);
    this.scene.colourBy("order", [0, highest]);
    this.comparison.colour("order");
    this.drawLegend("order of branching", 0, highest, "");
  }

  private askColumn(packet: Packet): void {
    if (!this.studio.columns.includes(this.colouring)) return this.paintOrder(packet);
    const key = `${packet.growth} ${packet.step} ${this.colouring}`;
    if (key === this.askedColumn) return;
    this.askedColumn = key;
    this.studio.connection
      .request("column", { growth: packet.growth, step: packet.step, name: this.colouring })
      .catch(() => undefined);
  }

  private paint(column: Column): void {
    const { shown } = this.studio.frames;
    if (column.name !== this.colouring || column.step !== shown?.step || column.growth !== shown.growth) return;
    const { data, name, note, range } = this.comparison.column(column);
    this.scene.colourBy(data, range);
    this.drawLegend(name, ...range, note);
  }

  private drawLegend(name: string, lowest: number, highest: number, note: string): void {
    const bar = h("div", "legend-bar");
    bar.style.background = mapGradient();
    this.legend.replaceChildren(
      h("strong", "", {}, name),
      bar,
      h(
        "div",
        "legend-ends",
        {},
        h("span", "", {}, short(lowest)),
        h("span", "", {}, short((lowest + highest) / 2)),
        h("span", "", {}, short(highest)),
      ),
      h("small", "", {}, note),
    );
    this.legend.hidden = false;
    this.legendIsField = false;
  }

  private fillFields(): void {
    const { fields } = this.studio;
    this.fieldSelect.replaceChildren(
      h("option", "", { value: "" }, "no field"),
      ...fields.map(({ name, unit, meaning }) =>
        h("option", "", { value: name, title: meaning }, unit ? `${name} (${unit})` : name),
      ),
    );
    this.fieldSelect.parentElement?.toggleAttribute("hidden", fields.length === 0);
    this.chooseField(fields.some(({ name }) => name === this.fieldName) ? this.fieldName : "");
  }

  private chooseField(name: string): void {
    this.fieldName = name;
    this.fieldSelect.value = name;
    this.fieldTools.hidden = name === "";
    this.askedField = "";
    if (name !== "") {
      this.askField();
      return;
    }
    this.scene.showField(null, this.fieldLook);
    this.field = null;
    if (this.legendIsField) this.colourBy(this.colouring);
  }

  /** That of the step that shows; one request is under way at a time. */
  private askField(): void {
    const { shown } = this.studio.frames;
    if (!shown || this.fieldName === "") return;
    const wanted = `${shown.growth} ${shown.step} ${this.fieldName}`;
    if (this.fieldIsAsked || wanted === this.askedField) return;
    this.askedField = wanted;
    this.fieldIsAsked = true;
    this.studio.connection
      .request("field", { growth: shown.growth, step: shown.step, name: this.fieldName })
      .catch(() => undefined)
      .finally(() => {
        this.fieldIsAsked = false;
        this.askField();
      });
  }

  private paintField(field: Field): void {
    if (`${field.growth} ${field.step} ${field.name}` !== this.askedField) return;
    const { data, name, note, range } = this.comparison.field(field);
    this.field = data;
    this.element.dataset.field = `${field.name} ${field.step}`;
    this.scene.showField(data, this.fieldLook);
    this.showFieldValue();
    const unit = this.studio.fields.find((known) => known.name === field.name)?.unit ?? "";
    this.drawLegend(`${name}${unit ? ` (${unit})` : ""}`, ...range, note || `after step ${whole(field.step)}`);
    this.legendIsField = true;
  }

  private buildFieldTools(): void {
    const kinds: readonly [string, FieldLook["mode"], Axis][] = [
      ["slice across y", "slice", 1],
      ["slice across x", "slice", 0],
      ["slice across z", "slice", 2],
      ["cloud", "cloud", 0],
      ["surface", "surface", 0],
    ];
    const mode = h("select", "", { "aria-label": "Field as" }, ...kinds.map(([name]) => h("option", "", {}, name)));
    const place = h("input", "", { type: "range", min: 0, max: 1, step: 0.005, value: 0.5 });
    const update = () => {
      fillSlider(place);
      const [, kind, axis] = at(kinds, mode.selectedIndex);
      this.fieldLook = { mode: kind, axis, at: Number(place.value) };
      place.hidden = kind === "cloud";
      setLabel(place, kind === "surface" ? "Value on the surface" : "Place of the slice");
      this.scene.lookAtField(this.fieldLook);
      this.showFieldValue();
    };
    mode.addEventListener("change", update);
    place.addEventListener("input", update);
    this.fieldTools.append(mode, place, this.fieldValue);
    fillSlider(place);
    setLabel(place, "Place of the slice");
  }

  /** Where the slice is, or the value on the surface. */
  private showFieldValue(): void {
    const { field } = this;
    const { mode, axis, at } = this.fieldLook;
    const between = (low: number, high: number) => short(low + at * (high - low));
    if (!field || mode === "cloud") this.fieldValue.textContent = "";
    else if (mode === "surface") this.fieldValue.textContent = between(field.lowest, field.highest);
    else this.fieldValue.textContent = `${"xyz"[axis]} = ${between(field.lower[axis], field.upper[axis])} m`;
  }
}

function flip(key: string, apply: (on: boolean) => void): void {
  const on = !remembered(key, true);
  remember(key, on);
  apply(on);
}
