// Selects the surface on the screen and its colours; follows the selected item and its revision.
import { computed, effect, signal, untracked } from "@preact/signals";
import { fail, transport } from "./actions";
import { surfaceOf } from "./binary";
import { dotted, fromSrgb, plain, second, shadePoints, type Range } from "./geometry/colors";
import type { Item, Surface } from "./protocol";
import type { Layout, View } from "./scene/view";
import { boxOf, guessUp, ups, type Up } from "./geometry/up";
import { chooseUp, chosenUp, item, tab } from "./state";
import { getBinary } from "./transport";

export type Coloring = "plain" | "own" | "caps" | "error";
export const coloring = signal<Coloring>("plain");
export const legend = signal<{ range: Range; label: string; unit: string } | null>(null);
export const layout = signal<Layout>("one");
export const shown = signal<{ id: number; revision: number } | null>(null);
export const markOffending = signal(true);
export const up = signal<Up>("z"); // upward axis of the shape on the screen

let view: View | null = null;
export const theView = (): View | null => view;

const cache = new Map<string, Surface>();

// Returns the current surface of an item, or the surface that was read.
export async function surfaceFor(one: Item, original = false): Promise<Surface> {
  const key = `${one.id}/${one.revision}/${original}`;
  const kept = cache.get(key);
  if (kept) return kept;
  const path = `item/${one.id}/surface?revision=${one.revision}${original ? "&original=1" : ""}`;
  const surface = surfaceOf(await getBinary(transport, path));
  cache.set(key, surface);
  // Keeps four surfaces: of two items, the current one and the one that was read.
  for (const old of cache.keys()) if (cache.size > 4) cache.delete(old);
  return surface;
}

let wanted = "";

async function showItem(one: Item | null): Promise<void> {
  const key = one ? `${one.id}/${one.revision}` : "";
  if (key === wanted) return;
  wanted = key;
  if (!one) {
    view?.show("main", null);
    shown.value = null;
    return;
  }
  try {
    const surface = await surfaceFor(one);
    if (wanted !== key || !view) return;
    const fresh = shown.peek()?.id !== one.id;
    view.show("main", surface);
    view.describe(`The shape ${one.name}`);
    legend.value = null;
    if (fresh) {
      coloring.value = naturalColoring(surface);
      if (tab.peek() === "save") hideOther();
      layout.value = "one";
      turnUp(chosenUp(one.name) ?? guessUp(boxOf(surface.positions)));
      view.fit(false);
    }
    repaint();
    shown.value = { id: one.id, revision: one.revision };
  } catch (error) {
    wanted = "";
    fail(error);
  }
}

// The camera stays in place between shapes with the same upward axis.
function turnUp(wanted: Up): void {
  if (wanted === up.peek()) return;
  up.value = wanted;
  view?.setUp(wanted);
}

// Sets the axis by hand; it is remembered for shapes of this name.
export function setUp(wanted: Up): void {
  const one = item.peek();
  if (one) chooseUp(one.name, wanted);
  turnUp(wanted);
  view?.fit(false);
  repaint();
}

function naturalColoring(surface: Surface): Coloring {
  if (surface.labels) return "caps";
  return surface.colors ? "own" : "plain";
}

// Paints the surface's own colours; panels that have errors paint them.
export function repaint(): void {
  const surface = view?.surface("main");
  if (!view || !surface) return;
  const { colors, labels } = surface;
  if (coloring.value === "caps" && labels) {
    view.paintLabels(labels);
  } else if (coloring.value === "own" && colors) {
    view.paintBy("main", (out) => colors.forEach((byte, i) => (out[i] = fromSrgb(byte / 255))));
  } else if (surface.triangles) {
    view.paint("main", plain);
  } else if (surface.normals) {
    const { normals } = surface;
    view.paintBy("main", (out) => shadePoints(normals, ups.indexOf(up.peek()), out));
  } else {
    view.paint("main", dotted);
  }
  markFaces(surface);
}

// Faces are marked only in panels where a centre matters.
const marking = computed(() => markOffending.value && ["figures", "degrees"].includes(tab.value));

// Caps need no centre, so no face of an atlas is marked.
function markFaces(surface: Surface): void {
  view?.mark(marking.value && item.peek()?.kind !== "atlas" ? surface.offending : null);
}

// Shows the surface of the studio again, without previews.
export function restoreSurface(): void {
  const surface = view?.surface("main");
  if (!view || !surface) return;
  const kept = item.peek();
  if (kept && surface !== cache.get(`${kept.id}/${kept.revision}/false`)) {
    wanted = "";
    void showItem(kept);
    return;
  }
  view.move(surface.positions, surface.normals);
  repaint();
}

// Shows a second shape: the selected item's original, or another item.
export async function showOther(one: Item, original: boolean, how: Layout): Promise<void> {
  try {
    const surface = await surfaceFor(one, original);
    view?.show("other", surface);
    view?.paint("other", original ? plain : second);
    arrange(how, otherId !== one.id);
    otherId = one.id;
  } catch (error) {
    fail(error);
  }
}

// Hides the second shape. With `stay`, the camera does not move, since the next shape fills the same space.
export function hideOther(stay = false): void {
  view?.show("other", null);
  otherId = null;
  arrange("one", false, stay);
}

let otherId: number | null = null; // id of the second shape shown

function arrange(how: Layout, another: boolean, stay = false): void {
  const fresh = another || layout.peek() !== how;
  layout.value = how;
  // The other shape is seen through this one; chosen: both can be distinguished.
  view?.arrange(how, how === "over" ? 0.45 : 1);
  if (fresh && !stay) view?.fit();
}

// Paints values of vertices, with a legend.
export function paintValues(values: Float32Array, label: string, range: Range): void {
  view?.paintValues(range, values);
  legend.value = { range, label, unit: item.peek()?.unit ?? "" };
}

export function attach(made: View): void {
  view = made;
  let compared = tab.peek(); // the panel of the comparison
  effect(() => void showItem(item.value));
  effect(() => {
    // A comparison stays for a picture of it, and disappears when another panel is opened.
    if (tab.value === "save" || tab.value === compared) return;
    compared = tab.value;
    if (layout.peek() !== "one") hideOther();
    if (coloring.peek() === "error") coloring.value = "plain";
  });
  effect(() => {
    const surface = view?.surface("main");
    if (marking.value && surface) markFaces(surface);
    else view?.mark(null);
  });
  effect(() => {
    if (coloring.value === "error") return;
    legend.value = null;
    untracked(repaint);
  });
}
