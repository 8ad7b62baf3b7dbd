/** Curves over time that are zoomed by dragging and reset by a double click; all of a record share their cursor. */
import uPlot from "uplot";
import { h } from "./element";
import { inView, MOST_POINTS } from "./in_view";
import type { Samples } from "./protocol";
import type { Autotuned } from "./results";

export interface Curve {
  label: string;
  /** NaN where nothing is known: a gap. */
  values: ArrayLike<number>;
  /** Shown as `scale * value + offset`. */
  scale?: number;
  offset?: number;
  /** A colour of the style sheet: `--readings`, `--model`, `--command`. */
  colour: string;
  points?: boolean;
  /** Held until the next sample. */
  held?: boolean;
}

/** Does one thing at a time, so that the page answers in between. */
let queue: Promise<unknown> = Promise.resolve();
const later = (act: () => void) => (queue = queue.then(() => new Promise((done) => setTimeout(() => done(act())))));

const FONT = "12px system-ui, sans-serif";

// A browser's first canvas waits for fonts and its painter: here before a plot is wanted.
setTimeout(() => {
  const context = document.createElement("canvas").getContext("2d")!;
  context.font = FONT;
  context.fillText("0", 0, 10);
  context.getImageData(0, 0, 1, 1);
});

const style = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export function plot(title: string, time: ArrayLike<number>, curves: Curve[], x: string, y: string, band?: [number, number], key = "record"): HTMLElement {
  const holder = h("figure", { class: "plot", role: "img", "aria-label": `${title}: ${y} over ${x}, ${curves.map((curve) => curve.label).join(", ")}` });
  const draw = () => {
    const axis = (label: string, size: number): uPlot.Axis => ({
      label,
      size,
      space: size > 50 ? 28 : 50,
      stroke: style("--text"),
      font: FONT,
      labelFont: FONT,
      grid: { stroke: style("--grid"), width: 1 },
      ticks: { stroke: style("--grid"), width: 1 },
    });
    const series = curves.map(({ label, colour, points, held, values }): uPlot.Series => {
      const dots = points && values.length <= MOST_POINTS;
      return {
        label,
        stroke: style(colour),
        width: dots ? 0 : values.length > MOST_POINTS ? 1 : 1.5,
        paths: dots ? () => null : held ? uPlot.paths.stepped!({ align: 1 }) : undefined,
        points: dots ? { show: true, size: 4, fill: style(colour), stroke: style(colour) } : { show: false },
        value: (_, value) => (value === null || !Number.isFinite(value) ? "\u2013" : value.toPrecision(5)),
      };
    });
    const options: uPlot.Options = {
      title,
      width: Math.max(holder.clientWidth, 280),
      height: curves.some((curve) => curve.held) ? 150 : 260,
      series: [{ label: x, value: (_, value) => (value === null ? "\u2013" : value.toPrecision(6)) }, ...series],
      axes: [axis(x, 44), axis(y, 56)],
      scales: { x: { time: false } },
      cursor: { sync: { key } },
      bands: band ? [{ series: band, fill: style("--band") }] : undefined,
    };
    const data = (from: number, to: number) => {
      const { kept, whole } = inView(time, curves, from, to, options.width / 2);
      // A band is narrower than the swing within a pixel: it waits until every sample is drawn.
      const hidden = (index: number) => !whole && band?.includes(index + 1);
      const picked = ({ values, scale = 1, offset = 0 }: Curve, index: number) => kept.map((k) => (hidden(index) || Number.isNaN(values[k]!) ? null : scale * values[k]! + offset));
      return [kept.map((k) => time[k]!), ...curves.map(picked)] as uPlot.AlignedData;
    };
    let view = [-Infinity, Infinity];
    const zoomed = (u: uPlot, key: string) => {
      const { min, max } = u.scales[key]!;
      if (key !== "x" || min === undefined || max === undefined || min === null || max === null || time.length <= MOST_POINTS || (view[0] === min && view[1] === max)) return;
      const began = view[0] === -Infinity;
      view = [min, max];
      if (!began) queueMicrotask(() => u.batch(() => (u.setData(data(min, max), false), u.setScale("x", { min, max }))));
    };
    holder.replaceChildren();
    const empty = new uPlot({ ...options, hooks: { setScale: [zoomed] } }, [[], ...curves.map(() => [])], holder);
    later(() => empty.setData(data(-Infinity, Infinity)));
    return empty;
  };
  let drawn: uPlot | null = null;
  let asked = false;
  const fit = new ResizeObserver(() => {
    if (!drawn && !asked) {
      asked = true;
      later(() => (drawn = draw()));
    } else if (drawn && Math.abs(drawn.width - holder.clientWidth) > 2) drawn.setSize({ width: Math.max(holder.clientWidth, 280), height: drawn.height });
  });
  fit.observe(holder);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    drawn?.destroy();
    drawn = draw();
  });
  return holder;
}

/** The answer to a load of the likeliest process, in the band of all processes of the confidence set. */
export function loadStep({ time_s, load_step, load_step_range }: NonNullable<Autotuned["curves"]>): HTMLElement {
  const ends = [0, 1].map((end) => load_step_range.map((range) => range[end as 0 | 1]));
  const curves: Curve[] = [
    { label: "likeliest process", values: load_step, colour: "--model" },
    { label: "largest", values: ends[1]!, colour: "--edge" },
    { label: "least", values: ends[0]!, colour: "--edge" },
  ];
  return plot("Answer to a load of one command unit", time_s, curves, "time (s)", "deviation", [2, 3], "load");
}

const DEGREES = 180 / Math.PI;

/** Record with model and band, residuals, command, of each record. `angle`: the output is in radians and shown in degrees. */
export function records(all: Samples[], names: string[], angle: boolean): HTMLElement[] {
  const scale = angle ? DEGREES : 1;
  const unit = angle ? " (deg)" : "";
  return all.flatMap(({ time_s: time, output, input, model, residual }, index) => {
    const known = residual.filter((value) => !Number.isNaN(value));
    const rms = Math.sqrt(known.reduce((sum, value) => sum + value * value, 0) / Math.max(known.length, 1));
    const shown: Curve[] = [{ label: "readings", values: output, scale, colour: "--readings", points: true }];
    const modelled = known.length > 0;
    if (modelled) {
      shown.push({ label: "model", values: model, scale, colour: "--model" });
      shown.push({ label: "+2 rms", values: model, scale, offset: 2 * rms * scale, colour: "--edge" });
      shown.push({ label: "\u22122 rms", values: model, scale, offset: -2 * rms * scale, colour: "--edge" });
    }
    const key = `record ${index}`;
    const title = names.length > 1 ? (names[index] ?? "") : "Record and model";
    return [
      plot(title, time, shown, "time (s)", `output${unit}`, modelled ? [3, 4] : undefined, key),
      ...(modelled ? [plot("Residuals: readings less model", time, [{ label: "residual", values: residual, scale, colour: "--readings", points: true }], "time (s)", `residual${unit}`, undefined, key)] : []),
      plot("Command", time, [{ label: "command", values: input, colour: "--command", held: true }], "time (s)", "command", undefined, key),
    ];
  });
}
