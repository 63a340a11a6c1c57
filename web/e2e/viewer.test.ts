// Tests the viewer against the program (same surface from the same coefficients), and as a static page.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, it } from "vitest";
import { encodeBinary } from "../src/binary";
import { factors, nextDegree, startColumn } from "../src/harmonics/legendre";
import { gridFor, startSynthesis, sumTo, type Coefficients } from "../src/harmonics/synthesis";
import { launch, patience, picture, programPath } from "./studio";

const degree = 48;
// The policy of the report's page.
const policy =
  "default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";
let folder = "";
let browser: Browser;
let center: [number, number, number] = [0, 0, 0];
let coefficients: Coefficients = { degree: 0, values: new Float64Array(2) };

const rholm = (...words: string[]) => execFileSync(programPath(), words, { cwd: folder, stdio: "pipe" });

function readCoefficients(): void {
  const said = JSON.parse(readFileSync(join(folder, "c.json"), "utf8")) as {
    center: [number, number, number];
    coefficients: { C: number[][]; S: number[][] };
  };
  const values = new Float64Array(2 * (degree + 1) ** 2);
  const put = (rows: number[][], part: number) =>
    rows.forEach((row, l) => values.set(row, (part * (degree + 1) + l) * (degree + 1)));
  put(said.coefficients.C, 0);
  put(said.coefficients.S, 1);
  center = said.center;
  coefficients = { degree, values };
}

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "rholm-viewer-"));
  rholm("make", "bumpy", "--subdivisions", "5", "-o", "bumpy.ply");
  rholm("analyze", "bumpy.ply", "--degree", String(degree), "-o", "m.h5");
  rholm("convert", "m.h5", "c.json", "--normalization", "orthonormal");
  readCoefficients();
  browser = await launch();
});
afterAll(async () => {
  await browser.close();
  rmSync(folder, { recursive: true, force: true });
});

// Resolves when all changes are drawn.
async function frames(page: Page): Promise<void> {
  for (let k = 0; k < 4; ++k) await page.evaluate(() => new Promise(requestAnimationFrame));
}

// Sums the function in a direction, term by term.
function direct(cut: number, direction: readonly number[]): number {
  const [x = 0, y = 0, z = 0] = direction;
  const column = startColumn(Math.acos(z), degree);
  const phi = Math.atan2(y, x);
  const side = degree + 1;
  let sum = 0;
  for (let l = 0; l <= cut; ++l) {
    if (l > 0) nextDegree(column, factors(l));
    for (let m = 0; m <= l; ++m) {
      const cos = coefficients.values[l * side + m] ?? NaN;
      const sin = coefficients.values[(side + l) * side + m] ?? NaN;
      sum += (column.now[m] ?? NaN) * (cos * Math.cos(m * phi) + sin * Math.sin(m * phi));
    }
  }
  return sum;
}

it.each([0, 1, 7, degree])("degree %i is the surface that the program synthesises", (cut) => {
  rholm("synthesize", "m.h5", "--degree", String(cut), "--subdivisions", "3", "--ascii", "-o", "s.ply");
  const text = readFileSync(join(folder, "s.ply"), "utf8").split("end_header\n");
  const count = Number(/element vertex (\d+)/.exec(text[0] ?? "")?.[1]);
  const lines = (text[1] ?? "").split("\n").slice(0, count);
  expect(lines).toHaveLength(10 * 4 ** 3 + 2);
  for (const line of lines) {
    const from = line.split(" ").slice(0, 3).map((word, k) => Number(word) - (center[k] ?? NaN));
    const r = Math.hypot(...from);
    // Coordinates of the file are in single precision or better.
    expect(Math.abs(direct(cut, from.map((x) => x / r)) - r)).toBeLessThan(1e-6);
  }
});

it("the grid's sums are the direct ones", () => {
  const grid = gridFor(degree);
  const values = sumTo(startSynthesis(coefficients, grid), degree);
  for (const [j, k] of [[0, 0], [17, 200], [100, 3]] as const) {
    const theta = ((j + 0.5) * Math.PI) / grid.rings;
    const phi = (2 * Math.PI * k) / grid.meridians;
    const sin = Math.sin(theta);
    const u = [sin * Math.cos(phi), sin * Math.sin(phi), Math.cos(theta)];
    expect(values[j * grid.meridians + k]).toBeCloseTo(direct(degree, u), 11);
  }
});

it("a page with data and script in it shows the shape, from a file, without a network", async () => {
  const script = readFileSync(fileURLToPath(new URL("../dist/viewer/viewer.js", import.meta.url)), "utf8");
  expect(script).not.toMatch(/<\/script/i);
  const bytes = encodeBinary(
    [{ name: "coefficients", shape: [2, degree + 1, degree + 1], values: coefficients.values }],
    { title: "bumpy.ply", unit: "km", expansion: { degree, function: "radius", center }, tail: { strength: 1 } },
  );
  const data = Buffer.from(bytes).toString("base64");
  const path = join(folder, "page.html");
  writeFileSync(
    path,
    `<!doctype html><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="${policy}"><title>viewer</title><div id="rholm-view"></div>
<script type="application/octet-stream;base64" id="rholm-data">${data}</script>
<script type="module">${script}</script>`,
  );
  const context = await browser.newContext({ viewport: { width: 1100, height: 520 }, offline: true });
  const page = await context.newPage();
  const complaints: string[] = [];
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("console", (message) => {
    if (message.type() === "error") complaints.push(message.text());
  });
  await page.goto(pathToFileURL(path).href);
  const canvas = page.locator("canvas").first();
  await canvas.waitFor();
  await frames(page);
  const before = await canvas.screenshot();
  await page.getByLabel("Degree, exactly").fill("3");
  await page.keyboard.press("Enter");
  const compared = async () => Buffer.compare(before, await canvas.screenshot());
  await expect.poll(compared, { timeout: patience }).not.toBe(0);
  await page.getByLabel("Colours").selectOption("difference");
  await page.locator("figure.legend").waitFor();
  await frames(page);
  await picture(page, "viewer");
  expect(complaints).toEqual([]);
  await context.close();
});
