/** The picture of a graph of components: boxes in layers, from the camera downwards, joined by arrows. */
import { componentSymbols } from "./component-symbols.js";
import { svg } from "./elements.js";
import type { ComponentGraph, GraphLink } from "./protocol.js";

const box = { width: 112, height: 36, across: 14, down: 34 };

interface Spot {
  x: number;
  y: number;
}

/** Each component stands one layer below the lowest of those that link to it; loops are cut where they close. */
function layersOf(graph: ComponentGraph): string[][] {
  const depth = new Map<string, number>();
  const visit = (name: string, at: number, path: ReadonlySet<string>) => {
    if (path.has(name) || (depth.get(name) ?? -1) >= at) return;
    depth.set(name, at);
    for (const { from, to } of graph.links) if (from === name) visit(to, at + 1, new Set([...path, name]));
  };
  // The camera, of which no text tells, links to where the plant begins.
  const own = new Set(graph.components.map(({ name }) => name));
  const reached = new Set(graph.links.filter(({ from }) => own.has(from)).map(({ to }) => to));
  for (const { name } of graph.components) if (!reached.has(name)) visit(name, 0, new Set());
  for (const { from, to } of graph.links) if (!own.has(from)) visit(to, 0, new Set());
  for (const { name } of graph.components) if (!depth.has(name)) visit(name, 0, new Set());
  const layers: string[][] = [];
  for (const { name } of graph.components) (layers[depth.get(name) ?? 0] ??= []).push(name);
  return Array.from(layers, (layer) => layer ?? []);
}

function spotsOf(layers: readonly string[][], width: number): Map<string, Spot> {
  const spots = new Map<string, Spot>();
  layers.forEach((layer, row) => {
    const span = layer.length * (box.width + box.across) - box.across;
    layer.forEach((name, i) =>
      spots.set(name, {
        x: (width - span) / 2 + i * (box.width + box.across),
        y: 6 + row * (box.height + box.down),
      }),
    );
  });
  return spots;
}

function text(content: string, attributes: Record<string, string | number>): SVGElement {
  return svg("text", attributes, content);
}

function arrow(link: GraphLink, spots: ReadonlyMap<string, Spot>): SVGElement | null {
  const [from, to] = [spots.get(link.from), spots.get(link.to)];
  if (!from || !to) return null;
  const [x1, y1, x2, y2] = [from.x + box.width / 2, from.y + box.height, to.x + box.width / 2, to.y];
  const loop = link.from === link.to || y2 <= y1;
  const d = loop
    ? `M${from.x + box.width} ${from.y + box.height / 2}C${from.x + box.width + 26} ${from.y},${to.x + box.width + 26} ${to.y + box.height},${to.x + box.width + 2} ${to.y + box.height / 2}`
    : `M${x1} ${y1}C${x1} ${y1 + 18},${x2} ${y2 - 18},${x2} ${y2 - 3}`;
  return svg(
    "path",
    { d, class: `graph-link ${link.kind}`, "marker-end": "url(#graph-arrow)" },
    svg("title", {}, `${link.from} – ${link.kind} → ${link.to}`),
  );
}

function arrowHead(): SVGElement {
  const marker = svg(
    "marker",
    {
      id: "graph-arrow",
      viewBox: "0 0 8 8",
      refX: 7,
      refY: 4,
      markerWidth: 7,
      markerHeight: 7,
      orient: "auto-start-reverse",
    },
    svg("path", { d: "M0 0L8 4L0 8z", class: "graph-head" }),
  );
  return svg("defs", {}, marker);
}

function symbol(type: string): SVGElement[] {
  const outline = componentSymbols[type];
  return outline ? [svg("path", { d: outline, class: "graph-symbol", transform: `translate(${box.width - 28} 6)` })] : [];
}

export function graphPicture(graph: ComponentGraph, chosen: string | null, choose: (name: string) => void): SVGSVGElement {
  const layers = layersOf(graph);
  const width = Math.max(300, ...layers.map((layer) => layer.length * (box.width + box.across) + 40));
  const height = layers.length * (box.height + box.down) - box.down + 14;
  const spots = spotsOf(layers, width);
  const picture = svg(
    "svg",
    { viewBox: `0 0 ${width} ${height}`, class: "graph-picture", role: "group", "aria-label": "Graph of components" },
    arrowHead(),
  );
  picture.style.minWidth = `${Math.min(width, 900) * 0.8}px`;
  for (const link of graph.links) {
    const drawn = arrow(link, spots);
    if (drawn) picture.append(drawn);
  }
  for (const { name, type } of graph.components) {
    const spot = spots.get(name);
    if (!spot) continue;
    const group = svg(
      "g",
      {
        class: `graph-box${name === chosen ? " chosen" : ""}`,
        transform: `translate(${spot.x} ${spot.y})`,
        tabindex: 0,
        role: "button",
        "aria-label": `${name}, ${type}`,
        "aria-pressed": String(name === chosen),
      },
      svg("rect", { width: box.width, height: box.height, rx: 7 }),
      text(name.length > 12 ? `${name.slice(0, 11)}…` : name, { x: 9, y: 15, class: "graph-name" }),
      text(type, { x: 9, y: 29, class: "graph-type" }),
      ...symbol(type),
    );
    group.addEventListener("click", () => choose(name));
    group.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      choose(name);
    });
    picture.append(group);
  }
  return picture;
}
