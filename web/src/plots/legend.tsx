// The colour scale of values painted on the shape.
import { cssColor, mapColor, type Range } from "../geometry/colors";
import { number, withUnit } from "../format";

const stops = 16; // chosen: gradients between the stops look exact

export function ColorScale({ range, label, unit }: { range: Range; label: string; unit: string }) {
  const at = (k: number) => range.min + ((range.max - range.min) * k) / stops;
  const colors = Array.from({ length: stops + 1 }, (_, k) => cssColor(mapColor(range, at(k))));
  return (
    <figure class="legend" aria-label={`${label}: ${number(range.min)} to ${withUnit(range.max, unit)}`}>
      <figcaption>{label}</figcaption>
      <div style={{ background: `linear-gradient(to right, ${colors.join(", ")})` }} />
      <div class="row">
        <span>{number(range.min)}</span>
        <span>{number((range.min + range.max) / 2)}</span>
        <span>{withUnit(range.max, unit)}</span>
      </div>
    </figure>
  );
}
