// The look of an expansion: its degree, gains of degrees, error; live, and kept when the slider is released.
import { computed, effect, signal } from "@preact/signals";
import { ask, fail, step } from "../actions";
import { arrayOf, needArray, type Binary } from "../binary";
import { isDiverging, rangeOf } from "../geometry/colors";
import { gainsOf, needGains, type LowPass } from "../gains";
import { bandGains, highPass, octaves, sharpen, trimmed } from "../harmonics/bands";
import { latestWins } from "../latest";
import { liveChannel } from "../live";
import type { Fields, FilterWindow, Item } from "../protocol";
import { coloring, paintValues, shown, theView } from "../show";
import { filterWindows, item, notice, tab } from "../state";

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
const chosenWindow = signal<string | null>(null);
export const parameters = signal<Readonly<Record<string, number>>>({}); // given parameters of windows
export const amount = signal(1);
export const bandValues = signal<number[]>([]);
export const tolerance = signal(1e-2); // parts of the mean radius

// Returns the mean radius over the sphere, from the coefficient of degree 0. It does not depend on the shown degrees.
export function meanRadius(one: Item): number {
  return Math.sqrt((one.expansion?.power[0] ?? 0) / (4 * Math.PI));
}

export const top = computed(() => item.value?.expansion?.degree ?? 0);
export const bands = computed(() => octaves(top.value));

export const window = computed<FilterWindow | undefined>(() => {
  const { windows, default: standard } = filterWindows.value;
  return windows.find(({ name }) => name === (chosenWindow.value ?? standard));
});

export function chooseWindow(name: string): void {
  chosenWindow.value = name;
}

// Given parameters of the current window.
const given = computed(() => {
  const own = (window.value?.parameters ?? []).flatMap(({ name }) => {
    const value = parameters.value[name];
    return value === undefined ? [] : [[name, value] as const];
  });
  return Object.fromEntries(own);
});

// True if a given parameter replaces the degree of the filter.
export const degreeIsReplaced = computed(
  () =>
    usesWindow.value &&
    (window.value?.parameters ?? []).some((one) => one.replaces_cutoff && one.name in given.value),
);

export const usesWindow = computed(() => mode.value !== "cut" && mode.value !== "bands");

// The low-pass filter from which gains are made; null if none is needed.
const lowPass = computed<LowPass | null>(() => {
  if (!usesWindow.value || !window.value) return null;
  const at = Math.min(degree.value, top.value);
  const cutoff = mode.value === "high" ? Math.max(1, at) - 1 : at;
  return { window: window.value.name, cutoff, degree: top.value, parameters: given.value };
});

// The wanted look; its gains are null if the series is only cut off. Null while the gains are unknown.
export const wish = computed<{ degree: number; gains: number[] | null } | null>(() => {
  const last = top.value;
  if (mode.value === "cut") return { degree: Math.min(degree.value, last), gains: null };
  if (mode.value === "bands") return trimmed(bandGains(bands.value, bandValues.value, last));
  const low = lowPass.value && gainsOf(lowPass.value);
  if (!low) return null;
  if (mode.value === "high") return trimmed(highPass(low));
  return trimmed(mode.value === "sharpen" ? sharpen(low, amount.value) : low);
});

async function needWish(): Promise<void> {
  const low = lowPass.peek();
  if (low) await needGains(low);
}

// Returns the shown degrees as text: "degree 8 of 32".
export function shownDegree(one: Item): string {
  const all = one.expansion?.degree ?? 0;
  const look = one.id === item.value?.id ? (wish.value ?? one.look) : one.look;
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

// The scale follows the error, because one scale for all degrees would
// show nothing at high ones. It is symmetric if the error has both signs.
function paintError(error: Float32Array): void {
  const range = rangeOf(error);
  const size = Math.max(-range.min, range.max);
  if (isDiverging(range)) paintValues(error, "Error: red is outside the original", { min: -size, max: size });
  else paintValues(error, "Error", range);
}

const shower = latestWins<number>(async (since) => {
  await needWish();
  const one = item.peek();
  const look = wish.peek();
  if (!one?.expansion || !look) return;
  live({ fields: { item: one.id, ...look, error: coloring.peek() === "error" }, since });
}, fail);

export function showLook(since: number): void {
  shower(since);
}

type Look = { degree: number; gains: number[] | null } | null;
const textOf = (look: Look) => JSON.stringify([look?.degree, look?.gains ?? null]);
let sent = ""; // the last look sent; sliders ignore its echo

const keeper = latestWins<null>(async () => {
  await shower.idle();
  await live.idle();
  await needWish();
  const one = item.peek();
  const look = wish.peek();
  if (!one?.expansion || !look || textOf(one.look) === textOf(look)) return;
  sent = textOf(look);
  await step({ op: "look", item: one.id, ...look }, "Keeping");
}, fail);

// Keeps the shown look, as a step.
export function keepLook(): Promise<void> {
  keeper(null);
  return keeper.idle();
}

export function setErrorMap(on: boolean): void {
  coloring.value = on ? "error" : "plain";
  if (on) showLook(performance.now());
}

// Moves the slider to the least degree within the tolerance.
export async function degreeForTolerance(one: Item): Promise<void> {
  const fields = { op: "degree_for", item: one.id, tolerance: tolerance.value * meanRadius(one) };
  const answer = await ask<{ degree: number; met: boolean }>(fields, "Looking for the degree");
  if (!answer) return;
  mode.value = "cut";
  degree.value = answer.degree;
  showLook(performance.now());
  await keepLook();
  if (answer.met) return;
  const text = `Degree ${answer.degree} is not enough for that: expand again, to a higher one.`;
  notice.value = { text, bad: false };
}

let followed = -1;

// Sliders follow the item and its undo steps. A new surface gets its error map, or the newer look of the sliders.
export function followItem(): void {
  effect(() => {
    const one = item.value;
    if (!one?.expansion) return;
    const { look } = one;
    const wished = wish.peek();
    const isWish = wished !== null && textOf(look) === textOf(wished);
    if (one.id === followed && (textOf(look) === sent || isWish)) return;
    followed = one.id;
    sent = textOf(look);
    degree.value = look?.degree ?? one.expansion.degree;
    if (!look?.gains) mode.value = "cut";
  });
  effect(() => {
    if (!shown.value || tab.value !== "degrees") return;
    const wished = wish.peek();
    const ahead = wished === null || textOf(item.peek()?.look ?? null) !== textOf(wished);
    if (coloring.value === "error" || ahead) showLook(performance.now());
  });
}
