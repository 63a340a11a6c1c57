// Tests the studio of a frame: requests and messages through a port, and the way to Python.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { PortTransport, type Asked } from "../src/messages";
import { frameDocument, relay, type FromPython, type MessageModel } from "../src/notebook";
import { getJson, LostError, postFile, RefusedError, type Listener } from "../src/transport";

vi.mock("../dist/assets/studio.js?raw", () => ({ default: "" }));
vi.mock("../dist/assets/studio.css?raw", () => ({ default: "" }));

const text = (value: unknown) => new TextEncoder().encode(JSON.stringify(value));

// Returns a frame that has received its welcome, and the other end of its port.
function frame() {
  let listen: (event: unknown) => void = () => undefined;
  const transport = new PortTransport({
    addEventListener: (_: string, listener: unknown) => (listen = listener as typeof listen),
  } as Pick<Window, "addEventListener">);
  const { port1, port2 } = new MessageChannel();
  const welcome = (data: unknown) => listen({ data, ports: [port2] });
  return { transport, port: port1, welcome };
}

function heard(port: MessagePort): Promise<Asked> {
  return new Promise((come) => (port.onmessage = ({ data }: MessageEvent<Asked>) => come(data)));
}

function listener() {
  return { state: vi.fn(), job: vi.fn(), connected: vi.fn() } satisfies Listener;
}

const said = { status: 200, type: "application/json" };

describe("a frame", () => {
  it("waits for its welcome, and has the session of it", async () => {
    const { transport, welcome, port } = frame();
    const session = transport.remembered();
    welcome({ something: "else" });
    welcome({ welcome: { session: "abc" } });
    expect(await session).toBe("abc");
    port.close();
  });

  it("asks and is answered, in any order", async () => {
    const { transport, welcome, port } = frame();
    welcome({ welcome: { session: "abc" } });
    transport.session = "abc";
    const first = heard(port);
    const one = getJson(transport, "item/3/surface?original=1");
    const asked = await first;
    expect(asked).toMatchObject({
      method: "GET",
      path: "api/item/3/surface",
      query: { original: "1" },
      session: "abc",
      body: null,
    });
    const second = heard(port);
    const two = postFile(transport, "a b.ply", new Blob(["ply"]));
    const later = await second;
    expect(later).toMatchObject({ method: "POST", path: "api/file", query: { name: "a b.ply" } });
    expect(new TextDecoder().decode(later.body ?? undefined)).toBe("ply");
    expect(transport.pending).toBe(2);
    port.postMessage({ answer: { ...said, id: later.id, bytes: text("two") } });
    port.postMessage({ answer: { ...said, id: asked.id, bytes: text("one") } });
    expect(await two).toBe("two");
    expect(await one).toBe("one");
    expect(transport.pending).toBe(0);
    port.close();
  });

  it("takes a no for a no", async () => {
    const { transport, welcome, port } = frame();
    welcome({ welcome: { session: "abc" } });
    const first = heard(port);
    const refused = getJson(transport, "state").catch((error: unknown) => error);
    const { id } = await first;
    const bytes = text({ error: { code: "no_session", message: "there is no such session" } });
    port.postMessage({ answer: { id, status: 404, type: "application/json", bytes } });
    expect(await refused).toBeInstanceOf(RefusedError);
    expect(await refused).toMatchObject({ code: "no_session", message: "there is no such session" });
    port.close();
  });
});

describe("silence", () => {
  beforeEach(() => void vi.useFakeTimers({ toFake: ["setTimeout", "clearTimeout"] }));
  afterEach(() => void vi.useRealTimers());

  it("is taken for the end, until something is heard", async () => {
    const { transport, welcome, port } = frame();
    welcome({ welcome: { session: "abc" } });
    const page = listener();
    transport.subscribe(page);
    const first = heard(port);
    const lost = getJson(transport, "state").catch((error: unknown) => error);
    await first;
    vi.advanceTimersByTime(24_000);
    port.postMessage({ event: "beat", data: "" });
    await vi.waitFor(() => expect(page.connected).toHaveBeenCalledTimes(2));
    vi.advanceTimersByTime(24_000);
    expect(page.connected).not.toHaveBeenCalledWith(false);
    vi.advanceTimersByTime(2_000);
    expect(page.connected).toHaveBeenLastCalledWith(false);
    expect(await lost).toBeInstanceOf(LostError);
    port.postMessage({ event: "job", data: '{"id":1}' });
    await vi.waitFor(() => expect(page.job).toHaveBeenCalledWith({ id: 1 }));
    expect(page.connected).toHaveBeenLastCalledWith(true);
    port.close();
  });
});

// Stands for Python: answers requests with given texts, and can send messages.
function python() {
  const listeners = new Set<(content: FromPython, buffers: DataView[]) => void>();
  const sent: { content: Record<string, unknown>; buffers: ArrayBufferView[] }[] = [];
  const model: MessageModel = {
    get: () => "",
    send: (content, _, buffers = []) =>
      void sent.push({ content: content as Record<string, unknown>, buffers }),
    on: (_, hear) => void listeners.add(hear),
    off: (_, hear) => void listeners.delete(hear),
  };
  const tell = (content: FromPython, ...buffers: DataView[]) =>
    listeners.forEach((hear) => hear(content, buffers));
  return { model, sent, tell, listeners };
}

describe("the way to Python", () => {
  it("brings each of two views its own answers, and events to both", async () => {
    const { model, sent, tell, listeners } = python();
    const frames = [frame(), frame()];
    const ends = frames.map(({ port, welcome }) => {
      welcome({ welcome: { session: "abc" } });
      return relay(model, port);
    });
    const [one, two] = frames.map(({ transport }) => getJson(transport, "state"));
    await vi.waitFor(() => expect(sent.length).toBe(2));
    const pages = frames.map(({ transport }) => {
      const page = listener();
      transport.subscribe(page);
      return page;
    });
    const answer = (which: number, value: string) => {
      const { view, id } = sent[which]?.content as { view: number; id: number };
      const bytes = new Uint8Array([0, ...text(value), 0]); // a buffer may be part of a larger one
      tell({ answer: { ...said, view, id } }, new DataView(bytes.buffer, 1, bytes.length - 2));
    };
    expect(sent[0]?.content).toMatchObject({ method: "GET", path: "api/state", query: {} });
    expect(sent[0]?.buffers).toEqual([]);
    answer(1, "for two");
    answer(0, "for one");
    expect([await one, await two]).toEqual(["for one", "for two"]);
    tell({ event: "state", data: '{"items":[]}' });
    for (const page of pages) {
      await vi.waitFor(() => expect(page.state).toHaveBeenCalledWith({ items: [] }));
    }
    ends.forEach((end) => end());
    expect(listeners.size).toBe(0);
  });

  it("takes the bytes of a file beside the message", async () => {
    const { model, sent, tell } = python();
    const { transport, port, welcome } = frame();
    welcome({ welcome: { session: "abc" } });
    const end = relay(model, port);
    const opened = postFile(transport, "x.off", new Blob(["OFF"]));
    await vi.waitFor(() => expect(sent.length).toBe(1));
    expect(sent[0]?.content).not.toHaveProperty("body");
    expect(new TextDecoder().decode(sent[0]?.buffers[0] as Uint8Array)).toBe("OFF");
    const { view, id } = sent[0]?.content as { view: number; id: number };
    tell({ answer: { ...said, view, id } }, new DataView(text({}).buffer));
    expect(await opened).toEqual({});
    end();
  });
});

it("the document of a frame says that it is one, and its script cannot end it", () => {
  const page = frameDocument('const end = "</script>";', "p { margin: 0 }");
  expect(page).toContain('<meta name="rholm-frame"');
  expect(page.match(/<\/script>/g)?.length).toBe(1);
  expect(page).toContain("p { margin: 0 }");
});
