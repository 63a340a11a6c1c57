// Measures how long people wait in the page, by its own clock (src/latency.ts), and prints a table.
// Times run from an input event to the answer, and to its picture on the screen.
//   RHOLM_PROGRAM the program; needed
//   RHOLM_DATA folder with asteroid-bennu.ply and igea.ply; without it, generated shapes of their size
import { cpus, loadavg } from "node:os";
import { join } from "node:path";
import type { Page, Response } from "playwright-core";
import { afterAll, beforeAll, it } from "vitest";
import { placed } from "../src/geometry/colors";
import type { Latency } from "../src/latency";
import {
  at,
  inFolder,
  moveSlider,
  openTab,
  press,
  ready,
  rholm,
  setNumber,
  settled,
  startStudio,
  stopStudio,
  visit,
  whereIs,
  type Studio,
} from "../e2e/studio";

const data = process.env.RHOLM_DATA;
const moves = 100;
const pause = 250; // ms between two moves, so that each is answered before the next
let studio: Studio;
let page: Page;
let moving = 0; // number of vertices in the last live answer with vertices
const rows: string[] = [];

function shape(name: string, degree: string): string {
  if (data) return join(data, name);
  const made = inFolder(studio, name);
  rholm(studio, "make", "bumpy", "--subdivisions", degree, "--amplitude", "0.3", "-o", made);
  return made;
}

function report(what: string, times: Latency | undefined, target: string): void {
  if (!times) throw new Error(`${what} was not measured`);
  const say = (ms: number) => ms.toFixed(1).padStart(7);
  rows.push(`${what.padEnd(58)}${String(times.count).padStart(5)}${say(times.p50)}${say(times.p95)}  ${target}`);
}

const times = () => page.evaluate(() => window.rholmLatency());

async function open(path: string): Promise<number> {
  const begin = await page.evaluate(() => performance.now());
  await page.locator("nav input[type=file]").setInputFiles(path);
  await settled(page);
  return (await page.evaluate(() => performance.now())) - begin;
}

// Moves a slider like a drag, waits for each answer, and releases it.
async function slide(label: string, values: readonly number[]): Promise<void> {
  const slider = page.getByRole("slider", { name: label, exact: true });
  for (const value of values) {
    await moveSlider(slider, value);
    await page.waitForTimeout(pause);
  }
  await slider.dispatchEvent("change");
  await settled(page);
}

// Reads how many vertices an answer moves, from the head of its bytes.
async function readMoving(response: Response): Promise<void> {
  if (!response.url().endsWith("/api/live") || response.status() !== 200) return;
  const bytes = await response.body().catch(() => null);
  if (!bytes) return;
  const head = JSON.parse(bytes.subarray(12, 12 + bytes.readUInt32LE(8)).toString()) as {
    arrays: { name: string; shape: number[] }[];
  };
  moving = head.arrays.find(({ name }) => name === "indices")?.shape[0] ?? moving;
}

beforeAll(async () => {
  studio = await startStudio();
  ({ page } = await visit(studio));
  await ready(page);
});
afterAll(async () => {
  await stopStudio(studio);
  const machine = `${cpus()[0]?.model ?? ""}, ${cpus().length} processors, load ${(loadavg()[0] ?? 0).toFixed(1)}`;
  const head = `${"ms (software rendering by SwiftShader)".padEnd(58)}${"n".padStart(5)}${"p50".padStart(7)}${"p95".padStart(7)}  target`;
  process.stdout.write(`\n${machine}\n${head}\n${rows.join("\n")}\n`);
});

it("degrees", async () => {
  await open(shape("asteroid-bennu.ply", "6"));
  await openTab(page, "Degrees");
  await setNumber(page, "Up to degree", 180);
  await press(page, "Expand");
  await slide("Degree", [...Array.from({ length: moves }, (_, k) => (37 * k) % 181), 180]);
  const { degree, "degree (answer)": answer } = await times();
  report("degree slider, to the answer (49 000 faces, L 180)", answer, "");
  report("degree slider, to the picture", degree, "50 / 100");
});

it("brush", async () => {
  await openTab(page, "Figures");
  const diagonal = Number(await page.locator(".facts div", { hasText: "Diagonal" }).locator("dd").innerText());
  await openTab(page, "Smooth");
  await setNumber(page, "Brush radius", 0.22 * diagonal);
  page.on("response", (response) => void readMoving(response));
  for (const [x, y] of [[0.5, 0.5], [0.65, 0.6], [0.4, 0.4], [0.6, 0.35]] as const) {
    await page.mouse.click(...(await at(page, x, y)));
    await settled(page);
  }
  await slide("Strength", [1]);
  const before = (await times()).smooth?.count ?? 0;
  await slide("Strength", Array.from({ length: moves }, (_, k) => ((k * 37) % 100) / 50 - 1));
  const { smooth, "smooth (answer)": answer } = await times();
  report(`brush strength, to the answer (${moving} vertices move)`, answer, `(${before} before)`);
  report("brush strength, to the picture", smooth, "30 / 60");
  await press(page, "Clear");
});

it("texture", async () => {
  await openTab(page, "Texture");
  await page.mouse.click(...(await at(page, 0.42, 0.42)));
  await settled(page);
  await page.mouse.click(...(await at(page, 0.58, 0.58)));
  await settled(page);
  const ball = await whereIs(page, placed);
  if (!ball) throw new Error("there is no handle");
  await page.mouse.move(...ball);
  await page.mouse.down();
  for (let k = 0; k < moves; ++k) {
    await page.mouse.move(ball[0] - 20 + (k % 10) * 4, ball[1] - 20 + (k % 7) * 5);
    await page.waitForTimeout(pause);
  }
  await page.mouse.up();
  await settled(page);
  const { transfer, "transfer (answer)": answer } = await times();
  report(`texture handle, to the answer (${moving} vertices move)`, answer, "");
  report("texture handle, to the picture", transfer, "60 / 120");
});

it("a large shape", async () => {
  const path = shape("igea.ply", "7");
  const taken: number[] = [];
  for (let k = 0; k < 5; ++k) taken.push(await open(path));
  taken.sort((a, b) => a - b);
  report("opening 269 000 faces, to the picture", { count: 5, p50: taken[2] ?? NaN, p95: taken[4] ?? NaN }, "2000");
});

it("a million faces turn", async () => {
  rholm(studio, "make", "bumpy", "--subdivisions", "8", "-o", "large.ply");
  await open(inFolder(studio, "large.ply"));
  const frames = await page.locator(".canvas canvas").evaluate(async (canvas) => {
    const gaps: number[] = [];
    let last = performance.now();
    while (gaps.length < 60) {
      canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft", bubbles: true }));
      const now = await new Promise<number>(requestAnimationFrame);
      gaps.push(now - last);
      last = now;
    }
    return gaps.slice(10).sort((a, b) => a - b);
  });
  const middle = frames[Math.floor(frames.length / 2)] ?? NaN;
  const late = frames[Math.floor(0.95 * frames.length)] ?? NaN;
  report("turning 1.3 million faces, from frame to frame", { count: frames.length, p50: middle, p95: late }, "33");
});
