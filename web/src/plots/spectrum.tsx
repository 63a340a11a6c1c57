// Energy per degree, and the tail that method 5 predicts: E_l ~ S / (pi l^4).
import { useMemo } from "preact/hooks";
import { Chart, type Curve } from "./chart";

interface SpectrumProps {
  power: readonly number[];
  tail: { strength: number } | null;
  degree: number | null;
}

const further = 2; // chosen: the tail is drawn up to this multiple of the degree
export const measuredColor = "#2f7fd0";
export const predictedColor = "#d0662f";

// Returns curves from degree 1 on; zeros cannot be shown on a logarithmic scale.
export function spectrumCurves(
  power: readonly number[],
  tail: { strength: number } | null,
): { x: number[]; curves: Curve[] } {
  const top = power.length - 1;
  const last = tail ? further * top : top;
  const x = Array.from({ length: last }, (_, k) => k + 1);
  const positive = (value: number | undefined) => (value !== undefined && value > 0 ? value : null);
  const curves: Curve[] = [
    { label: "measured", color: measuredColor, values: x.map((l) => positive(power[l])) },
  ];
  if (tail) {
    const from = Math.max(1, Math.floor(top / 4)); // chosen: where both curves can be compared
    const law = (l: number) => (l < from ? null : positive(tail.strength / (Math.PI * l ** 4)));
    curves.push({ label: "expected of the mesh's edges", color: predictedColor, dash: [6, 4], values: x.map(law) });
  }
  return { x, curves };
}

export function Spectrum({ power, tail, degree }: SpectrumProps) {
  const { x, curves } = useMemo(() => spectrumCurves(power, tail), [power, tail]);
  if (power.length < 2) return null;
  return (
    <>
      <Chart
        label={`Energy of degrees 1 to ${power.length - 1}`}
        x={x}
        curves={curves}
        xLabel="degree"
        yLabel="energy"
        logX
        mark={degree && degree > 0 ? degree : null}
      />
      {tail && (
        <p class="hint">
          Where the measured energy follows the dashed line, higher degrees show the edges between the faces of the
          mesh, and no more of the shape.
        </p>
      )}
    </>
  );
}
