// Tests that the Python of the recipe makes the files that the page saves, byte by byte, and other buttons.
//   RHOLM_MODULE folder of the Python package; without it the Python is not run
//   RHOLM_JUPYTER a program beside the Python that has the package's dependencies
import { execFileSync } from "node:child_process";
import { dirname, join } from "node:path";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, it } from "vitest";
import {
  at,
  bytesOf,
  openFile,
  openTab,
  picture,
  press,
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
} from "./studio";

const { RHOLM_MODULE: module, RHOLM_JUPYTER: jupyter } = process.env;
let studio: Studio;
let page: Page;

beforeAll(async () => {
  studio = await startStudio();
  rholm(studio, "make", "bumpy", "--seed", "5", "--amplitude", "0.4", "--subdivisions", "4", "-o", "rock.ply");
  rholm(studio, "make", "bumpy", "--seed", "9", "--amplitude", "0.6", "--subdivisions", "4", "-o", "rough.ply");
  rholm(studio, "make", "torus", "-o", "torus.ply");
  ({ page } = await visit(studio));
  await ready(page);
});
afterAll(() => stopStudio(studio));

// Runs the recipe's Python, and writes the result of its last line.
async function python(file: string): Promise<Buffer> {
  await openTab(page, "Save");
  const lines = (await page.locator(".copy pre").nth(1).innerText()).trim();
  const made = /^(\w+) = .*$/.exec(lines.split("\n").at(-1) ?? "")?.[1];
  if (!made || !jupyter) throw new Error(`the recipe ends without a name: ${lines}`);
  const program = join(dirname(jupyter), "python");
  const script = `${lines}\n${made}.save("${file}")\n`;
  const environment = { ...process.env, PYTHONPATH: module };
  execFileSync(program, ["-c", script], { cwd: studio.folder, env: environment, stdio: "pipe" });
  return bytesOf(studio, file);
}

async function save(format: string): Promise<Buffer> {
  await openTab(page, "Save");
  await page.getByLabel("Format").selectOption(format);
  return saved(page, /^Save .*\.\w+$/);
}

it.skipIf(!module)("of a series that is cut off", async () => {
  await openFile(studio, page, "rock.ply");
  await openTab(page, "Degrees");
  await setNumber(page, "Up to degree", 20);
  await press(page, "Expand");
  await setNumber(page, "Degree", 7);
  expect((await python("cut.ply")).equals(await save("ply"))).toBe(true);
});

it.skipIf(!module)("of a surface under the brush", async () => {
  await openTab(page, "Smooth");
  await page.mouse.click(...(await at(page, 0.5, 0.5)));
  await settled(page);
  await press(page, "Keep");
  expect((await python("smooth.ply")).equals(await save("ply"))).toBe(true);
});

it.skipIf(!module)("of caps", async () => {
  await openFile(studio, page, "torus.ply");
  await openTab(page, "Caps");
  await page.getByRole("button", { name: /caps|Compress/i }).first().click();
  await settled(page);
  expect((await python("caps.h5")).equals(await save("h5"))).toBe(true);
});

it("of a texture from another shape, as a shell's", async () => {
  if (!module) await openFile(studio, page, "rock.ply"); // otherwise an earlier test has opened it
  await openFile(studio, page, "rough.ply");
  await openTab(page, "Texture");
  await page.mouse.click(...(await at(page, 0.45, 0.45)));
  await settled(page);
  await page.locator(".items li").filter({ hasText: "rock" }).first().getByRole("button").first().click();
  await settled(page);
  await page.mouse.click(...(await at(page, 0.52, 0.5)));
  await settled(page);
  await picture(page, "texture-of-another");
  await press(page, "Keep");
  expect(await page.getByRole("alert").count()).toBe(0);
  const bytes = await save("ply");
  const lines = await page.locator(".copy pre").first().innerText();
  shell(studio, lines);
  const transfer = /rholm transfer --from rough\.ply .* -o (\S+)/.exec(lines);
  expect(transfer, lines).not.toBeNull();
  expect(bytesOf(studio, transfer?.[1] ?? "").equals(bytes)).toBe(true);
});

it("a shape gets another name, which its files have", async () => {
  await openTab(page, "Figures");
  const field = page.getByLabel("Name", { exact: true });
  await field.fill("Two words.ply");
  await field.press("Enter");
  await settled(page);
  expect(await page.locator(".items .chosen .name").innerText()).toBe("Two words.ply");
  await openTab(page, "Save");
  await page.getByRole("button", { name: "Save Two words.ply" }).waitFor();
});

it("the program ends where the page tells it to, and the page says so", async () => {
  const ended = new Promise((done) => studio.process.once("exit", done));
  await page.keyboard.press("Escape");
  await page.getByRole("button", { name: "Quit" }).click();
  await picture(page, "quit");
  // The button that loses nothing has the focus.
  await page.locator("dialog button:focus", { hasText: "Keep working" }).waitFor();
  await page.keyboard.press("Enter");
  await page.getByRole("dialog").waitFor({ state: "hidden" });
  expect(studio.process.exitCode).toBeNull();
  await page.getByRole("button", { name: "Quit" }).click();
  await page.getByRole("button", { name: "Stop without saving" }).click();
  expect(await ended).toBe(0);
  await page.getByText("The program has ended.").waitFor();
});
