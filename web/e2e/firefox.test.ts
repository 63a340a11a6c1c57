// Tests in Firefox that the page draws, and that shapes, sliders, brush and files work as elsewhere.
//   RHOLM_FIREFOX the browser; without it these tests are skipped
// Firefox draws with WebGL in software on a display in memory (Xvfb), which is started here.
import { spawn, type ChildProcess } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import puppeteer, { type Browser, type Page } from "puppeteer-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type {} from "../src/idle";
import { bytesOf, inFolder, patience, pictures, rholm, startProgram, stopProgram, type Program } from "./studio";

const firefox = process.env.RHOLM_FIREFOX;
const complaints: string[] = [];
let program: Program;
let downloads = "";
let display: ChildProcess;
let browser: Browser;
let page: Page;

// Returns the number of a free display, found by Xvfb.
async function startDisplay(): Promise<string> {
  display = spawn("Xvfb", ["-displayfd", "1", "-screen", "0", "1400x1000x24", "-nolisten", "tcp"], {
    stdio: ["ignore", "pipe", "ignore"],
  });
  return new Promise((found, fail) => {
    display.on("error", fail);
    display.on("exit", (code) => fail(new Error(`Xvfb ended with ${String(code)}`)));
    display.stdout?.on("data", (bytes: Buffer) => found(`:${bytes.toString().trim()}`));
  });
}

const settled = () => page.evaluate(() => window.rholmIdle());

async function press(text: string): Promise<void> {
  await page.locator(`::-p-text(${text})`).click();
  await settled();
}

async function canvas(): Promise<Uint8Array> {
  const place = await page.$(".canvas canvas");
  if (!place) throw new Error("there is no canvas");
  return place.screenshot();
}

async function setNumber(label: string, value: number): Promise<void> {
  const field = await page.$(`input[aria-label="${label}, exactly"]`);
  if (!field) throw new Error(`there is no ${label}`);
  await field.click({ count: 3 });
  await field.type(String(value));
  await page.keyboard.press("Enter");
  await settled();
}

async function picture(name: string): Promise<void> {
  if (pictures) await page.screenshot({ path: join(pictures, `${name}.png`) });
}

describe.skipIf(!firefox)("in Firefox", () => {
  beforeAll(async () => {
    program = await startProgram();
    rholm(program, "make", "bumpy", "--subdivisions", "4", "-o", "rock.ply");
    rholm(program, "expand", "rock.ply", "--degree", "12", "-o", "rock.h5");
    downloads = mkdtempSync(join(tmpdir(), "rholm-firefox-"));
    const environment = { ...process.env, DISPLAY: await startDisplay(), LIBGL_ALWAYS_SOFTWARE: "1" };
    browser = await puppeteer.launch({
      browser: "firefox",
      executablePath: firefox ?? "",
      headless: false, // a headless one has no WebGL 2 without a graphics card
      env: environment,
      extraPrefsFirefox: {
        "webgl.force-enabled": true,
        "gfx.webrender.software": true,
        "browser.download.folderList": 2,
        "browser.download.dir": downloads,
      },
    });
    page = await browser.newPage();
    await page.setViewport({ width: 1280, height: 800 });
    page.on("pageerror", (error) => complaints.push(String(error)));
    page.on("console", (message) => {
      if (message.type() === "error") complaints.push(message.text());
    });
    await page.goto(program.address);
    await page.waitForSelector(".items li");
    await settled();
  });
  afterAll(async () => {
    await browser.close();
    display.removeAllListeners("exit").kill();
    await stopProgram(program);
    rmSync(downloads, { recursive: true, force: true });
    expect(complaints).toEqual([]);
  });

  it("opens a file and expands it", async () => {
    const input = await page.$("nav input[type=file]");
    await (input as unknown as { uploadFile(path: string): Promise<void> }).uploadFile(
      inFolder(program, "rock.ply"),
    );
    await page.waitForFunction(() => document.body.innerText.includes("rock.ply"));
    await settled();
    await press("Degrees");
    await setNumber("Up to degree", 12);
    await press("Expand");
    expect(await page.evaluate(() => document.body.innerText)).toContain("At degree 12");
  });

  it("the surface follows the slider, and the error is in colours", async () => {
    const whole = Buffer.from(await canvas());
    await setNumber("Degree", 3);
    const cut = Buffer.from(await canvas());
    expect(whole.equals(cut)).toBe(false);
    await press("Error in colours");
    expect(cut.equals(Buffer.from(await canvas()))).toBe(false);
    await picture("firefox-degrees");
    await press("Undo");
  });

  it("what it saves has the bytes of the program", async () => {
    await press("Save");
    await page.locator(".panel select").fill("h5");
    await press("Save rock.h5");
    const file = join(downloads, "rock.h5");
    await expect.poll(() => existsSync(file) && readFileSync(file).length, { timeout: patience }).toBeTruthy();
    expect(readFileSync(file).equals(bytesOf(program, "rock.h5"))).toBe(true);
  });

  it("the brush paints and smooths", async () => {
    await press("Smooth");
    const before = Buffer.from(await canvas());
    await page.mouse.move(570, 400);
    await page.mouse.down();
    await page.mouse.move(640, 430, { steps: 5 });
    await page.mouse.up();
    await settled();
    expect(before.equals(Buffer.from(await canvas()))).toBe(false);
    await picture("firefox-brush");
  });
});
