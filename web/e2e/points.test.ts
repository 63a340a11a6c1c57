// Tests surfaces from points, caps, and two shapes.
import { writeFileSync } from "node:fs";
import { afterAll, beforeAll, expect, it } from "vitest";
import { number } from "../src/format";
import {
  bytesOf,
  canvas,
  drag,
  inFolder,
  openFile,
  openForLongJob,
  openTab,
  patience,
  picture,
  pixelsOf,
  press,
  ready,
  rholm,
  saved,
  setNumber,
  settled,
  startLongJob,
  startStudio,
  stopStudio,
  visit,
  warmthAt,
  type Studio,
  type Visit,
} from "./studio";

let studio: Studio;
let now: Visit;

beforeAll(async () => {
  studio = await startStudio();
  rholm(studio, "make", "torus", "-o", "torus.ply");
  rholm(studio, "make", "sample", "torus.ply", "--points", "8000", "--no-normals", "-o", "scan.ply");
  rholm(studio, "make", "bumpy", "--seed", "3", "-o", "rock.ply");
  rholm(studio, "make", "ellipsoid", "-o", "egg.ply");
  now = await visit(studio);
  await ready(now.page);
});
afterAll(async () => {
  await stopStudio(studio);
  expect(now.complaints).toEqual([]);
});

const chosen = () => now.page.locator(".items li.chosen .name").innerText();
async function choose(name: string): Promise<void> {
  await now.page.locator(".items .name", { hasText: name }).first().click();
  await settled(now.page);
}

it("points get normals and become a surface, as by the program", async () => {
  const { page } = now;
  await openFile(studio, page, "scan.ply");
  await openTab(page, "Points");
  await picture(page, "points");
  await press(page, "Compute normals");
  await press(page, "Make a surface");
  expect(await chosen()).toContain("surface");
  await picture(page, "reconstructed");
  rholm(studio, "orient", "scan.ply", "-o", "oriented.ply");
  rholm(studio, "reconstruct", "oriented.ply", "-o", "surface.ply");
  await openTab(page, "Save");
  await page.getByLabel("Format").selectOption("ply");
  const ours = await saved(page, /^Save .*\.ply/);
  expect(Buffer.compare(ours, bytesOf(studio, "surface.ply"))).toBe(0);
});

it("options without a place of their own are those of the program", async () => {
  const { page } = now;
  await choose("scan.ply");
  await openTab(page, "Points");
  await page.getByText("More options", { exact: true }).click();
  await page.getByLabel("Blend").selectOption("spline");
  const least = page.getByLabel("Min component");
  await least.fill("2");
  await least.press("Enter");
  expect(await page.getByRole("alert").innerText()).toContain("Min component is a number from 0 to 1.");
  await least.fill("0.5");
  await least.press("Enter");
  await press(page, "Make a surface");
  await openTab(page, "Save");
  const recipe = await page.locator(".copy pre").first().innerText();
  expect(recipe).toContain("--blend spline --min-component 0.5");
  await openTab(page, "Points");
  await choose("scan.ply");
  await page.getByText("More options", { exact: true }).click();
  await page.getByLabel("Blend").selectOption("smooth");
  await least.fill("");
  await least.press("Enter");
  await choose("surface");
});

it("a surface is simplified", async () => {
  const { page } = now;
  await openTab(page, "Points");
  await setNumber(page, "Faces", 2000);
  await press(page, "Simplify");
  const text = (await page.locator(".items li.chosen small").innerText()).replaceAll(/\D/g, "");
  expect(Number(text)).toBeLessThanOrEqual(2000);
});

it("a shape is compressed to caps, shown in colours", async () => {
  const { page } = now;
  await openFile(studio, page, "torus.ply");
  await openTab(page, "Caps");
  await press(page, "Compress");
  expect(await page.locator(".items li.chosen small").innerText()).toMatch(/caps/);
  // The program reports the same for the same file.
  const said = await page.getByRole("tabpanel").innerText();
  await openTab(page, "Save");
  await page.getByLabel("Format").selectOption("h5");
  writeFileSync(inFolder(studio, "caps.h5"), await saved(page, /^Save .*\.h5/));
  await openTab(page, "Caps");
  const { errors } = JSON.parse(rholm(studio, "info", "caps.h5", "--json")) as { errors: Record<string, number> };
  for (const kind of ["rms", "max"]) {
    expect(said).toContain(number(Math.max(errors[`${kind}_from_shape`] ?? NaN, errors[`${kind}_to_shape`] ?? NaN)));
  }
  const colored = await canvas(page);
  await picture(page, "caps");
  await openTab(page, "Degrees");
  await page.getByText("Each of these caps has degrees of its own").waitFor();
  await press(page, "Go to Caps");
  await page.getByLabel("A colour for each cap").uncheck();
  await settled(page);
  expect(Buffer.compare(colored, await canvas(page))).not.toBe(0);
});

it("a job is cancelled and leaves nothing", async () => {
  const { page } = now;
  await openForLongJob(studio, page);
  const before = await page.locator(".items li").count();
  await startLongJob(page);
  await picture(page, "progress");
  await press(page, "Cancel");
  expect(await page.locator(".items li").count()).toBe(before);
});

it("of two shapes one is turned onto the other, and what lies between is shown", async () => {
  const { page } = now;
  await openFile(studio, page, "egg.ply");
  await openTab(page, "Degrees");
  await press(page, "Expand");
  await openFile(studio, page, "rock.ply");
  await openTab(page, "Degrees");
  await press(page, "Expand");
  await openTab(page, "Align");
  await page.getByLabel("Onto").selectOption({ label: "egg.ply" });
  await settled(page);
  await picture(page, "two-shapes");
  await press(page, "Align");
  expect(await page.getByRole("alert").count()).toBe(0);
  await page.getByText(/urned by [\d.]+ degrees onto egg\.ply: radii differ by /).waitFor();
  const before = await canvas(page);
  await openTab(page, "Save");
  await settled(page);
  expect(Buffer.compare(before, await canvas(page))).toBe(0);
  await openTab(page, "Degrees");
  await settled(page);
  expect(Buffer.compare(before, await canvas(page))).not.toBe(0);
  await openTab(page, "Align");
  await settled(page);
  await drag(page, "Blend towards the other", [0.2, 0.5]);
  expect(Buffer.compare(before, await canvas(page))).not.toBe(0);
  // The blend is larger than the first shape, and in view like both: there is no stone at the sides.
  const pixels = await pixelsOf(page, await canvas(page));
  const sides = Array.from({ length: 2 * pixels.height }, (_, k) => Math.floor((k + 1) / 2) * pixels.width - (k % 2));
  expect(Math.max(...sides.map((i) => Math.abs(warmthAt(pixels, i))))).toBeLessThan(15);
  await picture(page, "between");
  await page.getByRole("button", { name: "Animate" }).click();
  const slider = page.getByRole("slider", { name: "Blend towards the other" });
  await expect.poll(() => slider.inputValue(), { timeout: patience }).not.toBe("500");
  await page.getByRole("button", { name: "Stop", exact: true }).click();
  await settled(page);
  await drag(page, "Blend towards the other", [0.5]);
  const count = await page.locator(".items li").count();
  await press(page, "Keep the blend");
  expect(await page.locator(".items li").count()).toBe(count + 1);
  await choose("rock.ply");
});
