// Orientation of the view: the axes, and a bar of a known length.
import { number, withUnit } from "../format";
import { roundLength, ups, type Up } from "../geometry/up";

const size = 64; // px
const arm = 22; // px

// Axes that point away from the viewer are drawn first, and fainter.
export function Axes({ axes }: { axes: Record<Up, readonly [number, number, number]> }) {
  const middle = size / 2;
  const order = [...ups].sort((a, b) => axes[a][2] - axes[b][2]);
  return (
    <svg class="axes" width={size} height={size} role="img" aria-label="Axes x, y and z as they are seen">
      {order.map((up) => {
        const [right, high, nearer] = axes[up];
        const at = (far: number) => [middle + far * right, middle - far * high] as const;
        const [x, y] = at(arm);
        const [letterX, letterY] = at(arm + 7);
        return (
          <g key={up} class={up} opacity={nearer < -0.05 ? 0.55 : 1}>
            <line x1={middle} y1={middle} x2={x} y2={y} />
            <text x={letterX} y={letterY}>
              {up}
            </text>
          </g>
        );
      })}
    </svg>
  );
}

const longest = 120; // px

// The scale holds at the distance of the camera's target.
export function ScaleBar({ perPixel, unit }: { perPixel: number; unit: string }) {
  const length = roundLength(longest * perPixel);
  if (length === 0) return null;
  const text = withUnit(length, unit);
  return (
    <div class="scale-bar" role="img" aria-label={`Scale: the bar is ${text} long`} title={`${number(length)} at the middle of the view`}>
      <span>{text}</span>
      <div style={{ width: `${length / perPixel}px` }} />
    </div>
  );
}
