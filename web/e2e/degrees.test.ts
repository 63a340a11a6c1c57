// Tests degrees, filters, errors and files: the bytes are equal to the program's.
import { writeFileSync } from "node:fs";
import { afterAll, beforeAll, expect, it } from "vitest";
import {
  bytesOf,
  canvas,
  drag,
  inFolder,
  leave,
  openFile,
  openTab,
  picture,
  pixelsOf,
  press,
  ready,
  rholm,
  saved,
  setNumber,
  settled,
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
  rholm(studio, "make", "bumpy", "--seed", "3", "-o", "rock.ply");
  rholm(studio, "expand", "rock.ply", "--degree", "40", "-o", "rock.h5");
  now = await visit(studio);
  await ready(now.page);
  await openFile(studio, now.page, "rock.ply");
  await openTab(now.page, "Degrees");
  await setNumber(now.page, "Up to degree", 40);
  await press(now.page, "Expand");
});
afterAll(async () => {
  await stopStudio(studio);
  expect(now.complaints).toEqual([]);
});

async function save(format: string): Promise<Buffer> {
  await openTab(now.page, "Save");
  await now.page.getByLabel("Format").selectOption(format);
  const bytes = await saved(now.page, /^Save rock\./);
  await openTab(now.page, "Degrees");
  return bytes;
}

// Returns a report without its title and commands, because the studio's commands are its own steps.
function shownBy(report: Buffer): string {
  return report
    .toString("utf8")
    .replaceAll(/<(title|h1)>[^<]*<\/\1>/g, "")
    .replaceAll(", beside the shape rock.ply", "")
    .replaceAll(/<p[^>]*>[^<]*<\/p>\s*<pre>.*?<\/pre>\s*/gs, "");
}

it.each(["obj", "off", "stl", "ply"])("the whole series as %s is the program's synthesis", async (format) => {
  rholm(studio, "synthesize", "rock.h5", "--like", "rock.ply", "-o", `whole.${format}`);
  expect(Buffer.compare(await save(format), bytesOf(studio, `whole.${format}`))).toBe(0);
});

it.each([
  ["h5", "h5"],
  ["json", "json"],
  ["npy", "npy"],
  ["shtools", "sh"],
  ["icgem", "gfc"],
])("coefficients as %s are the program's", async (format, ending) => {
  if (format !== "h5") rholm(studio, "convert", "rock.h5", `rock.${ending}`);
  expect(Buffer.compare(await save(format), bytesOf(studio, `rock.${ending}`))).toBe(0);
});

it("the surface follows the slider, and what is kept is what is saved", async () => {
  const { page } = now;
  const before = await canvas(page);
  await drag(page, "Degree", [30, 20, 12, 8]);
  expect(Buffer.compare(before, await canvas(page))).not.toBe(0);
  await picture(page, "degree-8");
  rholm(studio, "synthesize", "rock.h5", "--degree", "8", "--like", "rock.ply", "-o", "d8.ply");
  expect(Buffer.compare(await save("ply"), bytesOf(studio, "d8.ply"))).toBe(0);
});

it("undo brings the degree back", async () => {
  const { page } = now;
  await press(page, "Undo");
  expect(await page.getByLabel("Degree, exactly", { exact: true }).inputValue()).toBe("40");
  await press(page, "Redo");
  expect(await page.getByLabel("Degree, exactly", { exact: true }).inputValue()).toBe("8");
});

it("errors are painted, with a scale, beside the original", async () => {
  const { page } = now;
  const plain = await canvas(page);
  await page.getByLabel("Error in colours").check();
  await settled(page);
  await page.locator("figure.legend").waitFor();
  const painted = await canvas(page);
  expect(Buffer.compare(plain, painted)).not.toBe(0);
  await page.getByLabel("Beside the original").check();
  await settled(page);
  expect(Buffer.compare(painted, await canvas(page))).not.toBe(0);
  await picture(page, "error-side-by-side");
  await page.getByLabel("Beside the original").uncheck();
  await page.getByLabel("Error in colours").uncheck();
});

it("an equaliser's gains change the shape", async () => {
  const { page } = now;
  await page.getByLabel("Degrees kept").selectOption("bands");
  await settled(page);
  const before = await canvas(page);
  await drag(page, "Gain of degrees 5 to 8", [0.5, 2.5]);
  expect(Buffer.compare(before, await canvas(page))).not.toBe(0);
  await picture(page, "equaliser");
});

// Returns the names of the program's filter windows.
function windowsOf(program: Studio): string[] {
  const section = rholm(program, "reference").split("## Filter windows")[1]?.split("\n## ")[0] ?? "";
  return [...section.matchAll(/^\| `(\w+)` \|/gm)].map(([, name]) => name ?? "");
}

it("has the windows of the program, and their gains to the last bit", async () => {
  const { page } = now;
  await page.getByLabel("Degrees kept").selectOption("low");
  await setNumber(page, "Degree", 12);
  const names = windowsOf(studio);
  const choice = page.getByLabel("Window");
  const offered = await choice.locator("option").evaluateAll((all) => all.map((one) => (one as HTMLOptionElement).value));
  expect(offered).toEqual(names);
  expect(names.length).toBeGreaterThan(3);
  for (const name of names) {
    await choice.selectOption(name);
    await settled(page);
    rholm(studio, "filter", "rock.h5", "--low-pass", "12", "--window", name, "-o", "low.h5");
    rholm(studio, "convert", "low.h5", "low.npy");
    expect(Buffer.compare(await save("npy"), bytesOf(studio, "low.npy")), name).toBe(0);
  }
});

it("parameters of windows are those of the program", async () => {
  const { page } = now;
  const choice = page.getByLabel("Window");
  await choice.selectOption("exponential");
  await setNumber(page, "Order p", 2);
  await picture(page, "window-exponential");
  rholm(studio, "filter", "rock.h5", "--low-pass", "12", "--window", "exponential", "--order", "2", "-o", "low.h5");
  rholm(studio, "convert", "low.h5", "low.npy");
  expect(Buffer.compare(await save("npy"), bytesOf(studio, "low.npy"))).toBe(0);
  await choice.selectOption("heat");
  const time = page.getByLabel("Time t", { exact: true });
  await time.fill("0.005");
  await time.press("Enter");
  await settled(page);
  await picture(page, "window-heat");
  expect(await page.getByLabel("Degree", { exact: true }).isDisabled()).toBe(true);
  rholm(studio, "filter", "rock.h5", "--window", "heat", "--time", "0.005", "-o", "low.h5");
  rholm(studio, "convert", "low.h5", "low.npy");
  expect(Buffer.compare(await save("npy"), bytesOf(studio, "low.npy"))).toBe(0);
  await time.fill("-1");
  await time.press("Enter");
  await page.getByText("Time t is a number from").waitFor();
  expect(await time.inputValue()).toBe("0.005");
  await time.fill("");
  await time.press("Enter");
  await page.getByLabel("Degrees kept").selectOption("cut");
  await settled(page);
});

it("finds the degree for an error", async () => {
  const { page } = now;
  await setNumber(page, "Allowed error, rms", 0.015);
  await press(page, "Find the degree");
  const degree = Number(await page.getByLabel("Degree, exactly", { exact: true }).inputValue());
  expect(degree).toBeGreaterThan(2);
  expect(degree).toBeLessThan(40);
  // The allowed error does not depend on the shown degree.
  const allowed = page.getByLabel("Allowed error, rms, exactly", { exact: true });
  expect(await allowed.inputValue()).toBe("0.015");
  await setNumber(page, "Degree", 1);
  expect(await allowed.inputValue()).toBe("0.015");
});

it("an allowed error in percent is a share of the mean radius", async () => {
  const { page } = now;
  const allowed = page.getByLabel("Allowed error, rms, exactly", { exact: true });
  await allowed.fill("2 %");
  await allowed.press("Enter");
  await page.getByText(/This is 2\s% of the mean radius/).waitFor();
  // In this file functions have a mean square of 1, so the coefficient of degree 0 is the mean radius.
  const npy = await save("npy");
  const mean = npy.readDoubleLE(npy.indexOf("\n") + 1);
  await openTab(page, "Degrees");
  expect(Number(await allowed.inputValue()) / (0.02 * mean)).toBeCloseTo(1, 2);
  await press(page, "Find the degree");
  await page.getByText(/The rms is [\d.]+\s% of the mean radius/).waitFor();
  const text = await page.getByText(/The rms is/).innerText();
  expect(Number(/The rms is ([\d.]+)\s%/.exec(text)?.[1])).toBeLessThanOrEqual(2);
});

it("a picture has the size that was asked for", async () => {
  const { page } = now;
  await openTab(page, "Save");
  await setNumber(page, "Width", 3000); // more than one tile
  await setNumber(page, "Height", 2500);
  const png = await saved(page, "Save the picture");
  expect(png.subarray(1, 4).toString()).toBe("PNG");
  expect([png.readUInt32BE(16), png.readUInt32BE(20)]).toEqual([3000, 2500]);
});

// Returns, for the left and the right half of a picture, the share of drawn pixels, and
// the share of these that are more blue than red. Stone never is; half of the errors are.
async function halvesOf(png: Buffer): Promise<{ drawn: number; blue: number }[]> {
  const pixels = await pixelsOf(now.page, png);
  const { width, height, data } = pixels;
  return [true, false].map((left) => {
    const half = Array.from({ length: width * height }, (_, i) => i).filter((i) => i % width < width / 2 === left);
    const drawn = half.filter((i) => data[4 * i + 3] === 255);
    const blue = drawn.filter((i) => warmthAt(pixels, i) < 0);
    return { drawn: drawn.length / half.length, blue: blue.length / drawn.length };
  });
}

it("a picture of what is compared has both, and their colours", async () => {
  const { page } = now;
  await openTab(page, "Degrees");
  await setNumber(page, "Degree", 5);
  await page.getByLabel("Error in colours").check();
  await page.getByLabel("Beside the original").check();
  await settled(page);
  await openTab(page, "Save");
  await page.locator("figure.legend").waitFor();
  await setNumber(page, "Width", 1200);
  await setNumber(page, "Height", 600);
  const [left, right] = await halvesOf(await saved(page, "Save the picture"));
  await picture(page, "comparison-saved");
  if (!left || !right) throw new Error("there is no picture");
  expect(left.drawn).toBeGreaterThan(0.1);
  expect(right.drawn / left.drawn).toBeCloseTo(1, 1); // a shape, and a smoother one
  expect(left.blue).toBe(0);
  expect(right.blue).toBeGreaterThan(0.2);
  // The comparison also disappears with the panel.
  await openTab(page, "Degrees");
  expect(await page.getByLabel("Beside the original").isChecked()).toBe(true);
  await page.locator("figure.legend").waitFor();
  await openTab(page, "Save");
  await openTab(page, "Align");
  await settled(page);
  expect(await page.locator("figure.legend").count()).toBe(0);
  await press(page, "Undo");
  await openTab(page, "Save");
});

it("a report and a session are saved, and the session opens again", async () => {
  const { page } = now;
  const report = await saved(page, "Save a report");
  writeFileSync(inFolder(studio, "shown.h5"), await save("h5"));
  rholm(studio, "report", "shown.h5", "--shape", "rock.ply", "-o", "report.html");
  const theirs = shownBy(bytesOf(studio, "report.html"));
  expect(theirs.match(/<(img|svg)/g)?.length).toBeGreaterThan(3);
  expect(shownBy(report) === theirs).toBe(true); // a difference of megabytes is no message
  await openTab(page, "Save");
  const session = await saved(page, "Save the session");
  const other = await visit(studio);
  await ready(other.page);
  const file = { name: "s.rholm", mimeType: "application/octet-stream", buffer: session };
  await other.page.locator("nav input[type=file]").setInputFiles(file);
  await settled(other.page);
  await other.page.locator(".items").getByText("rock.ply").waitFor();
  expect(other.complaints).toEqual([]);
  await leave(studio, other);
});

it("the recipe is there to copy", async () => {
  const { page } = now;
  await page.getByRole("button", { name: "Copy: Shell" }).click();
  const text = await page.evaluate(() => navigator.clipboard.readText());
  expect(text).toContain("rholm expand rock.ply --degree 40");
  await picture(page, "save");
});

it("measures its own latency", async () => {
  const said = await now.page.evaluate(() => window.rholmLatency());
  expect(said.degree?.count).toBeGreaterThan(5);
  expect(said.degree?.p50).toBeGreaterThan(0);
});
