// Tests what new users meet: files of the command line, names, fields, impossible steps, the upward axis.
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterAll, beforeAll, beforeEach, expect, it } from "vitest";
import {
  bytesOf,
  canvas,
  drag,
  drop,
  inFolder,
  leave,
  moveSlider,
  openFile,
  openTab,
  picture,
  press,
  programPath,
  ready,
  rholm,
  saved,
  setNumber,
  settled,
  shell,
  startStudio,
  stopStudio,
  visit,
  type Studio,
  type Visit,
} from "./studio";

let studio: Studio;
let now: Visit;
const long = "a-scan-with-a-name-that-is-far-too-long-for-any-list-of-shapes-in-a-page";

beforeAll(async () => {
  studio = await startStudio((folder) => {
    execFileSync(programPath(), ["make", "torus", "-o", join(folder, "ring.ply")]);
    return [join(folder, "ring.ply")];
  });
  rholm(studio, "make", "bumpy", "--subdivisions", "3", "-o", `${long}-first-of-two.ply`);
  rholm(studio, "make", "box", "-o", `${long}-other-of-two.ply`);
});
afterAll(() => stopStudio(studio));
beforeEach(async () => {
  now = await visit(studio);
  await ready(now.page);
  return async () => {
    const said = now.complaints;
    await leave(studio, now);
    expect(said).toEqual([]);
  };
});

const names = () => now.page.locator(".items .name").allInnerTexts();
const field = (label: string) => now.page.getByLabel(`${label}, exactly`, { exact: true });

it("begins with the files of the command line, in every tab, and undoing does not close them", async () => {
  const { page } = now;
  expect(await names()).toEqual(["ring.ply"]);
  expect(await page.getByRole("button", { name: "Undo" }).isDisabled()).toBe(true);
  const other = await visit(studio);
  await ready(other.page);
  expect(await other.page.locator(".items .name").allInnerTexts()).toEqual(["ring.ply"]);
  expect(other.complaints).toEqual([]);
  await leave(studio, other);
});

it("says where to drop files when nothing is open", async () => {
  const { page } = now;
  await press(page, /^Remove ring/);
  await page.getByText("Drop files here").waitFor();
  await picture(page, "empty");
  await page.locator("main").getByLabel("Make a shape").selectOption("box");
  await settled(page);
  expect(await page.getByText("Drop files here").count()).toBe(0);
  expect(await names()).toEqual(["box.ply"]);
});

it("does not offer to expand what no centre sees, and says what can be done", async () => {
  const { page } = now;
  await openTab(page, "Degrees");
  expect(await page.getByRole("button", { name: "Expand" }).count()).toBe(0);
  await page.getByText("No centre sees all of this surface").waitFor();
  await picture(page, "not-star-shaped");
  await press(page, "Go to Caps");
  await page.getByRole("button", { name: "Compress" }).waitFor();
});

it("shows names that can be told apart", async () => {
  const { page } = now;
  await openFile(studio, page, `${long}-first-of-two.ply`, `${long}-other-of-two.ply`, `${long}-first-of-two.ply`);
  const shown = await names();
  expect(new Set(shown).size).toBe(4);
  expect(shown[1]).toContain("first");
  expect(shown[2]).toContain("other");
  expect(shown[3]).toContain("(2)");
  await picture(page, "long-names");
});

it("does not leave a value in a field that cannot be", async () => {
  const { page } = now;
  await openFile(studio, page, `${long}-first-of-two.ply`);
  await openTab(page, "Degrees");
  await setNumber(page, "Up to degree", 5000);
  expect(await field("Up to degree").inputValue()).toBe("1024");
  await page.getByText("The most is 1024.").waitFor();
  await setNumber(page, "Up to degree", 12);
  await press(page, "Expand");
  for (const [typed, becomes] of [["99", "12"], ["99", "12"], ["-3", "0"], ["x", "0"], ["", "0"], ["7.4", "7"], ["2,6", "3"]] as const) {
    await field("Degree").fill(typed);
    await field("Degree").press("Enter");
    await settled(page);
    expect(await field("Degree").inputValue(), typed).toBe(becomes);
  }
  // Keys of the slider change the degree.
  const slider = page.getByRole("slider", { name: "Degree", exact: true });
  await slider.focus();
  await page.keyboard.press("ArrowRight");
  await settled(page);
  expect(await field("Degree").inputValue()).toBe("4");
});

it("figures are of the degree that is shown", async () => {
  const { page } = now;
  await openFile(studio, page, `${long}-first-of-two.ply`);
  await openTab(page, "Degrees");
  await setNumber(page, "Up to degree", 12);
  await press(page, "Expand");
  const value = async (label: string) => {
    await openTab(page, "Figures");
    const row = page.locator(".facts div").filter({ has: page.locator(`dt:text-is("${label}")`) });
    return row.locator("dd").innerText();
  };
  const before = [await value("Volume"), await value("Error, rms")];
  await openTab(page, "Degrees");
  // The text also changes while the slider is held.
  await moveSlider(page.getByRole("slider", { name: "Degree", exact: true }), 2);
  await page.getByText("· degree 2 of 12").waitFor();
  await drag(page, "Degree", [2]);
  expect(await value("Degree")).toBe("2 of 12");
  expect(await value("Volume")).not.toBe(before[0]);
  expect(await value("Error, rms")).not.toBe(before[1]);
});

it("says what the columns of a table were taken for, and takes what people say they are", async () => {
  const { page } = now;
  const rows = Array.from({ length: 40 }, (_, i) => [i + 1, Math.cos(i), Math.sin(i), i / 40, 7 * i].join(" "));
  await drop(page, [["spiral.txt", Buffer.from(`${rows.join("\n")}\n`)]]);
  await page.getByText("spiral.txt: columns taken for").waitFor();
  await openTab(page, "Figures");
  const columns = page.getByLabel("Columns", { exact: true });
  expect(await columns.inputValue()).toBe("-,x,y,z,scalar_1");
  await picture(page, "table");
  const before = await canvas(page);
  await columns.fill("x,y,z,-");
  await columns.press("Enter");
  await settled(page);
  await page.getByText(/are 4, but the rows have 5/).waitFor();
  expect(await columns.inputValue()).toBe("-,x,y,z,scalar_1");
  await columns.fill("-,z,x,y,height");
  await columns.press("Enter");
  await settled(page);
  expect(Buffer.compare(before, await canvas(page))).not.toBe(0);
  expect(await page.getByRole("alert").count()).toBe(0);
  expect(await columns.inputValue()).toBe("-,z,x,y,height");
  await openTab(page, "Save");
  const bytes = await saved(page, "Save spiral.ply");
  const lines = await page.locator(".copy pre").first().innerText();
  writeFileSync(inFolder(studio, "spiral.txt"), `${rows.join("\n")}\n`);
  shell(studio, lines);
  expect(bytesOf(studio, "spiral-columns.ply").equals(bytes)).toBe(true);
  await press(page, "Undo");
  await openTab(page, "Figures");
  expect(await columns.inputValue()).toBe("-,x,y,z,scalar_1");
  now.complaints.length = 0; // the browser logs the refusal
});

it("reads a table that was refused, with what people say its columns are", async () => {
  const { page } = now;
  await openTab(page, "Figures");
  await drop(page, [["odd.csv", Buffer.from("a,b,c\n1,2,3\n2,4,3\n5,4,4\n")]]);
  await page.getByText("odd.csv was not read").waitFor();
  await picture(page, "table-refused");
  const columns = page.getByLabel("Its columns");
  await columns.fill("x,y,z");
  await columns.press("Enter");
  await settled(page);
  expect(await names()).toEqual(["ring.ply", "odd.csv"]);
  expect(await columns.count()).toBe(0);
  expect(await page.getByRole("button", { name: "Undo" }).isDisabled()).toBe(true);
  now.complaints.length = 0;
});

it("begins every panel at its top", async () => {
  const { page } = now;
  await page.setViewportSize({ width: 640, height: 400 });
  const top = () => page.locator("#panel").evaluate((panel) => panel.scrollTop);
  await openTab(page, "Figures");
  await page.locator("#panel").evaluate((panel) => panel.scrollTo(0, panel.scrollHeight));
  expect(await top()).toBeGreaterThan(0);
  await openTab(page, "Save");
  expect(await top()).toBe(0);
});

// Returns the boxes that the page cuts off at the left or right, and fields that do not show all their text.
const cutOff = () =>
  now.page.evaluate(() => {
    const inside = document.querySelectorAll<HTMLElement>(".panel *, .items li.chosen, .items li.chosen *, header *");
    return Array.from(inside, (one) => ({ one, box: one.getBoundingClientRect() }))
      .filter(({ one, box }) => {
        if (box.width === 0 || one.closest("svg, pre, .chart, header span")) return false;
        const frame = one.closest("#panel, .items ul, header")?.getBoundingClientRect();
        const out = frame !== undefined && (box.left < frame.left - 1 || box.right > frame.right + 1);
        return out || (one instanceof HTMLInputElement && one.scrollWidth > one.clientWidth + 1);
      })
      .map(({ one }) => `${one.tagName} ${one.textContent}`);
  });

it.each([
  [1280, 800],
  [800, 600],
  [640, 400],
])("cuts nothing off in a page of %i by %i pixels", async (width, height) => {
  const { page } = now;
  await page.setViewportSize({ width, height });
  rholm(studio, "make", "bumpy", "--subdivisions", "3", "-o", "asteroid-of-the-belt.ply");
  await openFile(studio, page, "asteroid-of-the-belt.ply");
  await openTab(page, "Degrees");
  await setNumber(page, "Up to degree", 32);
  await press(page, "Expand");
  await page.getByLabel("Degrees kept").selectOption("high");
  await page.getByLabel("Degrees kept").selectOption("bands");
  await settled(page);
  for (const name of ["Degrees", "Figures", "Smooth", "Texture", "Points", "Caps", "Align", "Save"]) {
    await openTab(page, name);
    await settled(page);
    expect(await cutOff(), name).toEqual([]);
  }
  // Gains are on one line.
  await openTab(page, "Degrees");
  const heights = await page.locator(".bands span").evaluateAll((all) => all.map((one) => one.getClientRects().length));
  expect(new Set(heights)).toEqual(new Set([1]));
});

it("keeps the buttons of a brush and of a texture in view", async () => {
  const { page } = now;
  await page.setViewportSize({ width: 640, height: 400 });
  for (const name of ["Smooth", "Texture"]) {
    await openTab(page, name);
    const panel = page.locator("#panel");
    expect(await panel.evaluate((one) => one.scrollHeight > one.clientHeight), name).toBe(true);
    for (const end of [false, true]) {
      await panel.evaluate((one, down) => one.scrollTo(0, down ? one.scrollHeight : 0), end);
      const box = await page.getByRole("button", { name: "Keep" }).boundingBox();
      expect((box?.y ?? 400) + (box?.height ?? 0), name).toBeLessThanOrEqual(400);
    }
  }
});

it("turns the axis up that is chosen, and remembers it", async () => {
  const { page } = now;
  const axis = page.getByLabel("Axis that points up");
  expect(await axis.inputValue()).toBe("z");
  const before = await canvas(page);
  await axis.selectOption("y");
  await settled(page);
  expect(Buffer.compare(before, await canvas(page))).not.toBe(0);
  const turned = await canvas(page);
  await page.getByLabel("View from").selectOption("top");
  await settled(page);
  expect(Buffer.compare(turned, await canvas(page))).not.toBe(0);
  await picture(page, "from-above");
  await page.reload();
  await ready(page);
  expect(await axis.inputValue()).toBe("y");
  await page.locator(".scale-bar").waitFor();
  expect(await page.locator(".axes text").allInnerTexts()).toHaveLength(3);
});
