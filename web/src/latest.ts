// One request in flight, and of those that wait only the latest.

export interface Latest<T> {
  (wish: T): void;
  // When nothing is in flight and nothing waits.
  idle(): Promise<void>;
  // Forgets what waits, and the answer to what is in flight is none of ours: see `current`.
  drop(): void;
}

// `run` works on a wish; `current()` says whether its answer is still wanted. What `run` rejects with
// goes to `fail`.
export function latestWins<T>(
  run: (wish: T, current: () => boolean) => Promise<void>,
  fail: (error: unknown) => void,
): Latest<T> {
  let waiting: { wish: T } | null = null;
  let work: Promise<void> | null = null;
  let era = 0;
  const loop = async () => {
    while (waiting) {
      const { wish } = waiting;
      waiting = null;
      const born = era;
      try {
        await run(wish, () => born === era);
      } catch (error) {
        if (born === era) fail(error);
      }
    }
    work = null;
  };
  const latest = (wish: T) => {
    waiting = { wish };
    work ??= loop();
  };
  return Object.assign(latest, {
    idle: () => work ?? Promise.resolve(),
    drop: () => {
      waiting = null;
      era += 1;
    },
  });
}
