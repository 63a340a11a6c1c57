// Transfers detail between two places: two discs on the surface, turned and scaled by a handle.
import { computed, effect, signal, untracked } from "@preact/signals";
import { step } from "../actions";
import { arrayOf, needArray, surfaceOf, type Binary } from "../binary";
import { painted, placed } from "../geometry/colors";
import { liveChannel } from "../live";
import { Option, othersChosen } from "../options";
import type { PointerTool } from "../scene/pointer";
import type { Ring } from "../scene/markers";
import type { Touch } from "../scene/shape";
import { repaint, restoreSurface, shown, theView } from "../show";
import { item, tab } from "../state";

interface Disc {
  item: number; // id of the item
  diagonal: number; // diagonal of the item
  vertex: number;
  point: [number, number, number];
  normal: [number, number, number];
}

export type Picking = "from" | "to" | "none";
export const picking = signal<Picking>("from");
export const from = signal<Disc | null>(null);
export const to = signal<Disc | null>(null);
export const radiusShare = signal(0.12); // share of the diagonal, of the source
export const targetShare = signal(0.12); // share of the diagonal, of the target
export const scale = new Option<number>("transfer", "scale");
export const height = new Option<number>("transfer", "height");
export const angle = new Option<number | null>("transfer", "angle"); // null: the angle most similar to existing detail
export const repeat = new Option<boolean>("transfer", "repeat");
export const removeOwn = new Option<boolean>("transfer", "remove_own");
export const refine = new Option<boolean>("transfer", "refine");
export const previewed = signal(false);

export const ready = computed(() => from.value !== null && to.value !== null);

function regionOf(disc: Disc | null, share: number): string[] {
  return disc ? [`vertex:${disc.vertex},${Number((share * disc.diagonal).toPrecision(6))}`] : [];
}

function fields(): Record<string, unknown> {
  return {
    source: from.value?.item,
    target: to.value?.item,
    from: regionOf(from.value, radiusShare.value),
    to: regionOf(to.value, targetShare.value),
    scale: scale.value,
    height: height.value,
    angle: angle.value,
    repeat: repeat.value,
    remove_own: removeOwn.value,
    refine: refine.value,
    ...othersChosen("transfer"),
  };
}

const live = liveChannel("transfer", (answer: Binary, asked) => {
  const view = theView();
  if (!view || asked.target !== shown.value?.id) return;
  if (arrayOf(answer, "triangles", Uint32Array)) {
    view.show("main", surfaceOf(answer));
    repaint();
  } else {
    const indices = needArray(answer, "indices", Uint32Array);
    view.moveSome(indices, needArray(answer, "positions", Float32Array));
  }
  previewed.value = true;
  showRings();
});

// Rings appear together with the texture, in one picture.
export function preview(since: number): void {
  if (ready.value) live({ fields: fields(), since });
  else showRings();
}

function targetRing(disc: Disc): Ring {
  const turn = ((angle.value ?? 0) * Math.PI) / 180;
  const size = targetShare.value * disc.diagonal;
  return { center: disc.point, normal: disc.normal, radius: size, color: placed, handle: turn };
}

// Rings belong to the visible shape.
export function followShape(): void {
  effect(() => {
    if (shown.value && tab.value === "texture") untracked(showRings);
  });
}

export function showRings(): void {
  const rings: Ring[] = [];
  const source = from.value;
  const id = item.peek()?.id;
  if (source?.item === id && source) {
    const size = radiusShare.value * source.diagonal;
    rings.push({ center: source.point, normal: source.normal, radius: size, color: painted });
  }
  if (to.value?.item === id && to.value) rings.push(targetRing(to.value));
  theView()?.rings(rings);
}

const handleReach = 0.3; // share of the ring's radius; chosen: twice the ball
let dragging = false;

// Returns true if the pointer holds the handle, in the target's plane.
function atHandle(event: PointerEvent): boolean {
  if (to.value?.item !== item.peek()?.id || !to.value) return false;
  const ring = targetRing(to.value);
  const at = theView()?.inPlane(ring, event);
  if (!at) return false;
  const turn = ring.handle ?? 0;
  const away = Math.hypot(
    at.distance * Math.cos(at.angle) - ring.radius * Math.cos(turn),
    at.distance * Math.sin(at.angle) - ring.radius * Math.sin(turn),
  );
  return away < handleReach * ring.radius;
}

function dragHandle(event: PointerEvent): void {
  if (!to.value) return;
  const at = theView()?.inPlane(targetRing(to.value), event);
  if (!at) return;
  const before = targetShare.value;
  angle.value = Math.round((at.angle * 180) / Math.PI);
  targetShare.value = Math.min(0.5, Math.max(0.01, at.distance / to.value.diagonal));
  scale.value *= targetShare.value / before;
  preview(event.timeStamp);
}

function pick(touch: Touch, since: number): void {
  const one = item.peek();
  if (!one) return;
  const { vertex, point, normal } = touch;
  const disc = { item: one.id, diagonal: one.diagonal, vertex, point, normal };
  if (picking.value === "from") {
    from.value = disc;
    picking.value = "to";
  } else {
    to.value = disc;
    picking.value = "none";
  }
  preview(since);
}

export const texturePointer: PointerTool = (kind, find, event) => {
  if (kind === "down") {
    dragging = atHandle(event);
    if (dragging) return true;
    const touch = picking.value === "none" ? null : find();
    if (!touch) return false;
    if (previewed.value) restoreSurface();
    pick(touch, event.timeStamp);
    return true;
  }
  if (kind === "move" && dragging) dragHandle(event);
  if (kind === "up") dragging = false;
  return dragging;
};

export async function keep(): Promise<void> {
  await live.idle();
  if (await step({ op: "transfer", ...fields() }, "Laying the texture")) forget();
}

function forget(): void {
  previewed.value = false;
  from.value = to.value = null;
  picking.value = "from";
  theView()?.rings([]);
}

export function discard(): void {
  live.drop();
  if (previewed.value) restoreSurface();
  forget();
}
