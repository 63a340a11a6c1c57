// Smoothing of the painted region: live while sliders move, kept by a button.
import { computed, effect, signal } from "@preact/signals";
import { step } from "../actions";
import { needArray } from "../binary";
import { liveChannel } from "../live";
import { Option, othersChosen } from "../options";
import { restoreSurface, shown, theView } from "../show";
import { item, tab } from "../state";
import { clearRegion, radius, regions, showWeights, takeBackStroke, transition } from "./brush";

export const actions = [
  ["smooth", "Smooth: remove detail"],
  ["repair", "Repair: remove bumps and dents"],
  ["bridge", "Bridge: continue the rim"],
] as const;
export type Action = (typeof actions)[number][0];

export const action = signal<Action>("smooth");
export const strength = new Option<number>("smooth", "strength");
export const wavelengthShare = new Option<number>("smooth", "wavelength"); // share of the diagonal
export const wavelength = computed(() => wavelengthShare.value * (item.value?.diagonal ?? 1));
export const previewed = signal(false);

// A bridge spans up to half a wavelength, so its wavelength is four radii.
const bridgeRadii = 4;

function fields(): Record<string, unknown> {
  const bridge = action.value === "bridge";
  return {
    item: item.peek()?.id,
    regions: regions.value,
    wavelength: bridge ? Math.max(wavelength.value, bridgeRadii * radius.value) : wavelength.value,
    strength: strength.value,
    fitting: bridge ? "around" : "robust",
    repair: action.value === "repair",
    ...othersChosen("smooth"),
  };
}

const live = liveChannel("smooth", (answer, asked) => {
  if (asked.item !== shown.value?.id) return;
  const indices = needArray(answer, "indices", Uint32Array);
  theView()?.moveSome(indices, needArray(answer, "positions", Float32Array));
  previewed.value = true;
});

// The region fades over a wavelength; a bridge does not need this.
export function followWavelength(): void {
  effect(() => {
    transition.value = action.value === "bridge" ? null : wavelength.value;
  });
}

// Weights depend on the wavelength, not on the strength.
export function preview(since: number, weights = true): void {
  if (regions.value.length === 0 || !item.peek()) return;
  live({ fields: fields(), since });
  if (weights) showWeights(since);
}

// Undoing first removes strokes that are not kept.
export function undoStroke(): boolean {
  if (tab.value !== "smooth" || !takeBackStroke()) return false;
  if (regions.value.length > 0) preview(performance.now());
  else discard();
  return true;
}

export async function keep(): Promise<void> {
  await live.idle();
  if (await step({ op: "smooth", ...fields() }, "Smoothing")) {
    previewed.value = false;
    clearRegion();
  }
}

export function discard(): void {
  live.drop();
  previewed.value = false;
  restoreSurface();
  showWeights(performance.now());
}
