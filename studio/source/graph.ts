/** The panel of graphs of components: the graph, and a form of the chosen component. */
import type { Changes } from "./changes.js";
import type { Editor } from "./editor/editor.js";
import { fillSlider, h, iconButton, numberIn } from "./elements.js";
import { graphPicture } from "./graph-picture.js";
import type { ComponentGraph, ComponentKey, ComponentType, GraphComponent, GraphLink, GraphRequest } from "./protocol.js";
import type { Studio } from "./state.js";

/** One change of a graph, whichever it is. */
type GraphEdit = Omit<GraphRequest, "path" | "label" | "transient">;

const linkKinds: GraphLink["kind"][] = ["child", "branch", "leaf"];

function options(select: HTMLSelectElement, names: readonly string[]): HTMLSelectElement {
  select.append(...names.map((name) => h("option", "", { value: name }, name)));
  return select;
}

export class GraphPanel {
  readonly element = h("div", "graph");
  private readonly place = h("div", "graph-place");
  private readonly form = h("div", "graph-form");
  private chosen: string | null = null;
  private shape = "";

  constructor(
    private readonly studio: Studio,
    private readonly changes: Changes,
    private readonly editor: Editor,
    private readonly offer: (offered: boolean) => void,
  ) {
    this.element.append(this.place, this.form);
    studio.on("document", () => this.show());
    studio.on("help", () => {
      this.shape = "";
      this.show();
    });
  }

  private get graph(): ComponentGraph | null {
    return this.studio.document?.graphs?.[0] ?? null;
  }

  private get types(): ComponentType[] {
    return this.studio.help?.components ?? [];
  }

  private show(): void {
    const { graph } = this;
    this.offer(graph !== null);
    if (!graph) return;
    if (!graph.components.some(({ name }) => name === this.chosen)) this.chosen = graph.components[0]?.name ?? null;
    this.drawPicture(graph);
    // A form whose slider is dragged keeps its controls.
    const shape = JSON.stringify([graph.path, this.chosen, graph.components.map(({ name, type }) => [name, type]), graph.links]);
    if (shape === this.shape) this.refresh(graph);
    else this.drawForm(graph);
    this.shape = shape;
  }

  private drawPicture(graph: ComponentGraph): void {
    const focused = document.activeElement?.getAttribute("aria-label");
    this.place.replaceChildren(graphPicture(graph, this.chosen, (name) => this.choose(name)));
    if (focused) this.place.querySelector<SVGElement>(`[aria-label="${CSS.escape(focused)}"]`)?.focus();
  }

  private choose(name: string): void {
    this.chosen = name;
    const { graph } = this;
    const component = graph?.components.find((one) => one.name === name);
    if (graph && component && component.line !== null) this.editor.mark([{ file: graph.path, line: component.line }]);
    this.show();
  }

  private edit(edit: GraphEdit, label: string, lasting = true): void {
    const { graph } = this;
    if (!graph) return;
    const key = edit.edit === "set" ? `graph ${edit.component} ${edit.key}` : `graph ${edit.edit}`;
    this.changes.graph(key, { ...edit, path: graph.path, label }, lasting);
  }

  private drawForm(graph: ComponentGraph): void {
    const component = graph.components.find(({ name }) => name === this.chosen);
    if (!component) {
      this.form.replaceChildren(this.addRow(graph));
      return;
    }
    const type = this.types.find(({ name }) => name === component.type);
    this.form.replaceChildren(
      h(
        "div",
        "pick-head",
        {},
        h("code", "", {}, component.name),
        h(
          "button",
          "button small",
          { type: "button", onclick: () => this.edit({ edit: "remove", component: component.name }, `Remove ${component.name}`) },
          "Remove",
        ),
      ),
      h("p", "hint", {}, `${component.type}: ${type?.summary ?? ""}`),
      ...(type?.keys ?? []).map((key) => this.row(component, key)),
      this.links(graph, component),
      this.addRow(graph),
    );
  }

  private refresh(graph: ComponentGraph): void {
    const values = graph.components.find(({ name }) => name === this.chosen)?.values ?? {};
    for (const input of this.form.querySelectorAll<HTMLInputElement>("input[data-key]")) {
      const key = input.dataset.key ?? "";
      const row = input.closest(".setting");
      row?.classList.toggle("changed", key in values);
      row?.querySelector(".icon-button")?.toggleAttribute("hidden", !(key in values));
      if (input === document.activeElement || input.matches(":active")) continue;
      if (input.type === "range") {
        input.value = values[key] ?? input.dataset.standard ?? "0";
        fillSlider(input);
      } else input.value = values[key] ?? "";
    }
  }

  /** One value: a field, and a slider if it is a number with bounds. Empty means the usual value. */
  private row(component: GraphComponent, key: ComponentKey): HTMLElement {
    const id = `graph-${key.name}`;
    const standard = key.standard === null ? "" : String(key.standard);
    const value = component.values[key.name];
    const isNumber = value === undefined || Number.isFinite(Number(value));
    const plain = isNumber && (key.kind === "number" || key.kind === "whole");
    const send = (text: string | null, lasting: boolean) => {
      const label = `${component.name}: ${key.name} ${text === null ? "as usual" : `= ${text}`}`;
      this.edit({ edit: "set", component: component.name, key: key.name, text }, label, lasting);
    };
    const field = h("input", plain ? "number" : "wide", { type: "text", id, placeholder: standard, "data-key": key.name });
    field.value = value ?? "";
    field.addEventListener("change", () => send((plain ? numberIn(field) : field.value.trim()) || null, true));
    const control = h("div", "control slider", {}, field, h("span", "unit", {}, key.unit));
    if (plain) control.prepend(this.slider(key, value ?? standard, field, send));
    const reset = iconButton("reset", `Back to ${standard || "the usual value"}`, () => send(null, true));
    reset.hidden = value === undefined;
    return h(
      "div",
      `setting${value === undefined ? "" : " changed"}`,
      {},
      h(
        "div",
        "setting-head",
        {},
        h("label", "", { for: id, title: key.summary }, key.name, h("small", "", {}, ` ${key.summary}`)),
        reset,
      ),
      control,
    );
  }

  private slider(
    key: ComponentKey,
    value: string,
    field: HTMLInputElement,
    send: (text: string, lasting: boolean) => void,
  ): HTMLInputElement {
    const usual = Number(key.standard) || 1;
    const lowest = key.lowest !== null && Number.isFinite(key.lowest) ? key.lowest : Math.min(0, 2 * usual);
    const highest =
      key.highest !== null && key.highest < 1e6 ? key.highest : Math.max(lowest + 1, 2 * Math.abs(usual), Number(value) || 0);
    const step = key.kind === "whole" ? 1 : 10 ** Math.floor(Math.log10((highest - lowest) / 150));
    const slider = h("input", "", {
      type: "range",
      min: lowest,
      max: highest,
      step,
      value: Number(value) || 0,
      "aria-label": `${key.name}, slider`,
      "data-key": key.name,
      "data-standard": String(key.standard ?? 0),
    });
    const text = () => String(Number(Number(slider.value).toPrecision(8)));
    fillSlider(slider);
    slider.addEventListener("input", () => {
      fillSlider(slider);
      field.value = text();
      send(text(), false);
    });
    slider.addEventListener("change", () => send(text(), true));
    return slider;
  }

  private links(graph: ComponentGraph, component: GraphComponent): HTMLElement {
    const own = graph.links.filter(({ from, to }) => from === component.name || to === component.name);
    const rows = own.map((link) =>
      h(
        "div",
        "graph-row",
        {},
        h("span", "", {}, `${link.from} – ${link.kind} → ${link.to}`),
        iconButton("close", `Remove this link`, () =>
          this.edit({ edit: "unlink", ...link }, `Unlink ${link.from} and ${link.to}`),
        ),
      ),
    );
    const to = options(
      h("select", "", { "aria-label": "Link to" }),
      graph.components.map(({ name }) => name),
    );
    const kind = options(h("select", "", { "aria-label": "Kind of link" }), linkKinds);
    const add = h(
      "button",
      "button small",
      {
        type: "button",
        onclick: () =>
          this.edit(
            { edit: "link", from: component.name, to: to.value, kind: kind.value as GraphLink["kind"] },
            `Link ${component.name} and ${to.value}`,
          ),
      },
      "Link",
    );
    return h("section", "", {}, h("h3", "", {}, "Links"), ...rows, h("div", "graph-row", {}, kind, to, add));
  }

  private addRow(graph: ComponentGraph): HTMLElement {
    const type = options(
      h("select", "", { "aria-label": "Type of the new component" }),
      this.types.map(({ name }) => name),
    );
    const name = h("input", "", { type: "text", placeholder: "name", "aria-label": "Name of the new component" });
    const add = h(
      "button",
      "button small",
      {
        type: "button",
        onclick: () => {
          const taken = new Set(graph.components.map((component) => component.name));
          let fresh = name.value.trim() || type.value;
          for (let number = 2; taken.has(fresh); number++) fresh = `${name.value.trim() || type.value}${number}`;
          this.edit({ edit: "add", type: type.value, name: fresh, from: this.chosen ?? "" }, `Add ${fresh}`);
          this.chosen = fresh;
        },
      },
      "Add",
    );
    return h(
      "section",
      "",
      {},
      h("h3", "", {}, this.chosen ? `New component below ${this.chosen}` : "New component"),
      h("div", "graph-row", {}, type, name, add),
    );
  }
}
