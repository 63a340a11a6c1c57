// Tests the page itself: first view, sizes, themes, keys, errors.
import { afterAll, beforeAll, beforeEach, expect, it } from "vitest";
import { writeFileSync } from "node:fs";
import type { Dialog, Page } from "playwright-core";
import {
  at,
  canvas,
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
const names = ["Figures", "Degrees", "Smooth", "Texture", "Points", "Caps", "Align", "Save"];

beforeAll(async () => {
  studio = await startStudio();
  rholm(studio, "make", "torus", "-o", "torus.ply");
  const ball = ["0 0 1", "1 0 0", "0 1 0", "-1 0 0", "0 -1 0", "0 0 -1"].map((corner) =>
    corner.split(" ").map((x) => 5000 + 300 * Number(x)).join(" "),
  );
  const faces = ["0 1 2", "0 2 3", "0 3 4", "0 4 1", "5 2 1", "5 3 2", "5 4 3", "5 1 4"];
  const lines = ["OFF", "6 8 0", ...ball, ...faces.map((face) => `3 ${face}`)];
  writeFileSync(inFolder(studio, "far.off"), lines.join("\n"));
  rholm(studio, "convert", "far.off", "far.ply");
  writeFileSync(inFolder(studio, "broken.ply"), "ply\nformat ascii 1.0\nelement vertex 3\n");
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

it("shows a shape, expanded, and three sentences", async () => {
  const { page } = now;
  await page.getByText("· degree 32").waitFor();
  expect(await page.locator(".welcome p").count()).toBe(3);
  await picture(page, "first-look");
  await press(page, /^Remove bumpy/);
  expect(await page.locator(".welcome").count()).toBe(0);
});

it("has one script and one style sheet and asks nobody else", async () => {
  const { page } = now;
  const asked: string[] = [];
  page.on("request", (request) => asked.push(request.url()));
  await page.reload();
  await ready(page);
  const beyond = asked.filter((url) => !url.startsWith(studio.address) && !url.startsWith("data:"));
  expect(beyond).toEqual([]);
  expect(asked.filter((url) => url.includes("/assets/"))).toHaveLength(2);
});

it("keeps the work over a reload", async () => {
  const { page } = now;
  await openFile(studio, page, "torus.ply");
  await page.reload();
  await ready(page);
  expect(await page.locator(".items li").count()).toBe(2);
});

it.each([
  [1280, 800],
  [800, 600],
  [640, 400],
])("gives every control a name and every panel a place on the screen of %i by %i", async (width, height) => {
  const { page } = now;
  for (const dark of [false, true]) {
    await page.emulateMedia({ colorScheme: dark ? "dark" : "light" });
    await page.setViewportSize({ width, height });
    for (const name of names) {
      await openTab(page, name);
      await settled(page);
      const nameless = await page.evaluate(() =>
        [...document.querySelectorAll("button, input, select")]
          .filter((one) => {
            const labels = (one as HTMLInputElement).labels;
            const label = labels?.length ? labels[0]?.textContent : one.textContent;
            return !(one.getAttribute("aria-label") ?? label)?.trim();
          })
          .map((one) => one.outerHTML),
      );
      expect(nameless, name).toEqual([]);
      // Nothing of the page is beyond the screen, and no word is cut off.
      expect(await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.scrollHeight])).toEqual([width, height]);
      expect(await page.evaluate(cutWords), name).toEqual([]);
      for (const place of [".stage", ".tabs", "#panel"]) {
        const box = await page.locator(place).boundingBox();
        expect(box && box.x >= 0 && box.y >= 0 && box.x + box.width <= width && box.y + box.height <= height, place).toBe(true);
        expect((box?.width ?? 0) * (box?.height ?? 0), place).toBeGreaterThan(60 * 200);
      }
      await picture(page, `panel-${name.toLowerCase()}-${width}${dark ? "-dark" : ""}`);
    }
  }
});

// Returns words wider than their place; words for screen readers have no place.
function cutWords(): string[] {
  const words = document.querySelectorAll<HTMLElement>("button, label, p, dt, dd, summary, li, h2, h3, small, .name");
  return [...words]
    .filter((one) => one.clientWidth > 1 && one.scrollWidth > one.clientWidth + 1)
    .map((one) => one.textContent);
}

it("is dark when the system is, and when it is told", async () => {
  const { page } = now;
  const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await paper();
  await page.emulateMedia({ colorScheme: "dark" });
  const dark = await paper();
  expect(dark).not.toBe(light);
  await press(page, "Light/dark");
  expect(await paper()).toBe(light);
  await press(page, /^Light$/);
  await page.emulateMedia({ colorScheme: "light" });
  expect(await paper()).toBe(dark);
  await openTab(page, "Degrees");
  await settled(page);
  await picture(page, "dark");
});

it("obeys its keys", async () => {
  const { page } = now;
  await page.keyboard.press("?");
  await page.getByRole("dialog").waitFor();
  await picture(page, "keys");
  await page.keyboard.press("Escape");
  await page.getByRole("dialog").waitFor({ state: "hidden" });
  await page.keyboard.press("2");
  expect(await page.getByRole("tab", { name: "Degrees" }).getAttribute("aria-selected")).toBe("true");
  const before = await canvas(page);
  await page.locator(".canvas canvas").focus();
  await page.keyboard.press("ArrowLeft");
  await settled(page);
  expect(Buffer.compare(before, await canvas(page))).not.toBe(0);
  await setNumber(page, "Degree", 8);
  await page.getByText("· degree 8 of 32").waitFor();
  await page.locator(".canvas canvas").focus(); // in a field, keys belong to the field
  await page.keyboard.press("Control+z");
  await settled(page);
  await page.getByText(/· degree 32$/).waitFor();
  await page.keyboard.press("Control+Shift+Z");
  await settled(page);
  await page.getByText("· degree 8 of 32").waitFor();
});

it("is painted on by a finger", async () => {
  const other = await visit(studio, { hasTouch: true, isMobile: true, viewport: { width: 800, height: 900 } });
  const { page } = other;
  await ready(page);
  await page.getByRole("tab", { name: "Smooth" }).tap();
  await settled(page);
  const before = await canvas(page);
  await page.touchscreen.tap(...(await at(page, 0.5, 0.5)));
  await settled(page);
  expect(Buffer.compare(before, await canvas(page))).not.toBe(0);
  expect(await page.getByRole("button", { name: "Keep" }).isEnabled()).toBe(true);
  await picture(page, "touch");
  expect(other.complaints).toEqual([]);
  await leave(studio, other);
});

it("takes files that are dropped", async () => {
  const { page } = now;
  const text = rholm(studio, "make", "box", "--ascii", "--format", "ply", "-o", "-");
  const transfer = await page.evaluateHandle((content) => {
    const data = new DataTransfer();
    data.items.add(new File([content], "dropped.ply"));
    return data;
  }, text);
  await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
  await settled(page);
  await page.locator(".items").getByText("dropped.ply").waitFor();
});

it("says why a shape is not star-shaped, and where", async () => {
  const { page } = now;
  await openFile(studio, page, "torus.ply");
  await openTab(page, "Figures");
  const box = page.getByLabel(/faces that the centre does not see/);
  expect(await box.isChecked()).toBe(true);
  await picture(page, "offending");
  const marked = await canvas(page);
  await box.uncheck();
  await settled(page);
  expect(Buffer.compare(marked, await canvas(page))).not.toBe(0);
});

it("says what is wrong with a file, and goes on", async () => {
  const { page } = now;
  await openFile(studio, page, "broken.ply");
  await page.getByRole("alert").waitFor();
  await picture(page, "broken-file");
  now.complaints = []; // the browser logs the refusal
  await press(page, "Close");
  await openFile(studio, page, "torus.ply");
  expect(await page.locator(".items li").count()).toBe(2);
});

it("opens the others of several files when one is broken", async () => {
  const { page } = now;
  await openFile(studio, page, "torus.ply", "broken.ply", "far.ply");
  expect(await page.locator(".items li").count()).toBe(3);
  const said = (await page.getByRole("alert").innerText()).split("\n");
  expect(said[0]).toMatch(/^broken\.ply: /);
  expect(said[1]).toBe("The other 2 are open.");
  now.complaints = []; // the browser logs the refusal
});

// Returns the number of stone pixels of the view, minus the number
// of blue pixels of the second shape. The background is neither.
async function warmth(page: Page): Promise<number> {
  const pixels = await pixelsOf(page, await canvas(page));
  let sum = 0;
  for (let i = 0; i < pixels.width * pixels.height; ++i) {
    const warm = warmthAt(pixels, i);
    if (Math.abs(warm) > 15) sum += Math.sign(warm);
  }
  return sum;
}

// The shapes have other sizes and positions, so the previous view does not fit them.
it("shows shapes of any size, wherever they are", async () => {
  const { page } = now;
  await openFile(studio, page, "far.ply");
  expect(await warmth(page)).toBeGreaterThan(0);
  await openTab(page, "Align");
  await settled(page);
  expect(await warmth(page)).toBeGreaterThan(0);
  await page.locator(".items li").first().getByRole("button").first().click();
  await settled(page);
  await page.getByRole("button", { name: "Fit" }).click();
  await settled(page);
  await picture(page, "far-apart");
  expect(await warmth(page)).toBeLessThan(0);
});

it("asks before work is lost, and not where there is none", async () => {
  const { page } = now;
  const close = async () => {
    const asked = new Promise<Dialog | null>((done) => {
      page.once("dialog", done);
      page.once("close", () => done(null));
    });
    await page.close({ runBeforeUnload: true });
    const dialog = await asked;
    await dialog?.dismiss();
    return dialog?.type() ?? null;
  };
  await openFile(studio, page, "torus.ply");
  await openTab(page, "Figures");
  for (const shape of ["sphere", "box"]) {
    await page.getByLabel("Make a shape").selectOption(shape);
    await settled(page);
  }
  expect(await close()).toBe("beforeunload");
  await openTab(page, "Save");
  await saved(page, "Save box.ply"); // the sphere is in no file yet
  await settled(page);
  expect(await close()).toBe("beforeunload");
  await saved(page, "Save the session");
  await settled(page);
  expect(await close()).toBeNull();
});

it("says that there is no WebGL 2, and lists what is open all the same", async () => {
  const { page } = now;
  await page.addInitScript(() => {
    HTMLCanvasElement.prototype.getContext = () => null;
  });
  await page.reload();
  await ready(page);
  await page.getByText("no WebGL 2").waitFor();
  expect(await page.locator(".items li").count()).toBe(1);
  await picture(page, "no-webgl");
  now.complaints = []; // three.js reports it as well
});

it("says that the program has gone", async () => {
  const { page } = now;
  studio.process.kill("SIGINT");
  await page.getByText("The studio does not answer").waitFor();
  await picture(page, "lost");
  await page.getByRole("button", { name: "Try again" }).click();
  await page.getByText("The studio does not answer").waitFor();
  now.complaints = []; // lost connections
});
