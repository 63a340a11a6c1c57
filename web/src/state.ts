// State of the page: signals that panels read and actions.ts sets.
import { computed, signal } from "@preact/signals";
import { shortNames } from "./format";
import { ups, type Up } from "./geometry/up";
import type { Controls, FilterWindows, Item, Job, State } from "./protocol";

export const tabs = [
  ["figures", "Figures"],
  ["degrees", "Degrees"],
  ["smooth", "Smooth"],
  ["texture", "Texture"],
  ["points", "Points"],
  ["caps", "Caps"],
  ["align", "Align"],
  ["save", "Save"],
] as const;
export type Tab = (typeof tabs)[number][0];

export const studio = signal<State | null>(null);
export const filterWindows = signal<FilterWindows>({ windows: [], default: "" });
export const controls = signal<Controls>({});
export const lost = signal(false);
export const stopped = signal(false); // the program has ended on request
export const tab = signal<Tab>("figures");
export const selected = signal<number | null>(null);
export const busy = signal<string | null>(null); // what the page waits for
export const job = signal<Job | null>(null);
export const notice = signal<{ text: string; bad: boolean } | null>(null);
export const unread = signal<File | null>(null); // a refused file that may be a table with unknown columns
export const helpOpen = signal(false);
export const quitOpen = signal(false); // true while the page asks whether to end the program
export const demo = signal(false); // the shape is the page's own example

export const items = computed<Item[]>(() => studio.value?.items ?? []);
export const item = computed<Item | null>(
  () => items.value.find(({ id }) => id === selected.value) ?? null,
);

// Distinct short names of items.
const mostLetters = 60; // chosen: three lines of the list
export const names = computed<ReadonlyMap<number, string>>(() => {
  const short = shortNames(items.value.map(({ name }) => name), mostLetters);
  return new Map(items.value.map(({ id, name }, i) => [id, short[i] ?? name]));
});
export const nameOf = (one: Item): string => names.value.get(one.id) ?? one.name;

export const working = computed(() => busy.value !== null || job.value?.state === "running");

// Returns the last item with faces except `than`: the other shape of two.
export function otherItem(than: number | null): Item | null {
  return items.value.findLast((one) => one.id !== than && one.faces > 0) ?? null;
}

export type Theme = "auto" | "light" | "dark";
const themeKey = "rholm-theme";
export const theme = signal<Theme>(readTheme());

function readTheme(): Theme {
  const kept = storage()?.getItem(themeKey);
  return kept === "light" || kept === "dark" ? kept : "auto";
}

// Upward axes chosen by hand, by name of shape; only the last ones are kept.
const upKey = "rholm-up";
const mostUps = 200; // chosen
const chosenUps = signal<[name: string, up: Up][]>(readUps());

function readUps(): [string, Up][] {
  try {
    const kept: unknown = JSON.parse(storage()?.getItem(upKey) ?? "[]");
    if (!Array.isArray(kept)) return [];
    const isUp = (one: unknown): one is [string, Up] =>
      Array.isArray(one) && typeof one[0] === "string" && ups.includes(one[1] as Up);
    return kept.filter(isUp);
  } catch {
    return [];
  }
}

export function chosenUp(name: string): Up | undefined {
  return chosenUps.value.find(([one]) => one === name)?.[1];
}

export function chooseUp(name: string, up: Up): void {
  const others = chosenUps.peek().filter(([one]) => one !== name);
  chosenUps.value = [...others, [name, up] as [string, Up]].slice(-mostUps);
  storage()?.setItem(upKey, JSON.stringify(chosenUps.peek()));
}

export function setTheme(wanted: Theme): void {
  theme.value = wanted;
  storage()?.setItem(themeKey, wanted);
  document.documentElement.dataset.theme = wanted;
}

// Returns null if the browser keeps nothing.
function storage(): Storage | null {
  try {
    return window.localStorage;
  } catch {
    return null;
  }
}
