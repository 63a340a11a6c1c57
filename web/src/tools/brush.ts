// Region painted on the surface: discs about vertices, with one radius for all.
import { computed, effect, signal } from "@preact/signals";
import { needArray } from "../binary";
import { painted, plain, ringed } from "../geometry/colors";
import { liveChannel } from "../live";
import type { PointerKind, PointerTool } from "../scene/pointer";
import type { Touch } from "../scene/shape";
import { repaint, shown, theView } from "../show";
import { item, tab } from "../state";

export interface Dab {
  vertex: number;
  point: [number, number, number];
}

export const painting = signal(true); // false: the pointer turns the shape
export const dabs = signal<Dab[]>([]);
export const radiusShare = signal(0.06); // share of the diagonal
export const leastRadius = 0.005; // share of the diagonal; chosen
export const mostRadius = 0.5;
export const radius = computed(() => radiusShare.value * (item.value?.diagonal ?? 1));
export const regions = computed(() =>
  dabs.value.map(({ vertex }) => `vertex:${vertex},${Number(radius.value.toPrecision(6))}`),
);

// Width of the region's transition, in the unit; null: half the radius.
export const transition = signal<number | null>(null);

const spacing = 0.35; // share of the radius; chosen: dabs overlap strongly

// Share of the brush's colour at weight 1, during and after painting; chosen: afterwards the surface is visible.
const coverPainting = 0.6;
const cover = 0.3;

let held = false;
let strokes: number[] = []; // number of dabs before each stroke
let cursor: Touch | null = null;

// Shows weights as a blend from stone to the brush's colour.
const weigh = liveChannel("brush", (answer, fields) => {
  if (fields.item !== shown.value?.id) return;
  const indices = needArray(answer, "indices", Uint32Array);
  const weights = needArray(answer, "weights", Float32Array);
  repaint();
  theView()?.paintBy("main", (colors) =>
    indices.forEach((v, i) => {
      const w = (held ? coverPainting : cover) * (weights[i] ?? 0);
      for (let k = 0; k < 3; ++k) {
        colors[3 * v + k] = (1 - w) * (colors[3 * v + k] ?? plain[k] ?? 0) + w * (painted[k] ?? 0);
      }
    }),
  );
});

export function showWeights(since: number): void {
  const one = item.peek();
  if (!one) return;
  if (dabs.value.length === 0) {
    weigh.drop();
    repaint();
    return;
  }
  const points = dabs.value.map(({ vertex }) => vertex);
  const wavelength = transition.value === null ? {} : { wavelength: transition.value };
  weigh({ fields: { item: one.id, points, radius: radius.value, ...wavelength }, since });
}

// Removes the last stroke; returns false if there is none.
export function takeBackStroke(): boolean {
  const last = strokes.pop();
  if (last === undefined || dabs.value.length === 0) return false;
  dabs.value = dabs.value.slice(0, last);
  showWeights(performance.now());
  return true;
}

export function clearRegion(): void {
  dabs.value = [];
  strokes = [];
  showWeights(performance.now());
}

export function setRadius(share: number, since: number): void {
  radiusShare.value = Math.min(mostRadius, Math.max(leastRadius, share));
  showCursor();
  showWeights(since);
}

function showCursor(): void {
  const ring = cursor && { center: cursor.point, normal: cursor.normal, radius: radius.value, color: ringed };
  // One ring shows the brush, the other one its transition.
  const fades = transition.value ?? radius.value / 2;
  theView()?.rings(ring ? [ring, { ...ring, radius: radius.value + fades, color: painted }] : []);
}

function dab(touch: Touch, since: number): void {
  const near = spacing * radius.value;
  const far = (one: Dab) => Math.hypot(...one.point.map((x, k) => x - (touch.point[k] ?? 0)));
  if (dabs.value.some((one) => one.vertex === touch.vertex || far(one) < near)) return;
  dabs.value = [...dabs.value, { vertex: touch.vertex, point: touch.point }];
  showWeights(since);
}

// `strokeEnded` is called when a stroke ends.
export function brushPointer(strokeEnded: () => void): PointerTool {
  return (kind: PointerKind, find: () => Touch | null, event: PointerEvent) => {
    const touch = find();
    cursor = touch;
    showCursor();
    if (kind === "down") {
      held = painting.value && touch !== null;
      if (held) strokes.push(dabs.value.length);
      if (touch && held) dab(touch, event.timeStamp);
      return held;
    }
    if (kind === "move" && held && touch) dab(touch, event.timeStamp);
    if (kind === "up" && held) {
      held = false;
      strokeEnded();
    }
    return false;
  };
}

// Another shape has other vertex numbers, and other tabs do not use the region, so it is removed.
export function forgetWithItem(): void {
  let faces = 0;
  effect(() => {
    const count = item.value?.faces ?? 0;
    if (count !== faces || !["smooth", "texture"].includes(tab.value)) {
      dabs.value = [];
      strokes = [];
    }
    faces = count;
  });
}
