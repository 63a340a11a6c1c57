// Sends what people do as requests to the studio.
import { count } from "./format";
import { PortTransport } from "./messages";
import type { Controls, Fields, FilterWindows, Item, Job, State } from "./protocol";
import { busy, controls, demo, filterWindows, items, job, lost, notice, selected, stopped, studio, unread, working } from "./state";
import {
  getJson,
  HttpTransport,
  LostError,
  postFile,
  postJson,
  RefusedError,
  type Transport,
} from "./transport";

// The frame of a notebook has this tag.
const framed = document.querySelector('meta[name="rholm-frame"]') !== null;
export const transport: Transport = framed ? new PortTransport(window) : new HttpTransport();
let unsubscribe: (() => void) | null = null;

// Opens the session of this tab, or a new one. If no shape is open, makes one.
export async function start(): Promise<void> {
  try {
    await openSession();
    [controls.value, filterWindows.value] = await Promise.all([
      getJson<Controls>(transport, "controls"),
      getJson<FilterWindows>(transport, "windows"),
    ]);
    lost.value = false;
    listen();
    if (items.value.length === 0) {
      demo.value = true;
      // Steps that the page does by itself cannot be undone.
      await step({ op: "make", shape: "bumpy", amplitude: 0.45, seed: 5, first: true }, "Making a shape");
      const made = items.value.at(-1);
      if (made) await step({ op: "expand", item: made.id, degree: 32, center: "auto", first: true }, "Expanding");
    }
  } catch (error) {
    fail(error);
  }
}

async function openSession(): Promise<void> {
  const before = await transport.remembered();
  if (before) {
    transport.session = before;
    try {
      take(await getJson<State>(transport, "state"));
      return;
    } catch (error) {
      if (!(error instanceof RefusedError)) throw error;
    }
  }
  transport.session = "";
  const opened = await postJson<{ session: string; state: State }>(transport, "session", {});
  transport.session = opened.session;
  ended = 0;
  transport.remember(opened.session);
  take(opened.state);
}

function listen(): void {
  unsubscribe?.();
  unsubscribe = transport.subscribe({
    state: take,
    job: takeJob,
    connected: (yes) => {
      if (!yes) lose();
      else if (lost.value) void start();
    },
  });
}

let expected = false; // true after a job has ended, until its state arrives
let ended = 0; // last job that has ended; the answer to its step may arrive later

function takeJob(told: Job): void {
  if (told.id <= ended) return;
  if (told.state !== "running") {
    ended = told.id;
    expected = true;
  }
  job.value = told;
  if (told.state === "failed") notice.value = { text: told.message, bad: true };
  if (told.state !== "running") job.value = null;
}

// Selects a new item, or another item if the selected one is gone.
export function take(state: State): void {
  const before = new Set(items.value.map(({ id }) => id));
  const added = state.items.findLast(({ id }) => !before.has(id));
  const there = state.items.some(({ id }) => id === selected.value);
  studio.value = state;
  if (!state.undo) keep(state.items);
  expected = false;
  job.value = state.job?.state === "running" ? state.job : null;
  if (added) selected.value = added.id;
  else if (!there) selected.value = state.items.at(-1)?.id ?? null;
}

// Returns true if all answers have arrived.
export function quiet(): boolean {
  return transport.pending === 0 && !working.value && !expected;
}

// It is unknown whether the job still runs; a later state shows this, if one arrives.
function lose(): void {
  lost.value = true;
  job.value = null;
  expected = false;
}

export function fail(error: unknown): void {
  if (error instanceof LostError) {
    lose();
    return;
  }
  if (error instanceof RefusedError && error.code === "superseded") return;
  const text = error instanceof Error ? error.message : String(error);
  notice.value = { text, bad: true };
}

async function during(label: string, work: () => Promise<void>): Promise<boolean> {
  if (busy.value !== null) return false;
  busy.value = label;
  notice.value = null;
  try {
    await work();
    return true;
  } catch (error) {
    fail(error);
    return false;
  } finally {
    busy.value = null;
  }
}

// Returns true if the step is done, or continues as a job.
export function step(fields: Fields, label: string): Promise<boolean> {
  return during(label, async () => {
    const answer = await postJson<State | { job: Job }>(transport, "step", fields);
    if ("items" in answer) take(answer);
    else takeJob(answer.job);
  });
}

// Asks a question that changes nothing. Returns null without an answer.
export async function ask<T>(fields: Fields, label: string): Promise<T | null> {
  let answer: T | null = null;
  await during(label, async () => {
    answer = await postJson<T>(transport, "step", fields);
  });
  return answer;
}

// Returns the messages of an item's reader.
function toldOf(one: Item): string[] {
  return [...(one.table ? [one.table.note] : []), ...(one.warnings ?? [])].map((text) => `${one.name}: ${text}`);
}

// Returns the items that the file adds.
async function openFile(file: File, columns = ""): Promise<readonly Item[]> {
  const most = studio.value?.max_upload ?? Infinity;
  // A larger upload would be cut off without an answer that browsers can read.
  if (file.size > most) {
    throw new Error(`it has ${count(file.size)} bytes; the studio takes ${count(most)} (--max-upload).`);
  }
  const before = new Set(items.peek().map(({ id }) => id));
  const state = await postFile<State>(transport, file.name, file, columns);
  demo.value = false;
  take(state);
  const brought = state.items.filter(({ id }) => !before.has(id));
  keep(brought);
  return brought;
}

// Opens all files; for refused files it shows the reason.
export async function openFiles(files: Iterable<File>): Promise<void> {
  if (busy.value !== null) {
    fail(new Error(`${busy.value}: wait for that first.`));
    return;
  }
  const refused: string[] = [];
  const told: string[] = [];
  let opened = 0;
  for (const file of files) {
    const done = await during(`Reading ${file.name}`, async () => {
      told.push(...(await openFile(file)).flatMap(toldOf));
    });
    if (lost.value) return;
    const why = notice.peek()?.text ?? "";
    if (done) {
      opened += 1;
      continue;
    }
    refused.push(why.includes(file.name) ? why : `${file.name}: ${why}`);
    if (tableNames.test(file.name)) unread.value = file;
  }
  if (refused.length > 0 && opened > 0) {
    refused.push(opened === 1 ? "The other one is open." : `The other ${opened} are open.`);
  }
  const lines = [...refused, ...told];
  if (lines.length > 0) notice.value = { text: lines.join("\n"), bad: refused.length > 0 };
}

// Names of files that may be tables of points.
const tableNames = /\.(asc|csv|dat|pts|pwn|tab|tsv|txt|xyz)$/i;

// Opens a refused table with the given columns.
export async function openTable(file: File, columns: string): Promise<boolean> {
  let told: string[] = [];
  const done = await during(`Reading ${file.name}`, async () => {
    told = (await openFile(file, columns)).flatMap(toldOf);
  });
  if (!done) return false;
  unread.value = null;
  if (told.length > 0) notice.value = { text: told.join("\n"), bad: false };
  return true;
}

export const undo = () => studio.value?.undo && step({ op: "undo" }, "Undoing");
export const redo = () => studio.value?.redo && step({ op: "redo" }, "Redoing");
export const removeItem = (item: Item) => step({ op: "remove", item: item.id }, "Removing");

export async function cancelJob(): Promise<void> {
  const running = job.value;
  if (!running) return;
  try {
    await transport.request("POST", `job/${running.id}/cancel`);
  } catch (error) {
    fail(error);
  }
}

// Ends the program.
export async function quit(): Promise<void> {
  try {
    await transport.request("POST", "quit");
    stopped.value = true;
  } catch (error) {
    fail(error);
  }
  unsubscribe?.();
  lose();
}

// Fetches a file and offers it to the browser to save; marks the items in `kept` as saved.
export function saveAs(path: string, name: string, kept: readonly Item[] = []): Promise<boolean> {
  return during(`Writing ${name}`, async () => {
    const { bytes, type } = await transport.request("GET", path);
    offer(new Blob([bytes as BlobPart], { type }), name);
    keep(kept);
  });
}

export const saveSession = () => saveAs("session-file", "session.rholm", items.peek());

// States of items that are saved in a file, or existed before any step.
const files = new Set<string>();
const stateOf = ({ id, revision, name, unit, look }: Item) => JSON.stringify([id, revision, name, unit, look]);
function keep(kept: readonly Item[]): void {
  for (const one of kept) files.add(stateOf(one));
}

// Returns the items that closing the page would lose. The session of a notebook is kept.
export function unsaved(): readonly Item[] {
  if (!transport.endsProgram || lost.peek()) return [];
  return items.peek().filter((one) => !files.has(stateOf(one)));
}

export function offer(blob: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000); // chosen: a browser takes it at once
}
