// Tests that memory is released, over many loads of the page and many shapes in one page.
//   RHOLM_LOADS number of loads, 20 by default
import type { CDPSession } from "playwright-core";
import { afterAll, beforeAll, beforeEach, expect, it } from "vitest";
import {
  openFile,
  ready,
  resident,
  rholm,
  settled,
  startStudio,
  stopStudio,
  visit,
  type Studio,
  type Visit,
} from "./studio";

const loads = Number(process.env.RHOLM_LOADS ?? 20);
const first = Math.ceil(loads / 4); // permanent data exist by then
const patience = 180_000 + 9_000 * loads; // ms; chosen, as in vitest.config.ts
const mebibyte = 2 ** 20;
let studio: Studio;
let now: Visit;
let tools: CDPSession;

beforeAll(async () => {
  studio = await startStudio();
  rholm(studio, "make", "torus", "-o", "torus.ply");
});
afterAll(() => stopStudio(studio));
beforeEach(async () => {
  now = await visit(studio);
  await ready(now.page);
  tools = await now.page.context().newCDPSession(now.page);
  return () => now.page.context().close();
});

// Returns the bytes of the page's objects and arrays that are still referenced.
async function held(): Promise<number> {
  await tools.send("HeapProfiler.collectGarbage");
  const usage = await tools.send("Runtime.getHeapUsage");
  return usage.usedSize + usage.backingStorageSize;
}

async function measured(again: () => Promise<void>): Promise<void> {
  let before = { program: 0, page: 0 };
  for (let k = 1; k <= loads; ++k) {
    await again();
    if (k === first) before = { program: resident(studio), page: await held() };
  }
  const after = { program: resident(studio), page: await held() };
  const said = JSON.stringify({ loads, before, after });
  process.stdout.write(`${said}\n`);
  expect(after.program, said).toBeLessThan(before.program + 32 * mebibyte);
  expect(after.page, said).toBeLessThan(before.page + 8 * mebibyte);
}

it("over many loads", async () => {
  await measured(async () => {
    await now.page.reload();
    await ready(now.page);
  });
}, patience);

// Removed shapes can be restored for a hundred steps, so the program keeps them.
it("over many shapes", async () => {
  await measured(async () => {
    await openFile(studio, now.page, "torus.ply");
    await now.page.getByRole("button", { name: "Remove torus.ply" }).click();
    await settled(now.page);
  });
}, patience);
