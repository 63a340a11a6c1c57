// Component with a plot of positive values over many powers of ten,
// by uPlot. It is made once for a set of curves, then given data.
import { useEffect, useRef, useState } from "preact/hooks";
import uPlot from "uplot";
import { number } from "../format";

export interface Curve {
  label: string;
  values: (number | null)[];
  color: string;
  dash?: number[];
}

interface ChartProps {
  label: string; // description of the plot for screen readers
  x: number[];
  curves: Curve[];
  xLabel: string;
  yLabel: string;
  logX?: boolean;
  mark?: number | null; // a vertical line at this x
}

const height = 170; // px
// The enum has no values when the script runs.
// eslint-disable-next-line @typescript-eslint/no-unsafe-enum-assignment
const logarithmic = 3 as uPlot.Scale.Distr;

function options(
  props: ChartProps,
  host: HTMLElement,
  mark: () => number | null,
  point: (index: number | null) => void,
): uPlot.Options {
  const style = getComputedStyle(host);
  const ink = style.getPropertyValue("--ink").trim();
  const faint = style.getPropertyValue("--line").trim();
  const axis = { stroke: ink, grid: { stroke: faint, width: 1 }, ticks: { stroke: faint, width: 1 } };
  const line = (plot: uPlot) => {
    const at = mark();
    if (at === null) return;
    const x = Math.round(plot.valToPos(at, "x", true));
    plot.ctx.save();
    plot.ctx.strokeStyle = ink;
    plot.ctx.setLineDash([4, 4]);
    plot.ctx.beginPath();
    plot.ctx.moveTo(x, plot.bbox.top);
    plot.ctx.lineTo(x, plot.bbox.top + plot.bbox.height);
    plot.ctx.stroke();
    plot.ctx.restore();
  };
  return {
    width: host.clientWidth,
    height,
    scales: { x: { time: false, ...(props.logX ? { distr: logarithmic } : {}) }, y: { range: (_, low, high) => powerRange(low, high) } },
    axes: [
      { ...axis, label: props.xLabel, labelSize: 18, size: 34, labelFont: "12px system-ui" },
      {
        ...axis,
        label: props.yLabel,
        labelSize: 18,
        labelFont: "12px system-ui",
        size: 48,
        splits: (_, __, low, high) => powersBetween(low, high),
        values: (_, powers) => powers.map((power) => `1e${power}`),
      },
    ],
    cursor: { y: false },
    legend: { show: false }, // the page has its own; uPlot's has values only at the pointer
    series: [
      {},
      ...props.curves.map((curve) => ({
        label: curve.label,
        stroke: curve.color,
        width: 1.5,
        points: { show: false },
        ...(curve.dash ? { dash: curve.dash } : {}),
      })),
    ],
    hooks: { draw: [line], setCursor: [(plot) => point(plot.cursor.idx ?? null)] },
  };
}

// The vertical scale is linear in the power of ten. uPlot's logarithmic
// scale has no lower end where values are as small as rounding errors.
const decades = 24; // chosen: values further below the largest one are rounding errors
const mostLabels = 9; // chosen: the number that fits

function powersBetween(low: number, high: number): number[] {
  const step = Math.max(1, Math.ceil((high - low) / mostLabels));
  const first = Math.ceil(low / step) * step;
  return Array.from({ length: Math.max(0, Math.floor((high - first) / step) + 1) }, (_, k) => first + k * step);
}

function powerRange(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null) return [0, 1];
  const top = Math.ceil(high);
  return [Math.max(Math.floor(low), top - decades), Math.max(top, Math.floor(low) + 1)];
}

function dataOf({ x, curves }: ChartProps): uPlot.AlignedData {
  const power = (value: number | null) => (value !== null && value > 0 ? Math.log10(value) : null);
  return [x, ...curves.map(({ values }) => values.map(power))];
}

export function Chart(props: ChartProps) {
  const host = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const mark = useRef(props.mark ?? null);
  const [pointed, point] = useState<number | null>(null);
  const shape = props.curves.map(({ label, color }) => label + color).join();
  useEffect(() => {
    const element = host.current;
    if (!element) return undefined;
    const made = new uPlot(
      options(props, element, () => mark.current, point),
      dataOf(props),
      element,
    );
    plot.current = made;
    const watch = new ResizeObserver(() => made.setSize({ width: element.clientWidth, height }));
    watch.observe(element);
    return () => {
      watch.disconnect();
      made.destroy();
      plot.current = null;
    };
  }, [shape]);
  useEffect(() => {
    plot.current?.setData(dataOf(props));
  }, [props.x, props.curves]);
  useEffect(() => {
    mark.current = props.mark ?? null;
    plot.current?.redraw(false);
  }, [props.mark]);
  return (
    <div class="chart">
      <div role="img" aria-label={props.label} ref={host} />
      <ChartLegend {...props} pointed={pointed} />
    </div>
  );
}

function ChartLegend({ x, curves, xLabel, pointed }: ChartProps & { pointed: number | null }) {
  const at = pointed === null ? undefined : x[pointed];
  return (
    <ul class="key">
      {curves.map(({ label, color, dash, values }) => {
        const value = pointed === null ? null : values[pointed];
        return (
          <li key={label}>
            <span class={dash ? "line dashed" : "line"} style={{ borderColor: color }} />
            {label}
            {value !== null && value !== undefined && ` ${number(value)}`}
          </li>
        );
      })}
      <li class="at">{at === undefined ? "" : `${xLabel} ${at}`}</li>
    </ul>
  );
}
