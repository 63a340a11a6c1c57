// Formats numbers for display.

// Text for an unknown figure.
export const notKnown = "not known";

function isKnown(value: number | null | undefined): value is number {
  return value !== null && value !== undefined && Number.isFinite(value);
}

// Returns three significant digits, with an exponent where that is shorter to read.
export function number(value: number | null | undefined): string {
  if (!isKnown(value)) return notKnown;
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(2).replace("e+", "e");
  return String(Number(value.toPrecision(3)));
}

// Formats a share of a whole.
export function percent(share: number): string {
  return `${number(100 * share)}\u00a0%`;
}

// Parses a typed number, with a decimal point or comma, or as a percentage of `whole` if given. NaN: no number.
export function typedNumber(typed: string, whole?: number): number {
  const text = typed.trim();
  const share = whole !== undefined && text.endsWith("%");
  const digits = (share ? text.slice(0, -1) : text).trim();
  if (digits === "") return NaN;
  const value = Number(digits.replace(",", "."));
  return share ? (value / 100) * whole : value;
}

// Returns all digits in groups of three.
export function count(value: number): string {
  return value.toLocaleString("en").replaceAll(",", "\u202f");
}

export function withUnit(value: number | null | undefined, unit: string): string {
  return unit && isKnown(value) ? `${number(value)} ${unit}` : number(value);
}

export function bytes(count: number): string {
  const units = ["bytes", "kB", "MB", "GB"];
  let power = 0;
  for (let rest = count; rest >= 1000 && power < units.length - 1; rest /= 1000) power += 1;
  return `${number(count / 1000 ** power)} ${units[power] ?? ""}`;
}

// Scales of a slider. With "linear", values are proportional to places. With "log", equal distances are equal ratios.
// With "root", the value grows with the square of the place, which gives small values more room and includes 0.
export type Scale = "linear" | "log" | "root";

// Return the place 0 ... 1 of a value, and the value at a place.
export function toPlace(scale: Scale, value: number, min: number, max: number): number {
  if (!(max > min)) return 0;
  if (scale === "log") return Math.log(Math.max(value, min) / min) / Math.log(max / min);
  const share = Math.min(1, Math.max(0, (value - min) / (max - min)));
  return scale === "root" ? Math.sqrt(share) : share;
}
export function fromPlace(scale: Scale, at: number, min: number, max: number): number {
  if (scale === "log") return min * (max / min) ** at;
  return min + (max - min) * (scale === "root" ? at * at : at);
}

// Returns the name without its ending.
export function stem(name: string): string {
  return name.replace(/\.[^.]*$/, "") || "shape";
}

// Returns distinct names of at most `most` letters. Long names lose their middle,
// or keep the part around the first different letter. Equal names are numbered.
export function shortNames(names: readonly string[], most: number): string[] {
  const seen = new Map<string, number>();
  const own = names.map((name) => {
    const times = (seen.get(name) ?? 0) + 1;
    seen.set(name, times);
    return times === 1 ? { name, tag: "" } : { name, tag: ` (${times})` };
  });
  const cut = own.map(({ name }) => withoutMiddle(name, most));
  return own.map(({ name, tag }, i) => {
    const like = names.filter((other, k) => other !== name && cut[k] === cut[i]);
    const short = like.length > 0 ? around(name, firstDifference(name, like), most) : cut[i];
    return `${short ?? name}${tag}`;
  });
}

function withoutMiddle(name: string, most: number): string {
  const letters = Array.from(name);
  if (letters.length <= most) return name;
  const end = Math.floor((most - 1) / 2);
  return `${letters.slice(0, most - 1 - end).join("")}…${letters.slice(letters.length - end).join("")}`;
}

function firstDifference(name: string, others: readonly string[]): number {
  const ways = others.map((other) => {
    const same = Array.from(name).findIndex((letter, i) => letter !== Array.from(other)[i]);
    return same < 0 ? Array.from(name).length : same;
  });
  return Math.max(...ways);
}

function around(name: string, at: number, most: number): string {
  const letters = Array.from(name);
  const from = Math.max(0, Math.min(at - Math.floor(most / 4), letters.length - (most - 2)));
  const to = from + most - 2;
  return `${from > 0 ? "…" : ""}${letters.slice(from, to).join("")}${to < letters.length ? "…" : ""}`;
}

// Splits a message into a part shown at once and a rest to expand. Each of several lines shows its first sentence.
const mostAtOnce = 160; // letters; chosen: two lines or three
export function shortened(text: string): { first: string; rest: string } {
  const lines = text.split("\n");
  const short = lines.map((line) => {
    const end = line.length > mostAtOnce ? /[.;](?= )/.exec(line) : null;
    return end ? `${line.slice(0, end.index)}.` : line;
  });
  const first = short.join("\n");
  if (first === text) return { first, rest: "" };
  return { first, rest: lines.length > 1 ? text : text.slice(first.length).trim() };
}
