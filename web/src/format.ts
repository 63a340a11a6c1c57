// Numbers for people.

// Three significant digits, exponents where that is shorter to read.
export function number(value: number | null | undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(2).replace("e+", "e");
  return String(Number(value.toPrecision(3)));
}

// All digits, in groups of three.
export function count(value: number): string {
  return value.toLocaleString("en").replaceAll(",", "\u202f");
}

export function withUnit(value: number | null | undefined, unit: string): string {
  return unit ? `${number(value)} ${unit}` : number(value);
}

export function bytes(count: number): string {
  const units = ["bytes", "kB", "MB", "GB"];
  let power = 0;
  for (let rest = count; rest >= 1000 && power < units.length - 1; rest /= 1000) power += 1;
  return `${number(count / 1000 ** power)} ${units[power] ?? ""}`;
}

// A position 0 ... 1 of a slider for a value of a logarithmic scale, and back.
export function toLog(value: number, min: number, max: number): number {
  return Math.log(value / min) / Math.log(max / min);
}
export function fromLog(at: number, min: number, max: number): number {
  return min * (max / min) ** at;
}

// The name without its ending.
export function stem(name: string): string {
  return name.replace(/\.[^.]*$/, "") || "shape";
}
