/** Charts over steps, drawn by uPlot in the colours of the theme. */
import uPlot from "uplot";
import { short } from "./elements.js";
import { at } from "./lists.js";

export interface Curve {
  name: string;
  values: (number | null)[];
  dashed?: boolean;
  colour?: number;
  /** What was measured: dots, and no line. */
  dots?: boolean;
}

const colours = ["--chart-1", "--chart-2", "--chart-3", "--chart-4", "--chart-5", "--chart-6"];

function themeColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** A line at the step that is shown. */
function stepMark(step: () => number): uPlot.Plugin {
  return {
    hooks: {
      draw: (plot) => {
        const x = plot.valToPos(step(), "x", true);
        const { ctx, bbox } = plot;
        if (!Number.isFinite(x) || x < bbox.left || x > bbox.left + bbox.width) return;
        ctx.save();
        ctx.strokeStyle = themeColour("--accent");
        ctx.setLineDash([]);
        ctx.lineWidth = 1.5 * devicePixelRatio;
        ctx.beginPath();
        ctx.moveTo(x, bbox.top);
        ctx.lineTo(x, bbox.top + bbox.height);
        ctx.stroke();
        ctx.restore();
      },
    },
  };
}

function axes(small: boolean): uPlot.Axis[] {
  const stroke = themeColour("--text-soft");
  const grid = { stroke: themeColour("--line"), width: 1 };
  const font = "11px system-ui, sans-serif";
  return [
    { stroke, grid, font, ticks: { show: false }, size: small ? 22 : 28 },
    { stroke, grid, font, ticks: { show: false }, size: 48, space: small ? 24 : 36 },
  ];
}

/** Beside each name stands its value under the pointer, and otherwise that of the step that is shown. */
function valueAt(plot: uPlot, steps: number[], curve: number, index: number | null, shown: number): string {
  const at = index ?? steps.indexOf(shown);
  const value = plot.data[curve]?.[at];
  return typeof value === "number" ? short(value) : "–";
}

/** Curves that are the same show both: the later one is drawn in gaps. */
function hides(curves: Curve[], index: number): boolean {
  const { values } = at(curves, index);
  return curves.slice(0, index).some((before) => before.values.length === values.length && before.values.every((value, i) => value === values[i]));
}

export interface PlotOptions {
  width: number;
  height: number;
  small?: boolean;
  /** What the curves run over, instead of steps. */
  along?: string;
  step: () => number;
  clicked: (step: number) => void;
}

export function plotOverSteps(place: HTMLElement, steps: number[], curves: Curve[], options: PlotOptions): uPlot {
  const plot = new uPlot(
    {
      width: options.width,
      height: options.height,
      scales: { x: { time: false } },
      axes: axes(options.small ?? false),
      legend: { show: true },
      cursor: { y: false, drag: { x: false, y: false }, points: { size: 5 } },
      plugins: [stepMark(options.step)],
      series: [
        { label: options.along ?? "step", value: (_, value) => String(value ?? options.step()) },
        ...curves.map((curve, index): uPlot.Series => ({
          label: curve.name,
          stroke: themeColour(at(colours, (curve.colour ?? index) % colours.length)),
          width: curve.dashed ? 1.5 : 2,
          value: (shown, _, series, cursor) => valueAt(shown, steps, series, cursor, options.step()),
          ...(curve.dashed ? { dash: [6, 4] } : hides(curves, index) ? { dash: [10, 10] } : {}),
          points: { show: curve.dots === true || steps.length < 3, ...(curve.dots ? { size: 7 } : {}) },
          ...(curve.dots ? { paths: () => null } : {}),
          spanGaps: true,
        })),
      ],
    },
    [steps, ...curves.map(({ values }) => values)],
    place,
  );
  plot.over.addEventListener("click", () => {
    const index = plot.cursor.idx;
    if (index !== null && index !== undefined) options.clicked(at(steps, index));
  });
  return plot;
}

/** The mark, and the values beside the names, of another step. */
export function showStep(plot: uPlot): void {
  plot.redraw(false);
  if (plot.cursor.idx === null || plot.cursor.idx === undefined) plot.setLegend({ idxs: plot.data.map(() => null) }, false);
}
