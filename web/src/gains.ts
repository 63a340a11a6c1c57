// Gains of low-pass filters, computed by the studio. Results are
// kept, so that a slider that returns to a value does not wait.
import { signal } from "@preact/signals";
import { transport } from "./actions";
import { getJson } from "./transport";

export interface LowPass {
  window: string;
  cutoff: number;
  degree: number; // the last degree of the gains
  parameters: Readonly<Record<string, number>>;
}

const mostKept = 256; // chosen: two megabytes for a thousand degrees
const kept = signal<ReadonlyMap<string, readonly number[]>>(new Map());

function addressOf({ window, cutoff, degree, parameters }: LowPass): string {
  const query = new URLSearchParams({ window, cutoff: String(cutoff), degree: String(degree) });
  for (const [name, value] of Object.entries(parameters)) query.set(name, String(value));
  return `gains?${query.toString()}`;
}

// Returns null until needGains() has loaded the gains.
export function gainsOf(one: LowPass): readonly number[] | null {
  return kept.value.get(addressOf(one)) ?? null;
}

// Loads the gains; rejects if the studio refuses.
export async function needGains(one: LowPass): Promise<void> {
  const address = addressOf(one);
  if (kept.peek().has(address)) return;
  const { gains } = await getJson<{ gains: number[] }>(transport, address);
  kept.value = new Map([...[...kept.peek()].slice(1 - mostKept), [address, gains]]);
}
