// Tests the brush and textures: kept edits are equal to the results of the recipe's commands.
import { afterAll, beforeAll, expect, it } from "vitest";
import { placed } from "../src/geometry/colors";
import {
  at,
  bytesOf,
  canvas,
  drag,
  openFile,
  openTab,
  picture,
  press,
  ready,
  rholm,
  saved,
  settled,
  shell,
  startStudio,
  stopStudio,
  visit,
  whereIs,
  type Studio,
  type Visit,
} from "./studio";

let studio: Studio;
let now: Visit;

beforeAll(async () => {
  studio = await startStudio();
  rholm(studio, "make", "bumpy", "--seed", "5", "--amplitude", "0.4", "-o", "rock.ply");
  now = await visit(studio);
  await ready(now.page);
  await openFile(studio, now.page, "rock.ply");
});
afterAll(async () => {
  await stopStudio(studio);
  expect(now.complaints).toEqual([]);
});

// Returns the file that the last command of the recipe writes, and the file that the page saves.
async function recipeAndSaved(): Promise<[Buffer, Buffer]> {
  const { page } = now;
  await openTab(page, "Save");
  await page.getByLabel("Format").selectOption("ply");
  const bytes = await saved(page, /^Save rock/);
  const lines = await page.locator(".copy pre").first().innerText();
  shell(studio, lines);
  const name = /-o (\S+)\s*$/.exec(lines)?.[1];
  if (!name) throw new Error(`the recipe ends without a file: ${lines}`);
  return [bytesOf(studio, name), bytes];
}

it("the brush paints, sliders smooth live, and what is kept is the recipe's", async () => {
  const { page } = now;
  await openTab(page, "Smooth");
  const before = await canvas(page);
  await page.mouse.move(...(await at(page, 0.45, 0.5)));
  await page.mouse.down();
  await page.mouse.move(...(await at(page, 0.55, 0.52)), { steps: 6 });
  await settled(page);
  await picture(page, "brush");
  await page.mouse.up();
  await settled(page);
  expect(Buffer.compare(before, await canvas(page))).not.toBe(0);
  await drag(page, "Strength", [0.5, 0.8]);
  const some = await canvas(page);
  await drag(page, "Strength", [-1]);
  expect(Buffer.compare(some, await canvas(page))).not.toBe(0);
  await drag(page, "Strength", [1]);
  await picture(page, "smoothed");
  await press(page, "Keep");
  expect(await page.getByRole("alert").count()).toBe(0);
  const [theirs, ours] = await recipeAndSaved();
  expect(Buffer.compare(theirs, ours)).toBe(0);
});

it("the brush grows and shrinks by keys and wheel", async () => {
  const { page } = now;
  await openTab(page, "Smooth");
  const field = page.getByLabel("Brush radius, exactly");
  const size = async () => Number(await field.inputValue());
  const first = await size();
  await page.locator(".canvas canvas").focus();
  await page.keyboard.press("]");
  expect(await size()).toBeGreaterThan(first);
  await page.keyboard.press("[");
  expect(await size()).toBeCloseTo(first, 3);
  await page.mouse.move(...(await at(page, 0.5, 0.5)));
  await page.keyboard.down("Alt");
  await page.mouse.wheel(0, -100);
  await page.keyboard.up("Alt");
  await settled(page);
  expect(await size()).toBeGreaterThan(first);
  await page.keyboard.press("[");
});

it("undoing takes back what was painted last, before any step", async () => {
  const { page } = now;
  const undo = page.getByRole("button", { name: "Undo", exact: true });
  const before = await undo.getAttribute("title");
  const keep = page.getByRole("button", { name: "Keep" });
  for (const x of [0.4, 0.6]) {
    await page.mouse.click(...(await at(page, x, 0.5)));
    await settled(page);
  }
  await page.keyboard.press("Control+z");
  await settled(page);
  expect(await keep.isEnabled()).toBe(true);
  await page.keyboard.press("Control+z");
  await settled(page);
  expect(await keep.isEnabled()).toBe(false);
  expect(await undo.getAttribute("title")).toBe(before);
});

it("discarding brings the surface back", async () => {
  const { page } = now;
  await page.locator(".canvas canvas").blur(); // its frame is not a part of the surface
  await page.mouse.move(...(await at(page, 0.1, 0.1)));
  await settled(page);
  const before = await canvas(page);
  await page.mouse.click(...(await at(page, 0.5, 0.5)));
  await settled(page);
  await page.mouse.move(...(await at(page, 0.1, 0.1)));
  expect(Buffer.compare(before, await canvas(page))).not.toBe(0);
  await press(page, "Clear");
  await page.mouse.move(...(await at(page, 0.1, 0.1)));
  await settled(page);
  await picture(page, "discarded");
  expect(Buffer.compare(before, await canvas(page))).toBe(0);
});

it("says that a bridge cannot be that wide, until that is not asked for", async () => {
  const { page } = now;
  for (const y of [0.4, 0.5, 0.6]) {
    for (const x of [0.4, 0.47, 0.54, 0.6]) {
      await page.mouse.click(...(await at(page, x, y)));
      await settled(page);
    }
  }
  await page.getByLabel("Action").selectOption("bridge");
  await settled(page);
  await page.getByRole("alert").waitFor();
  await picture(page, "refused");
  await page.getByLabel("Action").selectOption("smooth");
  await settled(page);
  expect(await page.getByRole("alert").count()).toBe(0);
  now.complaints.length = 0; // the browser logs the refusal
  await press(page, "Clear");
});

it("a texture is taken, laid, turned by its handle, and kept", async () => {
  const { page } = now;
  await openTab(page, "Texture");
  await page.mouse.click(...(await at(page, 0.4, 0.45)));
  await settled(page);
  await page.mouse.click(...(await at(page, 0.58, 0.55)));
  await settled(page);
  const laid = await canvas(page);
  await drag(page, "Height", [1.5, 2.5]);
  await picture(page, "texture");
  expect(Buffer.compare(laid, await canvas(page))).not.toBe(0);
  await picture(page, "texture");
  await page.getByLabel("Find the best angle").uncheck();
  await drag(page, "Angle", [30, 60]);
  await picture(page, "texture-turned");
  const ball = await whereIs(page, placed);
  if (!ball) throw new Error("there is no handle");
  await page.mouse.move(...ball);
  await page.mouse.down();
  await page.mouse.move(ball[0] - 60, ball[1] - 60, { steps: 5 });
  await page.mouse.up();
  await settled(page);
  const turned = Number(await page.getByLabel("Angle, exactly").inputValue());
  expect(Math.abs(turned - 60)).toBeGreaterThan(5);
  await page.getByLabel("Repeat the texture over the target").check();
  await settled(page);
  await page.getByLabel("Refine the target's mesh").check();
  await settled(page);
  await picture(page, "texture-refined");
  await press(page, "Keep");
  expect(await page.getByRole("alert").count()).toBe(0);
  const [theirs, ours] = await recipeAndSaved();
  expect(Buffer.compare(theirs, ours)).toBe(0);
});

it.each([
  ["repair", "--repair"],
  ["bridge", "--fitting around"],
])("to %s is another way of smoothing", async (action, option) => {
  const { page } = now;
  await openTab(page, "Smooth");
  await page.getByLabel("Action").selectOption(action);
  await page.mouse.click(...(await at(page, 0.5, 0.4)));
  await settled(page);
  await press(page, "Keep");
  expect(await page.getByRole("alert").count()).toBe(0);
  const [theirs, ours] = await recipeAndSaved();
  expect(Buffer.compare(theirs, ours)).toBe(0);
  expect(await page.locator(".copy pre").first().innerText()).toContain(option);
});

it("all of it is undone, step by step", async () => {
  const { page } = now;
  for (let steps = 0; steps < 4; ++steps) await press(page, "Undo");
  await openTab(page, "Save");
  await page.getByLabel("Format").selectOption("ply");
  expect(Buffer.compare(await saved(page, /^Save rock/), bytesOf(studio, "rock.ply"))).toBe(0);
});
