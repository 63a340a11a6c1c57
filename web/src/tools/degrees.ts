// The look of an expansion: its degree, gains of degrees, error; live, and kept when let go.
import { computed, effect, signal } from "@preact/signals";
import { ask, fail, step } from "../actions";
import { arrayOf, needArray, type Binary } from "../binary";
import { isDiverging, rangeOf } from "../geometry/colors";
import {
  bandGains,
  highPass,
  lowPass,
  octaves,
  sharpen,
  trimmed,
  type Window,
} from "../harmonics/windows";
import { latestWins } from "../latest";
import { liveChannel } from "../live";
import type { Fields, Item } from "../protocol";
import { coloring, paintValues, shown, theView } from "../show";
import { item, notice, tab } from "../state";

export const modes = [
  ["cut", "Cut off"],
  ["low", "Low pass"],
  ["high", "High pass"],
  ["sharpen", "Sharpen"],
  ["bands", "Equaliser"],
] as const;
export type Mode = (typeof modes)[number][0];

export const mode = signal<Mode>("cut");
export const degree = signal(0);
export const window = signal<Window>("lanczos");
export const amount = signal(1);
export const bandValues = signal<number[]>([]);
export const tolerance = signal(1e-2); // parts of the mean radius

// The mean radius over the sphere, which is the coefficient of degree 0: it is the same whatever degrees are shown.
export function meanRadius(one: Item): number {
  return Math.sqrt((one.expansion?.power[0] ?? 0) / (4 * Math.PI));
}

export const top = computed(() => item.value?.expansion?.degree ?? 0);
export const bands = computed(() => octaves(top.value));

// What is asked for: null gains where the series is only cut off.
export const wish = computed<{ degree: number; gains: number[] | null }>(() => {
  const last = top.value;
  const at = Math.min(degree.value, last);
  switch (mode.value) {
    case "cut":
      return { degree: at, gains: null };
    case "low":
      return trimmed(lowPass(at, last, window.value));
    case "high":
      return trimmed(highPass(Math.max(1, at), last, window.value));
    case "sharpen":
      return trimmed(sharpen(at, last, window.value, amount.value));
    case "bands":
      return trimmed(bandGains(bands.value, bandValues.value, last));
  }
});

// What of its degrees is on the screen, for people: "degree 8 of 32".
export function shownDegree(one: Item): string {
  const all = one.expansion?.degree ?? 0;
  const look = one.id === item.value?.id ? wish.value : one.look;
  if (look?.gains) return `degree ${all}, filtered`;
  return look && look.degree < all ? `degree ${look.degree} of ${all}` : `degree ${all}`;
}

const live = liveChannel("degree", (answer: Binary, fields: Fields) => {
  if (fields.item !== shown.value?.id) return;
  const positions = needArray(answer, "positions", Float32Array);
  theView()?.move(positions, arrayOf(answer, "normals", Float32Array));
  const error = arrayOf(answer, "error", Float32Array);
  if (error && coloring.value === "error") paintError(error);
});

// One scale for all degrees would show nothing at high ones: it follows the error, symmetric if
// the error has both signs.
function paintError(error: Float32Array): void {
  const range = rangeOf(error);
  const size = Math.max(-range.min, range.max);
  if (isDiverging(range)) paintValues(error, "Error: red is outside the original", { min: -size, max: size });
  else paintValues(error, "Error", range);
}

export function showLook(since: number): void {
  const one = item.peek();
  if (!one?.expansion) return;
  const error = coloring.peek() === "error";
  live({ fields: { item: one.id, ...wish.value, error }, since });
}

type Look = { degree: number; gains: number[] | null } | null;
const textOf = (look: Look) => JSON.stringify([look?.degree, look?.gains ?? null]);
let sent = ""; // the look that was asked for last: sliders do not follow its coming back

const keeper = latestWins<null>(async () => {
  await live.idle();
  const one = item.peek();
  if (!one?.expansion || textOf(one.look) === textOf(wish.value)) return;
  sent = textOf(wish.value);
  await step({ op: "look", item: one.id, ...wish.value }, "Keeping");
}, fail);

// Keeps what is shown, as a step.
export function keepLook(): Promise<void> {
  keeper(null);
  return keeper.idle();
}

export function setErrorMap(on: boolean): void {
  coloring.value = on ? "error" : "plain";
  if (on) showLook(performance.now());
}

// Moves the slider to the degree that keeps the tolerance.
export async function degreeForTolerance(one: Item): Promise<void> {
  const fields = { op: "degree_for", item: one.id, tolerance: tolerance.value * meanRadius(one) };
  const answer = await ask<{ degree: number; met: boolean }>(fields, "Looking for the degree");
  if (!answer) return;
  mode.value = "cut";
  degree.value = answer.degree;
  showLook(performance.now());
  await keepLook();
  if (answer.met) return;
  const text = `Degree ${answer.degree} is not enough for that: analyse again, to a higher one.`;
  notice.value = { text, bad: false };
}

let followed = -1;

// Sliders follow the item and what undo does to it; a new surface
// gets its error map, or what sliders are ahead of it.
export function followItem(): void {
  effect(() => {
    const one = item.value;
    if (!one?.expansion) return;
    const { look } = one;
    if (one.id === followed && (textOf(look) === sent || textOf(look) === textOf(wish.peek()))) return;
    followed = one.id;
    sent = textOf(look);
    degree.value = look?.degree ?? one.expansion.degree;
    if (!look?.gains) mode.value = "cut";
  });
  effect(() => {
    if (!shown.value || tab.value !== "degrees") return;
    const ahead = textOf(item.peek()?.look ?? null) !== textOf(wish.peek());
    if (coloring.value === "error" || ahead) showLook(performance.now());
  });
}
