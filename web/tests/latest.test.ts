import { describe, expect, it } from "vitest";
import { latestWins } from "../src/latest";

// Returns a run that ends on command.
function stage() {
  const begun: number[] = [];
  const ends: (() => void)[] = [];
  let atOnce = 0;
  let most = 0;
  const run = async (wish: number): Promise<void> => {
    begun.push(wish);
    most = Math.max(most, ++atOnce);
    await new Promise<void>((done) => ends.push(done));
    atOnce -= 1;
  };
  const end = async () => {
    ends.shift()?.();
    await new Promise((done) => setTimeout(done));
  };
  return { begun, run, end, most: () => most };
}

describe("of many wishes", () => {
  it("one is in flight and of those that wait the latest is next", async () => {
    const { begun, run, end, most } = stage();
    const latest = latestWins(run, () => undefined);
    [1, 2, 3, 4].forEach(latest);
    expect(begun).toEqual([1]);
    await end();
    expect(begun).toEqual([1, 4]);
    latest(5);
    await end();
    await end();
    expect(begun).toEqual([1, 4, 5]);
    expect(most()).toBe(1);
  });

  it("idle waits for all of them", async () => {
    const { begun, run, end } = stage();
    const latest = latestWins(run, () => undefined);
    latest(1);
    latest(2);
    let idle = false;
    const waited = latest.idle().then(() => (idle = true));
    await end();
    expect(idle).toBe(false);
    await end();
    await waited;
    expect(begun).toEqual([1, 2]);
    await latest.idle();
  });

  it("a failure is told and the next is worked on", async () => {
    const told: unknown[] = [];
    const done: number[] = [];
    const latest = latestWins<number>(
      async (wish) => {
        await Promise.resolve();
        if (wish === 1) throw new Error("no");
        done.push(wish);
      },
      (error) => told.push(error),
    );
    latest(1);
    latest(2);
    await latest.idle();
    expect(told).toEqual([new Error("no")]);
    expect(done).toEqual([2]);
  });

  it("those before a drop are no longer wanted, in flight or not", async () => {
    const wanted: boolean[] = [];
    const latest = latestWins<number>(
      async (_, current) => {
        await Promise.resolve();
        wanted.push(current());
      },
      () => undefined,
    );
    latest(1);
    latest(2);
    latest.drop();
    await latest.idle();
    expect(wanted).toEqual([false]);
    latest(3);
    await latest.idle();
    expect(wanted).toEqual([false, true]);
  });
});
