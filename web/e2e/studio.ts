// Starts the program, a browser and a page of the studio.
//   RHOLM_PROGRAM the program; needed
//   RHOLM_PICTURES folder for pictures of the page; without it there are none
//   RHOLM_CHROMIUM the browser; /usr/bin/chromium by default
import { execFileSync, spawn, type ChildProcess } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium, type Browser, type BrowserContextOptions, type Locator, type Page } from "playwright-core";
import type {} from "../src/idle";
import { sessionKey } from "../src/transport";
import { toPlace, type Scale } from "../src/format";
import { toSrgb, type Rgb } from "../src/geometry/colors";

// Chosen for a browser that draws in software on a busy machine. A test without errors does not wait.
export const patience = 120_000;

const dist = fileURLToPath(new URL("../dist", import.meta.url));
export const pictures = process.env.RHOLM_PICTURES;

export function programPath(): string {
  const path = process.env.RHOLM_PROGRAM;
  if (!path) throw new Error("RHOLM_PROGRAM does not name the program");
  return path;
}

export interface Program {
  address: string;
  folder: string; // folder for files of the test
  process: ChildProcess;
}

export interface Studio extends Program {
  browser: Browser;
}

// Runs the program to its end; throws if it fails.
export function rholm(studio: Program, ...words: string[]): string {
  const options = { cwd: studio.folder, encoding: "utf8", stdio: "pipe" } as const;
  return execFileSync(programPath(), words, options);
}

// Runs these lines in a shell, where `rholm` is the program.
export function shell(studio: Studio, lines: string): void {
  const script = `set -e\nrholm() { "$RHOLM_PROGRAM" "$@"; }\n${lines}\n`;
  execFileSync("/bin/sh", ["-c", script], { cwd: studio.folder, stdio: "pipe" });
}

export const inFolder = (studio: Program, name: string) => join(studio.folder, name);
export const bytesOf = (studio: Program, name: string) => readFileSync(inFolder(studio, name));

export async function startStudio(prepare?: (folder: string) => string[]): Promise<Studio> {
  return { ...(await startProgram(prepare)), browser: await launch() };
}

// `prepare` makes files in the folder, and returns the names of the files that the studio opens at its start.
export async function startProgram(prepare: (folder: string) => string[] = () => []): Promise<Program> {
  const folder = mkdtempSync(join(tmpdir(), "rholm-studio-"));
  const words = ["studio", "--no-open", "--page", dist, ...prepare(folder)];
  const started = spawn(programPath(), words, { cwd: folder, stdio: ["ignore", "ignore", "pipe"] });
  const address = await new Promise<string>((found, fail) => {
    let said = "";
    started.stderr.on("data", (bytes: Buffer) => {
      said += bytes.toString();
      const match = /http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]+\//.exec(said);
      if (match) found(match[0]);
    });
    started.on("exit", (code) => fail(new Error(`the studio ended with ${String(code)}: ${said}`)));
  });
  return { address, folder, process: started };
}

export function launch(): Promise<Browser> {
  return chromium.launch({
    executablePath: process.env.RHOLM_CHROMIUM ?? "/usr/bin/chromium",
    timeout: patience,
    // WebGL runs in software, so that pictures do not depend on the machine's graphics
    // card. There is no sandbox and hardly any shared memory, as in containers.
    args: ["--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
}

export async function stopStudio(studio: Studio): Promise<void> {
  await studio.browser.close();
  await stopProgram(studio);
}

export async function stopProgram(program: Program): Promise<void> {
  if (program.process.exitCode === null && program.process.signalCode === null) {
    const ended = new Promise((done) => program.process.once("exit", done));
    program.process.kill("SIGINT");
    await ended;
  }
  rmSync(program.folder, { recursive: true, force: true });
}

// Returns the bytes of memory that the program uses.
export function resident(studio: Studio): number {
  const status = readFileSync(`/proc/${studio.process.pid}/status`, "utf8");
  return 1024 * Number(/VmRSS:\s+(\d+)/.exec(status)?.[1]);
}

export interface Visit {
  page: Page;
  // Errors in the browser's console, including violations of the content policy. A test that
  // expects errors puts an empty list here at its end; late errors then go to the old list.
  complaints: string[];
}

export async function visit(studio: Studio, options: BrowserContextOptions = {}): Promise<Visit> {
  const context = await studio.browser.newContext({
    viewport: { width: 1280, height: 800 },
    permissions: ["clipboard-read", "clipboard-write"],
    ...options,
  });
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  const complaints: string[] = [];
  page.on("pageerror", (error) => complaints.push(error.stack ?? error.message));
  page.on("console", (message) => {
    if (message.type() === "error") complaints.push(message.text());
  });
  await page.goto(studio.address);
  return { page, complaints };
}

// Closes a page and ends its session, because a studio has at most sixteen, and abandoned ones stay for a minute.
export async function leave(studio: Studio, { page }: Visit): Promise<void> {
  const session = page.isClosed() ? null : await page.evaluate((key) => sessionStorage.getItem(key), sessionKey);
  await page.context().close();
  if (!session || studio.process.killed) return;
  await fetch(`${studio.address}api/session/close`, { method: "POST", headers: { "X-Session": session } });
}

// Resolves when the page is at rest.
export async function settled(page: Page): Promise<void> {
  const late = new Promise<never>((_, fail) =>
    setTimeout(() => fail(new Error("the page does not come to rest")), patience).unref(),
  );
  await Promise.race([page.evaluate(() => window.rholmIdle()), late]);
}

export async function ready(page: Page): Promise<void> {
  await page.locator(".items li").first().waitFor();
  await settled(page);
}

export async function picture(page: Page, name: string): Promise<void> {
  if (pictures) await page.screenshot({ path: join(pictures, `${name}.png`) });
}

export async function openTab(page: Page, name: string): Promise<void> {
  await page.getByRole("tab", { name }).click();
}

// Uses the field beside the slider.
export async function setNumber(page: Page, label: string, value: number): Promise<void> {
  const field = page.getByLabel(`${label}, exactly`, { exact: true });
  await field.fill(String(value));
  await field.press("Enter");
  await settled(page);
}

// Moves the handle to a value.
export async function moveSlider(slider: Locator, value: number): Promise<void> {
  const [scale, min, max] = ((await slider.getAttribute("data-scale")) ?? "").split(" ");
  const places = Number(await slider.getAttribute("max"));
  const place = scale ? places * toPlace(scale as Scale, value, Number(min), Number(max)) : value;
  await slider.evaluate((element: HTMLInputElement, at) => {
    element.value = String(at);
    element.dispatchEvent(new InputEvent("input", { bubbles: true }));
  }, place);
}

// Moves the slider itself like a drag: several inputs, then a change.
export async function drag(page: Page, label: string, values: readonly number[]): Promise<void> {
  const slider = page.getByRole("slider", { name: label, exact: true });
  for (const value of values) {
    await moveSlider(slider, value);
    await page.evaluate(() => new Promise(requestAnimationFrame));
  }
  await slider.dispatchEvent("change");
  await settled(page);
}

export async function press(page: Page, name: string | RegExp): Promise<void> {
  await page.getByRole("button", { name }).click();
  await settled(page);
}

export async function openFile(studio: Studio, page: Page, ...names: string[]): Promise<void> {
  const paths = names.map((name) => inFolder(studio, name));
  await page.locator("nav input[type=file]").setInputFiles(paths);
  await settled(page);
}

// Drops files on the page, given by name and content.
export async function drop(page: Page, files: readonly (readonly [string, Buffer])[]): Promise<void> {
  const plain = files.map(([name, bytes]) => [name, bytes.toString("base64")] as const);
  const transfer = await page.evaluateHandle((list) => {
    const data = new DataTransfer();
    for (const [name, text] of list) {
      data.items.add(new File([Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))], name));
    }
    return data;
  }, plain);
  await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
  await settled(page);
}

// Returns the file that a click on this button saves.
export async function saved(page: Page, name: string | RegExp): Promise<Buffer> {
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name }).click(),
  ]);
  return readFileSync(await download.path());
}

// Returns the canvas as an image, to detect changes to the last bit. The background is
// uniform, because browsers dither a gradient by one of 255, differently each time.
export async function canvas(page: Page): Promise<Buffer> {
  return page.locator(".canvas canvas").screenshot({ style: ":root { --stage: #dedcd6 !important }" });
}

export interface Pixels {
  width: number;
  height: number;
  data: Buffer; // red, green, blue, alpha of each pixel, row by row
}

export async function pixelsOf(page: Page, png: Buffer): Promise<Pixels> {
  const [width, height, text] = await page.evaluate(async (base64) => {
    const file = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const image = await createImageBitmap(new Blob([file], { type: "image/png" }));
    const paper = new OffscreenCanvas(image.width, image.height).getContext("2d");
    if (!paper) throw new Error("the browser has no canvas");
    paper.drawImage(image, 0, 0);
    const { data } = paper.getImageData(0, 0, image.width, image.height);
    const reader = new FileReader();
    const read = new Promise((done) => (reader.onload = done));
    reader.readAsDataURL(new Blob([data]));
    await read;
    return [image.width, image.height, reader.result as string] as const;
  }, png.toString("base64"));
  return { width, height, data: Buffer.from(text.slice(text.indexOf(",") + 1), "base64") };
}

// Returns how much more red than blue a pixel is: large for stone, near 0 for the background, less for a second
// shape.
export const warmthAt = ({ data }: Pixels, i: number): number => (data[4 * i] ?? 0) - (data[4 * i + 2] ?? 0);

// Returns the middle of the pixels of this colour (sRGB, within 8 of 255) on the page; null if there are none.
export async function whereIs(page: Page, color: Rgb): Promise<[number, number] | null> {
  const { width, height, data } = await pixelsOf(page, await page.screenshot());
  const wanted = color.map((x) => 255 * toSrgb(x));
  const has = (i: number) => wanted.every((c, k) => Math.abs(c - (data[4 * i + k] ?? 0)) <= 8);
  let [x, y, n] = [0, 0, 0];
  for (let i = 0; i < width * height; ++i) {
    // Rings are as thin as a pixel, so only pixels with the same colour to the right and below count.
    if (!has(i) || !has(i + 4) || !has(i + 4 * width)) continue;
    x += i % width;
    y += Math.floor(i / width);
    n += 1;
  }
  return n > 0 ? [x / n, y / n] : null;
}

// Returns a position on the canvas, given in parts of its size.
export async function at(page: Page, x: number, y: number): Promise<[number, number]> {
  const box = await page.locator(".canvas canvas").boundingBox();
  if (!box) throw new Error("there is no canvas");
  return [box.x + x * box.width, box.y + y * box.height];
}

// Opens a shape for startLongJob(): caps of degree 2 at most for a small error, which take more than a minute of
// processor time. The test that starts the job must end it. The job is visible, however slowly the page draws.
export async function openForLongJob(studio: Studio, page: Page): Promise<void> {
  rholm(studio, "make", "torus", "--segments", "384x192", "-o", "fine.ply");
  await openFile(studio, page, "fine.ply");
}
export async function startLongJob(page: Page): Promise<void> {
  await openTab(page, "Caps");
  await setNumber(page, "Allowed error, rms", 1e-4);
  await setNumber(page, "Highest degree of a cap", 2);
  await page.getByRole("button", { name: "Compress" }).click();
  await page.locator("progress").waitFor();
}
