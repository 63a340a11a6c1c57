// Two shapes: aligning one with the other, and blends between them.
import { computed, signal } from "@preact/signals";
import { step } from "../actions";
import { arrayOf, needArray, surfaceOf } from "../binary";
import { liveChannel } from "../live";
import { Option } from "../options";
import type { Item } from "../protocol";
import { restoreSurface, shown, theView } from "../show";
import { item, items, otherItem, selected } from "../state";

export const partnerId = signal<number | null>(null);
export const mirror = new Option<boolean>("align", "mirror");
export const between = new Option<number>("blend", "t");
export const playing = signal(false);
export const previewed = signal(false);

export const partner = computed<Item | null>(
  () =>
    items.value.find(({ id }) => id === partnerId.value && id !== selected.value) ??
    otherItem(selected.value),
);

const live = liveChannel("blend", (answer, asked) => {
  const view = theView();
  if (!view || asked.a !== shown.value?.id) return;
  if (arrayOf(answer, "triangles", Uint32Array)) view.show("main", surfaceOf(answer));
  else {
    const positions = needArray(answer, "positions", Float32Array);
    view.move(positions, arrayOf(answer, "normals", Float32Array));
  }
  previewed.value = true;
});

export function preview(since: number): void {
  const a = item.peek()?.id;
  const b = partner.peek()?.id;
  if (a !== undefined && b !== undefined) live({ fields: { a, b, t: between.value }, since });
}

export async function play(): Promise<void> {
  const seconds = 3; // chosen: a slow motion there and back
  playing.value = true;
  const begin = performance.now();
  for (;;) {
    const now = performance.now();
    const t = (now - begin) / 1000 / seconds;
    if (t >= 2) break;
    between.value = t < 1 ? t : 2 - t;
    preview(now);
    await new Promise((next) => requestAnimationFrame(next));
    await live.idle();
    if (!playing.peek()) break;
  }
  playing.value = false;
}

export function stop(): void {
  playing.value = false;
  live.drop();
  if (previewed.value) restoreSurface();
  previewed.value = false;
}

export async function keep(): Promise<void> {
  playing.value = false;
  await live.idle();
  const fields = { op: "blend", a: item.peek()?.id, b: partner.peek()?.id, t: between.value };
  if (await step(fields, "Blending")) previewed.value = false;
}
