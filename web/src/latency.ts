// Measures times from an input event to its answer, and to its picture on the screen, by kind.

const kept = 500; // chosen: the last times of a kind, a minute of dragging
const times = new Map<string, number[]>();

// `since`: the time stamp of the input event (on the clock of performance.now()).
export function recordLatency(kind: string, since: number): void {
  const end = performance.now();
  performance.mark(`rholm:${kind}`, { startTime: end, detail: end - since });
  const list = times.get(kind) ?? [];
  list.push(end - since);
  if (list.length > kept) list.shift();
  times.set(kind, list);
}

export interface Latency {
  count: number;
  p50: number; // ms
  p95: number; // ms
}

// Returns the nearest-rank percentile of unsorted times; NaN if there are none.
export function percentile(list: readonly number[], share: number): number {
  const sorted = [...list].sort((a, b) => a - b);
  return sorted[Math.max(0, Math.ceil(share * sorted.length) - 1)] ?? NaN;
}

export function latencies(): Record<string, Latency> {
  const said = [...times].map(([kind, list]): [string, Latency] => [
    kind,
    { count: list.length, p50: percentile(list, 0.5), p95: percentile(list, 0.95) },
  ]);
  return Object.fromEntries(said);
}

declare global {
  interface Window {
    rholmLatency: () => Record<string, Latency>;
  }
}
