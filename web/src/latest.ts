// Runs one request at a time, and keeps only the latest of the waiting ones.

export interface Latest<T> {
  (wish: T): void;
  // Resolves when nothing runs and nothing waits.
  idle(): Promise<void>;
  // Forgets the waiting wish, and marks the answer of the running one as unwanted: see `current`.
  drop(): void;
}

// `run` processes a wish; `current()` returns true if its
// answer is still wanted. `fail` receives the errors of `run`.
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
