// Tests failures: invalid and too large files, pages reloaded during work, two pages, other
// people's pages, a program that dies. The page reports the failure, and nothing is lost.
import { createServer } from "node:http";
import { once } from "node:events";
import type { AddressInfo } from "node:net";
import { closeSync, ftruncateSync, openSync } from "node:fs";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, beforeEach, expect, it } from "vitest";
import {
  bytesOf,
  drop,
  inFolder,
  openFile,
  openForLongJob,
  openTab,
  moveSlider,
  picture,
  press,
  ready,
  resident,
  rholm,
  setNumber,
  settled,
  startLongJob,
  startStudio,
  stopStudio,
  visit,
  type Studio,
  type Visit,
} from "./studio";

const mebibyte = 2 ** 20;
let studio: Studio;
let now: Visit;

beforeAll(async () => {
  studio = await startStudio();
  rholm(studio, "make", "torus", "-o", "torus.ply");
  rholm(studio, "make", "bumpy", "-o", "rock.ply");
  const huge = openSync(inFolder(studio, "huge.ply"), "w");
  ftruncateSync(huge, 2 ** 31); // uses no block of the disk
  closeSync(huge);
});
afterAll(() => stopStudio(studio));
beforeEach(async () => {
  now = await visit(studio);
  await ready(now.page);
  return async () => {
    const said = now.complaints;
    await now.page.context().close();
    expect(said).toEqual([]);
  };
});

const alert = (page: Page) => page.getByRole("alert").innerText();
const names = (page: Page) => page.locator(".items .name").allInnerTexts();
async function recipe(page: Page): Promise<string> {
  await openTab(page, "Save");
  return page.locator(".copy pre").first().innerText();
}

it("refuses two gigabytes in words, and goes on", async () => {
  const { page } = now;
  const before = resident(studio);
  await openFile(studio, page, "huge.ply");
  expect((await alert(page)).replaceAll("\u202f", "")).toContain("huge.ply: it has 2147483648 bytes");
  await picture(page, "too-large");
  expect(resident(studio)).toBeLessThan(before + 32 * mebibyte);
  await openFile(studio, page, "torus.ply");
  expect(await page.getByRole("alert").count()).toBe(0);
  expect(await names(page)).toEqual(["bumpy.ply", "torus.ply"]);
});

it("says of every broken file among those dropped why it is none, and opens the others", async () => {
  const { page } = now;
  const torus = bytesOf(studio, "torus.ply");
  const noise = Buffer.from(Array.from({ length: 5000 }, (_, i) => (i * i * 31 + 7 * i) % 251));
  const before = await names(page);
  const broken = [
    ["empty.ply", Buffer.alloc(0)],
    ["empty.xyz", Buffer.alloc(0)],
    ["cut.ply", torus.subarray(0, torus.length / 2)],
    ["noise.ply", noise],
    ["noise.stl", noise],
    ["noise.h5", Buffer.concat([Buffer.from("\x89HDF\r\n\x1a\n", "latin1"), noise])],
    ["noise.rholm", Buffer.concat([Buffer.from("RHOLMSS1"), noise])],
    ["picture.png", Buffer.from("\x89PNG\r\n\x1a\n", "latin1")],
  ] as const;
  await drop(page, [...broken, ["torus.ply", torus]]);
  const said = (await alert(page)).split("\n").slice(0, broken.length);
  expect(said.map((line) => line.split(/:? /)[0])).toEqual(broken.map(([name]) => name));
  expect(said.filter((line) => line.includes("/tmp"))).toEqual([]);
  await picture(page, "broken-files");
  expect(await names(page)).toEqual([...before, "torus.ply"]);
  now.complaints = []; // the browser logs the refusals
});

it("comes back as it was when it is loaded again during a job, with the job", async () => {
  const { page } = now;
  await openForLongJob(studio, page);
  const before = [await names(page), await recipe(page)];
  await startLongJob(page);
  await page.reload();
  await page.locator("progress").waitFor();
  expect(await names(page)).toContain("fine.ply");
  await press(page, "Cancel");
  expect([await names(page), await recipe(page)]).toEqual(before);
});

it("comes back as it was when it is loaded again while a slider is held", async () => {
  const { page } = now;
  const before = [await names(page), await recipe(page)];
  await openTab(page, "Degrees");
  const slider = page.getByRole("slider", { name: "Degree", exact: true });
  for (const degree of [20, 10, 4]) {
    await moveSlider(slider, degree);
  }
  await page.reload();
  await ready(page);
  expect([await names(page), await recipe(page)]).toEqual(before);
  await openTab(page, "Degrees");
  expect(await page.getByLabel("Degree, exactly", { exact: true }).inputValue()).toBe("32");
  // The next reload happens with the mouse button down, in the middle of a stroke of the brush.
  await openTab(page, "Smooth");
  const box = await page.locator(".canvas canvas").boundingBox();
  if (!box) throw new Error("there is no canvas");
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 20, box.y + box.height / 2, { steps: 4 });
  await page.reload();
  await ready(page);
  await page.mouse.up();
  expect([await names(page), await recipe(page)]).toEqual(before);
});

it("gives every page a session of its own, also beside each other in one window", async () => {
  const { page } = now;
  const beside = await page.context().newPage();
  await beside.goto(studio.address);
  const elsewhere = await visit(studio);
  await Promise.all([ready(beside), ready(elsewhere.page)]);
  await openTab(page, "Degrees");
  await setNumber(page, "Degree", 8);
  await Promise.all([
    openFile(studio, beside, "torus.ply"),
    openFile(studio, elsewhere.page, "rock.ply"),
    press(page, "Undo"),
  ]);
  expect(await names(page)).toEqual(["bumpy.ply"]);
  expect(await names(beside)).toEqual(["bumpy.ply", "torus.ply"]);
  expect(await names(elsewhere.page)).toEqual(["bumpy.ply", "rock.ply"]);
  expect(await page.getByRole("button", { name: "Redo" }).isEnabled()).toBe(true);
  expect(await beside.getByRole("button", { name: "Redo" }).isEnabled()).toBe(false);
  await beside.close();
  await elsewhere.page.context().close();
  await openFile(studio, page, "torus.ply");
  expect(await names(page)).toEqual(["bumpy.ply", "torus.ply"]);
  expect(elsewhere.complaints).toEqual([]);
});

it("does nothing for another page, even one that knows its address", async () => {
  const server = createServer((_, answer) => answer.setHeader("Content-Type", "text/html").end("<p>other"));
  server.listen(0, "127.0.0.1");
  await once(server, "listening");
  const other = await studio.browser.newPage();
  const statuses: number[] = [];
  other.on("response", (answer) => {
    if (answer.url().startsWith(studio.address)) statuses.push(answer.status());
  });
  await other.goto(`http://127.0.0.1:${(server.address() as AddressInfo).port}/`);
  const read = await other.evaluate(async (address) => {
    const ask = (init: RequestInit) =>
      fetch(`${address}api/session`, init).then((answer) => answer.type, () => "nothing");
    const frame = document.createElement("iframe");
    frame.src = address;
    const loaded = new Promise((done) => (frame.onload = frame.onerror = done));
    document.body.append(frame);
    await loaded;
    return [
      await ask({ method: "POST", body: "{}" }),
      await ask({ method: "POST", body: "{}", headers: { "X-Session": "1" } }),
      await ask({ method: "POST", body: "{}", mode: "no-cors" }),
      await ask({ mode: "no-cors" }),
    ];
  }, studio.address);
  expect(read).toEqual(["nothing", "nothing", "opaque", "opaque"]);
  expect(statuses.length).toBeGreaterThanOrEqual(3);
  expect(statuses.filter((status) => status !== 403)).toEqual([]);
  const wrong = studio.address.replace(/[0-9a-f]{32}/, "0".repeat(32));
  await expect(other.goto(wrong)).rejects.toThrow("ERR_HTTP_RESPONSE_CODE_FAILURE"); // 404, without a body
  await other.close();
  server.close();
});

it("says that the program was killed during a job, and hangs nowhere", async () => {
  const { page } = now;
  await openTab(page, "Degrees");
  await setNumber(page, "Degree", 8); // a step to undo
  await openForLongJob(studio, page);
  await startLongJob(page);
  studio.process.kill("SIGKILL");
  await page.getByText("The studio does not answer").waitFor();
  await settled(page);
  expect(await page.locator(".progress").count()).toBe(0);
  for (const name of ["Undo", "Compress", "Try again"]) {
    await press(page, name);
    await page.getByText("The studio does not answer").waitFor();
  }
  await openFile(studio, page, "torus.ply");
  await openTab(page, "Save");
  await press(page, "Save the session");
  await page.getByText("The studio does not answer").waitFor();
  // The shape can still be viewed.
  await page.locator(".canvas canvas").focus();
  await page.keyboard.press("ArrowLeft");
  await settled(page);
  expect(await names(page)).toEqual(["bumpy.ply", "fine.ply"]);
  await picture(page, "killed");
  now.complaints = []; // lost connections
});
