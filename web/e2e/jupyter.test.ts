// Tests rholm.view and rholm.studio in JupyterLab.
//   RHOLM_JUPYTER  the program jupyter-lab; without it these tests are skipped
//   RHOLM_MODULE   the folder of the Python package
import { execFileSync, spawn, type ChildProcess } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, it } from "vitest";
import { launch, moveSlider, patience, picture, programPath } from "./studio";

const program = process.env.RHOLM_JUPYTER;
let folder = "";
let lab: ChildProcess;
let address = "";
let browser: Browser;
let page: Page;

function notebook(name: string, ...cells: string[]): void {
  const cell = (source: string) => ({
    cell_type: "code",
    execution_count: null,
    metadata: {},
    outputs: [],
    source,
  });
  const kernelspec = { display_name: "Python 3", language: "python", name: "python3" };
  const content = { cells: cells.map(cell), metadata: { kernelspec }, nbformat: 4, nbformat_minor: 4 };
  writeFileSync(join(folder, name), JSON.stringify(content));
}

// Without this setting JupyterLab asks whether to show news.
function wantNoNews(): void {
  const settings = join(folder, ".jupyter/lab/user-settings/@jupyterlab/apputils-extension");
  mkdirSync(settings, { recursive: true });
  writeFileSync(join(settings, "notification.jupyterlab-settings"), '{ "fetchNews": "false" }');
}

async function startLab(jupyter: string): Promise<void> {
  wantNoNews();
  const words = ["--no-browser", "--allow-root", "--ip=127.0.0.1", "--port=0", `--notebook-dir=${folder}`];
  const environment = { ...process.env, HOME: folder, PYTHONPATH: process.env.RHOLM_MODULE };
  lab = spawn(jupyter, words, { cwd: folder, env: environment, stdio: ["ignore", "ignore", "pipe"] });
  address = await new Promise<string>((found, fail) => {
    let said = "";
    lab.stderr?.on("data", (bytes: Buffer) => {
      said += bytes.toString();
      const match = /http:\/\/127\.0\.0\.1:\d+\/lab\?token=[0-9a-f]+/.exec(said);
      if (match) found(match[0]);
    });
    lab.on("exit", (code) => fail(new Error(`JupyterLab ended with ${String(code)}: ${said}`)));
  });
}

async function openNotebook(name: string): Promise<void> {
  const context = await browser.newContext({ viewport: { width: 1600, height: 1000 } });
  page = await context.newPage();
  page.setDefaultTimeout(patience);
  // A separate workspace, so that nothing of another test is opened again.
  await page.goto(address.replace("/lab?", `/lab/workspaces/${name}/tree/${name}.ipynb?`));
  await page.locator(".jp-Notebook .jp-CodeCell").first().waitFor();
  await page.locator('.jp-Notebook-ExecutionIndicator[data-status="idle"]').waitFor({ timeout: patience });
}

// Runs a cell and waits for its end; JupyterLab loses keys that arrive while it starts.
async function run(cell: number): Promise<void> {
  const place = page.locator(".jp-CodeCell").nth(cell);
  const prompt = place.locator(".jp-InputPrompt");
  for (let tries = 0; tries < 30 && (await prompt.textContent()) === "[ ]:"; ++tries) {
    await place.locator(".cm-content").focus(); // a click would wait for overlays
    await page.keyboard.press("Control+Enter");
    await page.waitForTimeout(2000);
  }
  await expect.poll(() => prompt.textContent(), { timeout: patience }).toMatch(/\d/);
}

async function printed(text: string): Promise<void> {
  await page.locator(".jp-OutputArea-output", { hasText: text }).waitFor();
}

describe.skipIf(!program)("in JupyterLab", () => {
  beforeAll(async () => {
    folder = mkdtempSync(join(tmpdir(), "rholm-jupyter-"));
    execFileSync(programPath(), ["make", "bumpy", "--subdivisions", "4", "-o", "bumpy.ply"], { cwd: folder });
    notebook("view.ipynb", 'import rholm\nrholm.view(rholm.expand("bumpy.ply", 24))');
    notebook(
      "studio.ipynb",
      'import rholm\nstudio = rholm.studio("bumpy.ply", height=640)\nstudio',
      'print("degree", studio["bumpy.ply"].degree)',
      'studio.add(rholm.torus(2, 0.7, 40, 20), "a ring")\nprint(len(studio), "shapes")',
    );
    await startLab(program ?? "");
    browser = await launch();
  });
  afterEach(async () => {
    await page.context().close();
  });
  afterAll(async () => {
    await browser.close();
    const ended = new Promise((done) => lab.once("exit", done));
    lab.kill("SIGTERM");
    await ended;
    rmSync(folder, { recursive: true, force: true });
  });

  it("an expansion can be looked at, degree by degree", async () => {
    await openNotebook("view");
    await run(0);
    const viewer = page.locator(".rholm-viewer");
    await viewer.locator("canvas").first().waitFor();
    const slider = viewer.getByRole("slider", { name: "Degree" });
    expect(await viewer.getByLabel("Degree, exactly", { exact: true }).inputValue()).toBe("24");
    const canvas = viewer.locator(".canvas");
    const all = await canvas.screenshot();
    await moveSlider(slider, 2);
    await page.evaluate(() => new Promise(requestAnimationFrame));
    await expect.poll(async () => all.equals(await canvas.screenshot())).toBe(false);
    await picture(page, "notebook-view");
  });

  it("a shape is worked on by hand, and is there in Python", async () => {
    await openNotebook("studio");
    await run(0);
    const studio = page.frameLocator('iframe[title="rholm studio"]');
    await studio.locator(".items li", { hasText: "bumpy.ply" }).waitFor();
    await studio.getByRole("tab", { name: "Degrees" }).click();
    const degree = studio.getByLabel("Up to degree, exactly", { exact: true });
    await degree.fill("12");
    await degree.press("Enter");
    await studio.getByRole("button", { name: "Expand" }).click();
    await studio.locator(".uplot").first().waitFor();
    await run(1);
    await printed("degree 12");
    await picture(page, "studio-notebook");
    await run(2);
    await printed("2 shapes");
    await studio.locator(".items li", { hasText: "a ring" }).waitFor();
  });
});
