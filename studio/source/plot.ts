/** Charts over steps, drawn by uPlot in the colours of the theme. */
import uPlot from "uplot";
import { at } from "./lists.js";

export interface Curve {
  name: string;
  values: (number | null)[];
  dashed?: boolean;
  colour?: number;
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

export interface PlotOptions {
  width: number;
  height: number;
  small?: boolean;
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
      legend: { show: curves.length > 1 },
      cursor: { y: false, drag: { x: false, y: false }, points: { size: 5 } },
      plugins: [stepMark(options.step)],
      series: [
        { label: "step" },
        ...curves.map((curve, index): uPlot.Series => ({
          label: curve.name,
          stroke: themeColour(at(colours, (curve.colour ?? index) % colours.length)),
          width: curve.dashed ? 1.5 : 2,
          ...(curve.dashed ? { dash: [6, 4] } : {}),
          points: { show: steps.length < 3 },
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
