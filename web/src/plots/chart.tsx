// A plot of uPlot as a component: made once for a set of curves, then given data.
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";

export interface Curve {
  label: string;
  values: (number | null)[];
  color: string;
  dash?: number[];
}

interface ChartProps {
  label: string; // what is shown, for those who do not see it
  x: number[];
  curves: Curve[];
  xLabel: string;
  logX?: boolean;
  mark?: number | null; // a line across at this x
}

const height = 190; // px
// The enum has no values when the script runs.
// eslint-disable-next-line @typescript-eslint/no-unsafe-enum-assignment
const logarithmic = 3 as uPlot.Scale.Distr;

function options(props: ChartProps, host: HTMLElement, mark: () => number | null): uPlot.Options {
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
    scales: { x: { time: false, ...(props.logX ? { distr: logarithmic } : {}) }, y: { distr: logarithmic } },
    axes: [
      { ...axis, label: props.xLabel, labelSize: 18, size: 34, labelFont: "12px system-ui" },
      {
        ...axis,
        grid: { ...axis.grid, filter: powersOnly },
        ticks: { ...axis.ticks, filter: powersOnly },
        size: 58,
        values: (_, ticks) => ticks.map((tick) => powerLabel(tick)),
      },
    ],
    cursor: { y: false },
    series: [
      { label: props.xLabel },
      ...props.curves.map((curve) => ({
        label: curve.label,
        stroke: curve.color,
        width: 1.5,
        points: { show: false },
        value: (_: uPlot, value: number | null) => (value === null ? "–" : value.toExponential(2)),
        ...(curve.dash ? { dash: curve.dash } : {}),
      })),
    ],
    hooks: { draw: [line] },
  };
}

// Only powers of ten have lines and labels.
function powerOf(tick: number | null): number | null {
  if (tick === null || tick <= 0) return null;
  const power = Math.log10(tick);
  return Math.abs(power - Math.round(power)) < 1e-9 ? Math.round(power) : null;
}

function powerLabel(tick: number | null): string {
  const power = powerOf(tick);
  return power === null ? "" : `1e${power}`;
}

function powersOnly(_: uPlot, ticks: number[]): (number | null)[] {
  return ticks.map((tick) => (powerOf(tick) === null ? null : tick));
}

export function Chart(props: ChartProps) {
  const host = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const mark = useRef(props.mark ?? null);
  const shape = props.curves.map(({ label, color }) => label + color).join();
  useEffect(() => {
    const element = host.current;
    if (!element) return undefined;
    const made = new uPlot(
      options(props, element, () => mark.current),
      [props.x, ...props.curves.map(({ values }) => values)],
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
    plot.current?.setData([props.x, ...props.curves.map(({ values }) => values)]);
  }, [props.x, props.curves]);
  useEffect(() => {
    mark.current = props.mark ?? null;
    plot.current?.redraw(false);
  }, [props.mark]);
  return <div class="chart" role="img" aria-label={props.label} ref={host} />;
}
